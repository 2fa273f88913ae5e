// The measures of convexity over the drive, against what they were held against.
import { h, replace } from "../dom.js";
import { watch } from "../store.js";
import { stepChart } from "./step_chart.js";

export function growthCharts(root) {
  const hidden = stepChart("Hidden pairs", "of every tentative part");
  const c1 = stepChart("C1", "eq. 7 of all that is left");
  const c2 = stepChart("C2", "eq. 8 of part and rest, the best part");
  const charts = [hidden, c1, c2];
  replace(root, charts.map((chart) => chart.element), h("p", { class: "legend" },
    h("span", { class: "key key-extracted" }), "became a region", h("span", { class: "key key-rejected" }), "not (yet)"));
  watch(["timeline"], ({ timeline }) => {
    const moments = timeline ?? [];
    const threshold = (name) => [...new Set(moments.map((moment) => moment.thresholds[name]).filter((value) => typeof value === "number"))];
    hidden.draw({ ...series(moments, leastHidden), dots: dots(moments, (decision) => decision.hidden_pairs), thresholds: threshold("hidden_pairs") });
    c1.draw({ ...series(moments, (moment) => moment.decisions[0]?.c1 ?? null), dots: [], thresholds: threshold("c1") });
    c2.draw({ count: moments.length, lines: [{ values: moments.map(best) }, { values: moments.map(mostC2), kind: "limit" }], dots: dots(moments, (decision) => decision.c2), thresholds: [] });
  });
  watch(["stepIndex", "timeline"], ({ stepIndex, timeline }) => {
    if (timeline?.length) for (const chart of charts) chart.mark(stepIndex);
  });
}

function series(moments, valueOf) {
  return { count: moments.length, lines: [{ values: moments.map(valueOf) }] };
}

function dots(moments, valueOf) {
  return moments.flatMap((moment, index) => moment.decisions.map((decision) => ({
    index, value: valueOf(decision), kind: decision.accepted ? "extracted" : "rejected",
  })));
}

function leastHidden(moment) {
  return moment.decisions.length ? Math.min(...moment.decisions.map((decision) => decision.hidden_pairs)) : null;
}

/** Where the paper holds C2 against a share of C1 (eq. 9). */
function mostC2({ thresholds, decisions }) {
  return typeof thresholds.c2_per_c1 === "number" && decisions.length ? thresholds.c2_per_c1 * decisions[0].c1 : null;
}

function best(moment) {
  return moment.decisions.length ? Math.min(...moment.decisions.map((decision) => decision.c2)) : null;
}
