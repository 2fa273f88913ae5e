// The table of nodes: click to select, type to rename. Rows are kept, so that typing is never disturbed.
import { h, replace } from "../dom.js";
import { labelNode } from "../actions.js";
import { area, nodeName } from "../format.js";
import { get, watch } from "../store.js";
import { select } from "../view3d.js";
import { choose, isChoosing } from "./edit_selection.js";

export function nodeTable(root) {
  const body = h("tbody", {});
  const rows = new Map();
  let shown = null; // id of the model whose nodes the rows are
  replace(root,
    h("h2", {}, "Rooms", h("small", {}, "click to select, Ctrl adds")),
    h("table", { class: "nodes" },
      h("thead", {}, h("tr", {},
        h("th", { scope: "col" }, h("span", { class: "unseen" }, "Colour")), h("th", { scope: "col" }, "name"),
        h("th", { scope: "col", class: "num" }, "m²"), h("th", { scope: "col", class: "num" }, "doors"),
        h("th", { scope: "col", class: "num", title: "share of pairs of points that do not see each other; 0 is convex" }, "hidden"),
      )), body),
  );
  watch(["model", "colours", "selected", "picked"], ({ model, colours, selected, picked }) => {
    const nodes = model?.nodes ?? [];
    if (shown !== model?.id) {
      shown = model?.id;
      rows.clear();
    }
    for (const node of nodes) if (!rows.has(node.id)) rows.set(node.id, row(node.id));
    arrange(body, nodes.map((node) => rows.get(node.id).element));
    for (const node of nodes) rows.get(node.id).update(node, doors(model, node.id), colours[node.id], node.id === selected || picked.includes(node.id));
  });
}

/** Shows these rows in this order; one that stays is not moved, so that nobody's typing is disturbed. */
function arrange(body, elements) {
  const wanted = new Set(elements);
  for (const row of [...body.children]) if (!wanted.has(row)) row.remove();
  elements.forEach((element, index) => {
    if (body.children[index] !== element) body.insertBefore(element, body.children[index] ?? null);
  });
}

/** Puts the cursor into the name of the selected node. */
export function renameSelected() {
  document.querySelector(`tr[data-node="${CSS.escape(get().selected ?? "")}"] input`)?.focus();
}

export function doors(model, id) {
  return model.edges.filter((edge) => edge.source === id || edge.target === id).length;
}

function row(id) {
  const swatch = h("span", { class: "swatch" });
  const input = h("input", { class: "node-name", maxlength: 80, autocomplete: "off", spellcheck: false });
  const cells = [0, 1, 2].map(() => h("td", { class: "num" }));
  const element = h("tr", { dataset: { node: id }, onclick: (event) => choose(id, event), onmousedown: (event) => isChoosing(event) && event.preventDefault() },
    h("td", {}, swatch), h("td", { class: "name-cell" }, input), cells);
  let saved = "";
  const commit = () => {
    const label = input.value.trim();
    if (label !== saved) {
      saved = label;
      labelNode(id, label);
    }
  };
  input.addEventListener("focus", () => {
    if (get().selected !== id) select(id);
    input.select();
  });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      commit();
      input.blur();
    } else if (event.key === "Escape") {
      input.value = saved;
      input.blur();
      event.stopPropagation();
    } else if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      const next = event.key === "ArrowDown" ? element.nextElementSibling : element.previousElementSibling;
      next?.querySelector("input").focus();
      event.preventDefault();
    }
  });
  input.addEventListener("blur", commit);
  const update = (node, doorCount, colour, isSelected) => {
    element.classList.toggle("selected", isSelected);
    element.setAttribute("aria-current", String(isSelected));
    swatch.style.background = colour ?? "var(--line-strong)";
    const stored = node.label ?? "";
    if (stored !== saved || document.activeElement !== input) {
      if (document.activeElement !== input || input.value === saved) input.value = stored;
      saved = stored;
    }
    input.placeholder = `Region ${node.region}`;
    input.setAttribute("aria-label", `Name of ${nodeName(node)}`);
    [area(node.area_m2), doorCount, node.convexity.toFixed(2)].forEach((text, index) => replace(cells[index], text));
  };
  return { element, update };
}
