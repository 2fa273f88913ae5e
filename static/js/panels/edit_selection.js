// Several nodes at once: Ctrl adds one, Shift the rows up to it.
import { get } from "../store.js";
import { select } from "../view3d.js";

/** The selected node and those picked beside it, in the order of the model. */
export function chosenNodes({ model, selected, picked }) {
  const ids = new Set([selected, ...picked]);
  return (model?.nodes ?? []).filter((node) => ids.has(node.id));
}

/** A click on a node's row. */
export function choose(id, { ctrlKey = false, metaKey = false, shiftKey = false } = {}) {
  const { model, selected, picked } = get();
  if (selected === null || !(ctrlKey || metaKey || shiftKey)) select(id);
  else if (shiftKey) select(selected, between(model.nodes.map((node) => node.id), selected, id));
  else if (id === selected) select(picked.at(-1) ?? null, picked.slice(0, -1));
  else if (picked.includes(id)) select(selected, picked.filter((other) => other !== id));
  else select(selected, [...picked, id]);
}

/** Whether a press is for choosing, and must not put the cursor into a name. */
export function isChoosing(event) {
  return event.ctrlKey || event.metaKey || event.shiftKey;
}

function between(ids, from, to) {
  const [first, last] = [ids.indexOf(from), ids.indexOf(to)].sort((a, b) => a - b);
  return ids.slice(first, last + 1).filter((id) => id !== from);
}
