// What is known of the node that is selected.
import { h, replace } from "../dom.js";
import { area, count, metres, nodeName } from "../format.js";
import { watch } from "../store.js";
import { select } from "../view3d.js";
import { chosenNodes } from "./edit_selection.js";
import { groupTools, nodeTools } from "./edit_tools.js";

export function selection(root) {
  watch(["model", "selected", "picked", "colours", "cutting"], (state) => {
    const { model, selected, colours, cutting } = state;
    const group = chosenNodes(state);
    const node = model?.nodes?.find((item) => item.id === selected);
    if (!node) {
      replace(root, h("p", { class: "nothing" }, model?.nodes?.length ? "Click a room in the map or in the table." : null));
      return;
    }
    if (group.length > 1) {
      replace(root, ...several(group, colours));
      return;
    }
    replace(root,
      h("h2", {}, "Selected"),
      h("p", { class: "selected-name" }, h("span", { class: "swatch swatch-large", style: { background: colours[node.id] ?? "" } }), nodeName(node)),
      h("dl", { class: "facts" },
        fact("Floor", `${area(node.area_m2)} m²`),
        fact("Place", `x ${metres(node.position[0], 2)}, y ${metres(node.position[1], 2)}`),
        fact("Hidden pairs", node.convexity.toFixed(2), "share of pairs of points in it that do not see each other; 0 is convex"),
        ...room(model, node),
      ),
      nodeTools(model, node, cutting),
      ways(model, node),
    );
  });
}

function several(nodes, colours) {
  const floor = nodes.reduce((sum, node) => sum + node.area_m2, 0);
  return [
    h("h2", {}, `${nodes.length} selected`),
    nodes.map((node) => h("p", { class: "picked" }, h("span", { class: "swatch", style: { background: colours[node.id] ?? "" } }), nodeName(node))),
    h("dl", { class: "facts" }, fact("Floor", `${area(floor)} m²`)),
    groupTools(nodes),
  ];
}

function fact(name, value, tip) {
  return [h("dt", { title: tip }, name), h("dd", {}, value)];
}

function room(model, node) {
  const found = model.rooms.find((item) => item.nodes.includes(node.id));
  if (!found || found.nodes.length < 2) return [];
  return fact("Room", `${found.label ?? `room ${found.room}`}, ${count(found.nodes.length, "region")}`, "touching regions of one name are one room");
}

function ways(model, node) {
  const edges = model.edges.filter((edge) => edge.source === node.id || edge.target === node.id);
  if (!edges.length) return h("p", { class: "muted" }, "No way leads out of it.");
  return h("ul", { class: "ways", "aria-label": "Ways out" }, edges.map((edge) => {
    const other = model.nodes.find((item) => item.id === (edge.source === node.id ? edge.target : edge.source));
    return h("li", {}, h("button", { type: "button", class: "link-button", onclick: () => select(other.id) }, nodeName(other)),
      h("span", { class: "muted" }, `${metres(edge.width_m, 2)} wide`));
  }));
}
