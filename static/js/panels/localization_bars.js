// A bar per node in a fixed order, `unknown` last: only widths and figures change from step to step.
import { h, replace } from "../dom.js";
import { nodeName } from "../format.js";
import { get, watch } from "../store.js";
import { select } from "../view3d.js";
import { currentStep } from "./localization_player.js";

export const UNKNOWN = "unknown: nowhere in this map";
const GONE = "no longer in the model";

export function localizationBars(root) {
  const list = h("ul", { class: "bars" });
  const rows = new Map();
  replace(root, h("h2", {}, "Probability", h("small", {}, "of every region")), list);
  watch(["model", "localization", "stepIndex", "colours", "selected"], ({ model, localization, colours, selected }) => {
    const step = currentStep();
    if (!step || !model?.nodes) return;
    const gone = goneNodes(step, model);
    const keys = [...model.nodes.map((node) => node.id), ...(gone.length ? [GONE] : []), UNKNOWN];
    const key = `${localization.id}\n${keys.join("\n")}`;
    if (list.dataset.key !== key) {
      list.dataset.key = key;
      rows.clear();
      for (const id of keys) rows.set(id, probabilityBar(id));
      replace(list, keys.map((id) => rows.get(id).element));
    }
    const most = mostProbable(step);
    for (const node of model.nodes) {
      rows.get(node.id).update(nodeName(node), step.probabilities[node.id], colours[node.id], most === node.id, selected === node.id);
    }
    if (gone.length) {
      const sum = gone.reduce((total, id) => total + step.probabilities[id], 0);
      rows.get(GONE).update("removed", sum, null, gone.includes(most), false);
    }
    rows.get(UNKNOWN).update("unknown", step.unknown, null, most === null, false);
  });
}

/** Ids that the step knows and the model does not: it was edited since. */
export function goneNodes(step, model) {
  const known = new Set(model.nodes.map((node) => node.id));
  return Object.keys(step.probabilities).filter((id) => !known.has(id));
}

/** The most probable node's id, null when `unknown` is more probable than all of them. */
export function mostProbable(step) {
  let [best, most] = [null, step.unknown];
  for (const [id, share] of Object.entries(step.probabilities)) if (share > most) [best, most] = [id, share];
  return best;
}

/** One line: `element`, and `update(text, share, colour, isBest, isSelected)`. */
export function probabilityBar(id) {
  const own = id !== UNKNOWN && id !== GONE;
  const swatch = h("span", { class: "swatch" });
  const name = h("span", { class: "bar-name" });
  const fill = h("span", { class: "bar-fill" });
  const figure = h("span", { class: "bar-figure" });
  const track = h("span", { class: "bar-track" }, fill);
  const element = h("li", { dataset: { bar: own ? id : id === UNKNOWN ? "unknown" : "gone" } }, own
    ? h("button", { type: "button", class: "bar", onclick: () => select(get().selected === id ? null : id) }, swatch, name, track, figure)
    : h("div", { class: "bar", title: id }, swatch, name, track, figure));
  const update = (text, share, colour, best, selected) => {
    name.textContent = text;
    name.title = text;
    swatch.style.background = colour ?? "";
    swatch.classList.toggle("swatch-none", !colour);
    fill.style.width = `${100 * (share ?? 0)}%`;
    figure.textContent = share === undefined ? "–" : percentage(share);
    figure.title = share === undefined ? "came into the model after this localization" : "";
    element.classList.toggle("best", best);
    element.classList.toggle("selected", selected);
  };
  return { element, update };
}

/** One decimal always, so that figures do not dance. */
function percentage(share) {
  return `${(100 * share).toFixed(1)} %`;
}
