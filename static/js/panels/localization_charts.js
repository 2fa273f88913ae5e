// Entropy and the largest probability over the steps, rejected ones in another colour (the paper's
// Figs. 20, 21, 25 and 26).
import { h, replace } from "../dom.js";
import { watch } from "../store.js";
import { stepChart } from "./step_chart.js";

const SURE = 0.9;
const MOST_DOTS = 160;

export function localizationCharts(root) {
  const charts = [
    [stepChart("Largest probability", "of a region"), (step) => Math.max(0, ...Object.values(step.probabilities)), [SURE]],
    [stepChart("Entropy", "1: no idea, 0: sure"), (step) => step.entropy, []],
  ];
  replace(root, charts.map(([chart]) => chart.element), h("p", { class: "legend" },
    h("span", { class: "key key-updated" }), "updated", h("span", { class: "key key-rejected" }), "rejected"));
  watch(["localization"], ({ localization }) => {
    const steps = localization?.steps_list ?? [];
    for (const [chart, valueOf, thresholds] of charts) chart.draw(content(steps, valueOf, thresholds));
  });
  watch(["stepIndex", "localization"], ({ stepIndex, localization }) => {
    if (localization) for (const [chart] of charts) chart.mark(stepIndex);
  });
}

/** Every rejected step has a dot; accepted ones only while there is room. */
function content(steps, valueOf, thresholds) {
  const values = steps.map(valueOf);
  const dots = steps.flatMap((step, index) => (step.updated && steps.length > MOST_DOTS ? [] : [
    { index, value: values[index], kind: step.updated ? "" : "rejected" },
  ]));
  const rejected = steps.filter((step) => !step.updated).length;
  return { count: steps.length, lines: [{ values }], dots, thresholds, label: `, ${rejected} of them rejected` };
}
