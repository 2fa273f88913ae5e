// Convexity of every region against the threshold (the paper's Fig. 15). A click selects.
import { h, replace } from "../dom.js";
import { nodeName } from "../format.js";
import { get, watch } from "../store.js";
import { select } from "../view3d.js";

const HEIGHT = 92; // pixels of the highest bar
const LEAST_TOP = 0.3; // share of hidden pairs that the chart reaches at least
const THRESHOLD = 0.2; // where the model does not tell its own

export function convexityChart(root) {
  watch(["model", "colours", "selected"], ({ model, colours, selected }) => {
    if (!model?.nodes?.length) {
      replace(root);
      return;
    }
    const threshold = model.provenance.segmentation?.most_hidden ?? THRESHOLD;
    const top = Math.max(LEAST_TOP, threshold * 1.2, ...model.nodes.map((node) => node.convexity));
    const high = (share) => `${((share / top) * HEIGHT).toFixed(1)}px`;
    replace(root,
      h("h2", {}, "Convexity", h("small", { title: "share of pairs of points of a region that do not see each other" }, "hidden pairs, 0 is convex")),
      h("div", { class: "convexity", style: { height: `${HEIGHT}px` }, role: "group", "aria-label": "Hidden pairs of every region" },
        h("span", { class: "convexity-limit", style: { bottom: high(threshold) }, title: `a region may have ${threshold}` }, h("em", {}, threshold.toFixed(2))),
        model.nodes.map((node) => h("button", {
          type: "button", class: `convexity-bar${node.id === selected ? " selected" : ""}`, dataset: { convexity: node.id },
          title: `${nodeName(node)}: ${node.convexity.toFixed(2)}`, "aria-label": `${nodeName(node)}: ${node.convexity.toFixed(2)} hidden pairs`,
          onclick: () => select(get().selected === node.id ? null : node.id),
        }, h("span", { style: { height: high(node.convexity), background: colours[node.id] ?? "" } }), h("em", {}, node.region)))));
  });
}
