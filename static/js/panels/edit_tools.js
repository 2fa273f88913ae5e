// What can be done with the selected nodes: merge, split, move to another room.
import { h } from "../dom.js";
import { nodeName } from "../format.js";
import { edit, nameRoom } from "./edit_actions.js";
import { startCut, stopCut } from "./edit_cut.js";
import { askRoomName } from "./room_dialog.js";

const OWN_ROOM = "own";
const CHANGES_AT_ONCE = /^(Arrow.*|Home|End|Page.*|\S)$/;

/** Buttons for one node. */
export function nodeTools(model, node, cutting) {
  const around = neighbours(model, node);
  const splitting = cutting === node.id;
  return h("div", { class: "edit-tools", role: "group", "aria-label": "Edit" },
    h("button", {
      type: "button", class: "button", "aria-pressed": String(splitting), title: "Split it along a line that you draw in the map (S)",
      onclick: () => (splitting ? stopCut() : startCut(node.id)),
    }, "Split…"),
    menu("Merge with…", around.map((other) => [other.id, nodeName(other)]), (id) => merge([node.id, id])),
    menu("Move to…", rooms(model, node, around), (id) => edit({ op: "move", node: node.id, room: id === OWN_ROOM ? null : id })),
    roomButton(model, node),
  );
}

/** A room of several regions is named as a whole. */
function roomButton(model, node) {
  const room = model.rooms.find((item) => item.nodes.includes(node.id));
  if (room.nodes.length < 2) return null;
  const name = async () => {
    const label = await askRoomName(room, model.nodes.filter((item) => room.nodes.includes(item.id)));
    if (label !== undefined) nameRoom(room.id, label || null);
  };
  return h("button", { type: "button", class: "button", title: "All of its regions get one name", onclick: name }, `Name its room of ${room.nodes.length} regions…`);
}

/** Buttons for several nodes. */
export function groupTools(nodes) {
  return h("div", { class: "edit-tools", role: "group", "aria-label": "Edit" },
    h("button", { type: "button", class: "button button-primary", onclick: () => merge(nodes.map((node) => node.id)) }, `Merge ${nodes.length} regions`));
}

function merge(nodes) {
  return edit({ op: "merge", nodes }, (model) => model.nodes.find((node) => nodes.includes(node.id))?.id ?? null);
}

function neighbours(model, node) {
  const ids = new Set(model.edges.flatMap((edge) => (
    edge.source === node.id ? [edge.target] : edge.target === node.id ? [edge.source] : []
  )));
  return model.nodes.filter((other) => ids.has(other.id));
}

/** Rooms that a node touches, and one of its own when it shares its room. */
function rooms(model, node, around) {
  const own = model.rooms.find((room) => room.nodes.includes(node.id));
  const near = model.rooms.filter((room) => room !== own && around.some((other) => room.nodes.includes(other.id)));
  const choices = near.map((room) => [room.id, roomName(model, room)]);
  return own.nodes.length > 1 ? [...choices, [OWN_ROOM, "a room of its own"]] : choices;
}

/** A room without a name is called by its regions. */
export function roomName(model, room) {
  const names = model.nodes.filter((node) => room.nodes.includes(node.id)).map(nodeName);
  if (room.label) return room.label;
  return names.length > 2 ? `the room of ${names[0]} and ${names.length - 1} more` : `the room of ${names.join(" and ")}`;
}

/** A list that does something at once; its first line is its name. */
function menu(title, choices, run) {
  const list = h("select", { "aria-label": title, disabled: !choices.length, title: choices.length ? undefined : "nothing touches it" },
    h("option", { value: "" }, title), choices.map(([value, text]) => h("option", { value }, text)));
  list.addEventListener("keydown", (event) => {
    if (!CHANGES_AT_ONCE.test(event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault(); // a closed list takes the next line at such a key, and this one would do it
    list.showPicker();
  });
  list.addEventListener("change", () => {
    const value = list.value;
    list.value = "";
    if (value) run(value);
  });
  return list;
}
