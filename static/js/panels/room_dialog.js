// Asks for the name of a room, which all of its regions get.
import { openDialog } from "../dialogs.js";
import { h } from "../dom.js";
import { nodeName } from "../format.js";

/** Resolves with the name, "" to take it away, undefined when cancelled. */
export function askRoomName(room, nodes) {
  return openDialog("Name the room", (close) => {
    const input = h("input", { class: "room-name", maxlength: 80, autocomplete: "off", value: room.label ?? "", autofocus: true, "aria-label": "Name of the room" });
    return h("form", { class: "form", onsubmit: (event) => {
      event.preventDefault();
      close(input.value.trim());
    } },
    h("p", {}, `${nodes.map(nodeName).join(", ")}: these regions get one name and stay one room.`), input,
    h("div", { class: "dialog-buttons" },
      h("button", { type: "button", class: "button", onclick: () => close(undefined) }, "Cancel"),
      h("button", { type: "submit", class: "button button-primary" }, "Name them"),
    ));
  });
}
