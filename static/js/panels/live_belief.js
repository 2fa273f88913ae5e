// Which room the live robot is in and how sure that is: a bar per node, `unknown` last.
import { h, replace } from "../dom.js";
import { nodeName, percent } from "../format.js";
import { watch } from "../store.js";
import { UNKNOWN, mostProbable, probabilityBar } from "./localization_bars.js";

export function liveBelief(root) {
  const said = h("p", { class: "current-room", role: "status" });
  const list = h("ul", { class: "bars" });
  const entropy = h("p", { class: "muted" });
  const rows = new Map();
  replace(root, h("h2", {}, "Where is the robot?"), said, list, entropy);
  watch(["live", "liveBelief", "model", "colours", "selected"], ({ live, liveBelief: belief, model, colours, selected }) => {
    const nodes = (model?.nodes ?? []).filter((node) => belief && node.id in belief.probabilities);
    root.hidden = !belief && live?.mode !== "localization"; // while it maps, its wheels say where it is
    replace(said, belief ? words(belief, nodes) : "It is looked for; the first answer comes after a few metres.");
    list.hidden = entropy.hidden = !belief;
    if (!belief) return;
    const keys = [...nodes.map((node) => node.id), UNKNOWN];
    if (list.dataset.key !== keys.join("\n")) {
      list.dataset.key = keys.join("\n");
      rows.clear();
      for (const key of keys) rows.set(key, probabilityBar(key));
      replace(list, keys.map((key) => rows.get(key).element));
    }
    const most = mostProbable(belief);
    for (const node of nodes) rows.get(node.id).update(nodeName(node), belief.probabilities[node.id], colours[node.id], most === node.id, selected === node.id);
    rows.get(UNKNOWN).update("unknown", belief.unknown, null, most === null, false);
    replace(entropy, `Entropy ${belief.entropy.toFixed(2)} (0: sure, 1: no idea)`);
  });
}

function words(belief, nodes) {
  const most = mostProbable(belief);
  const node = nodes.find((item) => item.id === most);
  if (!node) return [h("strong", {}, "Nobody knows"), ` · ${percent(belief.unknown)} that it is nowhere in this map`];
  return [h("strong", {}, nodeName(node)), ` · ${percent(belief.probabilities[most])}`];
}
