// Which layers the 3D view shows in this tab.
import { h } from "../dom.js";
import { watch } from "../store.js";
import { showLayer } from "../view3d.js";

/** Layers that a person can switch, in order; those that need a localization come with it. */
const LAYERS = [
  ["grid", "grid", "the occupancy grid"],
  ["regions", "regions", "coloured regions"],
  ["walls", "walls", "walls and furniture"],
  ["cells", "cells", "quadtree cells that the regions are made of"],
  ["graph", "graph", "nodes and the ways between them"],
  ["labels", "labels", "names"],
  ["trajectory", "trajectory", "where the robot drove"],
  ["bars", "bars", "probabilities"],
  ["robot", "robot", "the robot, its way, its local map and the candidates"],
  ["beams", "beams", "sonar beams of a live robot"],
  ["maps", "maps", "the maps at raw and at corrected odometry"],
  ["odometry", "raw trajectory", "where the odometry says that the robot drove"],
  ["corrected", "corrected", "where the robot drove by the corrected trajectory"],
  ["closures", "closures", "places found again"],
];
const PLAYED = new Set(["bars", "robot"]);
/** Layers of the drift, which is shown instead of the model. */
const DRIFT = new Set(["maps", "odometry", "corrected", "closures"]);
const LIVE = new Set(["bars", "robot", "beams"]);

export function layers(root) {
  const boxes = new Map(LAYERS.map(([name, text, tip]) => {
    const box = h("input", { type: "checkbox", id: `layer-${name}`, onchange: () => showLayer(name, box.checked) });
    return [name, { box, label: h("label", { class: "check", for: `layer-${name}`, title: tip }, box, text) }];
  }));
  const section = h("section", { class: "layers" }, h("h2", {}, "Layers"),
    h("div", { class: "checks" }, [...boxes.values()].map((item) => item.label)));
  root.append(section);
  watch(["layers", "connection", "route"], (state) => {
    section.hidden = state.connection === "none" || state.route.growth;
    for (const [name, { box, label }] of boxes) {
      const here = state.route.page === "live" || (PLAYED.has(name) && state.route.localization);
      label.hidden = !(name in state.layers) || (LIVE.has(name) && !here) || DRIFT.has(name) !== state.route.drift;
      box.checked = Boolean(state.layers[name]);
    }
  });
}
