// The right column while one looks at how a model grew: the decisions of the moment, and the charts.
import { h, icon, replace } from "../dom.js";
import { count, metres } from "../format.js";
import { link } from "../router.js";
import { get, set, watch } from "../store.js";
import { growthCharts } from "./growth_charts.js";
import { currentFrame } from "./player.js";

export function growthPanel(root) {
  const head = h("header", { class: "localization-head" });
  const note = h("div", { class: "localization-note", role: "status" });
  const decisions = h("section", {});
  const charts = h("section", { class: "charts" });
  const marks = legend();
  replace(root, head, note, decisions, charts, marks);
  growthCharts(charts);
  watch(["route", "model", "timeline"], ({ route, model, timeline }) => {
    if (!route.growth || !model) return;
    replace(head, h("a", { class: "back", href: link.model(model.id) }, icon("left"), "Rooms"),
      h("h2", {}, "How it grew"),
      h("p", { class: "muted" }, timeline?.length ? `${count(timeline.length, "step")} along the drive, ${model.options.method === "paper" ? "as in the paper" : "default method"}` : null));
    replace(note, timeline === null ? h("p", { class: "muted" }, "Loading…") : timeline.length ? null : nothing());
    for (const part of [decisions, charts, marks]) part.hidden = !timeline?.length;
  });
  watch(["timeline", "stepIndex", "decision"], ({ decision }) => {
    const moment = currentFrame();
    if (get().route.growth && moment?.decisions) replace(decisions, ...listed(moment, decision));
  });
}

function nothing() {
  return [h("h3", {}, "No steps"), h("p", { class: "muted" }, "This model did not grow along a drive: it was made of a map, with the number of regions given, or by an earlier version. Model the log again in mode autonomous to see every decision.")];
}

function listed(moment, chosen) {
  const heading = h("h2", {}, "Decisions", h("small", {}, moment.decisions.length ? "click to see hull and cut" : ""));
  if (!moment.decisions.length) return [heading, h("p", { class: "nothing" }, "Nothing to decide: what is left is one part, and the robot is in it.")];
  return [heading, h("ul", { class: "decisions" }, moment.decisions.map((decision, index) => item(decision, index, chosen === index)))];
}

function item(decision, index, chosen) {
  const name = decision.accepted ? `Part ${decision.cluster} became region ${decision.region}` : `Part ${decision.cluster} waits`;
  const from = decision.came_from.length ? `, cut from ${regions(decision.came_from)}` : "";
  const facts = [
    ["C1", decision.c1.toFixed(2), "eq. 7 of all that was left"], ["C2", decision.c2.toFixed(2), "eq. 8 of the part and the rest"],
    ["hidden", decision.hidden_pairs.toFixed(2), "share of hidden pairs of the part"],
    ["Ncut", decision.ncut.toFixed(3), "normalized cut of the part and the rest"], ["cut", metres(decision.cut_width_m, 2), "length of the border"],
  ];
  return h("li", { class: chosen ? "chosen" : "" }, h("button", {
    type: "button", class: "decision", "aria-pressed": String(chosen), onclick: () => set({ decision: chosen ? null : index }),
  },
  h("span", { class: `key ${decision.accepted ? "key-extracted" : "key-rejected"}` }),
  h("span", { class: "decision-name" }, name), h("span", { class: "decision-why" }, `${decision.reason}${from}`),
  h("span", { class: "decision-facts" }, facts.map(([what, value, tip]) => h("span", { title: tip }, h("em", {}, what), ` ${value}`)))));
}

/** "region 4", "regions 1, 5 and 6" */
function regions(numbers) {
  return numbers.length === 1 ? `region ${numbers[0]}` : `regions ${numbers.slice(0, -1).join(", ")} and ${numbers.at(-1)}`;
}

function legend() {
  const line = (mark, text) => h("li", {}, h("span", { class: `mark mark-${mark}` }), text);
  return h("ul", { class: "marks", "aria-label": "In the map" },
    line("region", "a region that was extracted by then"), line("part", "a tentative part"),
    line("hull", "the convex hull of a part"), line("cut", "where the chosen part is cut off"), line("robot", "the robot"));
}
