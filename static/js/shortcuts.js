// Keys. The 3D view hands its keys over (it keeps W A S D Q E and the arrows for its camera).
import { h } from "./dom.js";
import { openDialog } from "./dialogs.js";

const shortcuts = new Map(); // key -> {run, text}

export function shortcut(key, text, run) {
  shortcuts.set(key, { run, text });
}

export function startShortcuts() {
  addEventListener("keydown", (event) => {
    if (press(event)) event.preventDefault();
  });
}

/** Runs the shortcut of a key event (or of one that the 3D view reports); true if it did something. */
export function press({ key, ctrlKey, metaKey, altKey, shiftKey, target }) {
  if (altKey || document.querySelector("dialog[open]")) return false;
  const typing = target instanceof Element && target.closest("input:not([type=checkbox]):not([type=radio]), textarea, select");
  const onlyChooses = typing && (ctrlKey || metaKey) && typing.matches("select, input[type=range]"); // nothing of its own to undo
  if (typing && !onlyChooses) return false;
  const found = shortcuts.get(nameOf(key, ctrlKey || metaKey, shiftKey));
  if (!found) return false;
  if (key === " " && target instanceof Element && target.closest("button, a, summary, input")) return false;
  return found.run() !== false;
}

/** "z", "Ctrl+z" or "Ctrl+Shift+z" (Ctrl is Cmd on a Mac); without Ctrl, Shift is part of the key. */
function nameOf(key, ctrl, shift) {
  const plain = key.length === 1 ? key.toLowerCase() : key;
  return ctrl ? `Ctrl+${shift ? "Shift+" : ""}${plain}` : plain;
}

export function helpDialog() {
  const row = (key, text) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, key)), h("td", {}, text));
  const page = (name, title, text) => h("li", {}, h("a", { href: `docs/index.html#${name}`, target: "_blank", rel: "noopener" }, title), h("span", {}, text));
  return openDialog("Help", () => h("div", { class: "help" },
    h("section", {}, h("h3", {}, "Pages"), h("ul", { class: "help-pages" },
      page("getting-started", "Getting started", "from a drive to named rooms"),
      page("rooms", "Map and rooms", "layers, camera, table, measuring"),
      page("live-robot", "A live robot", "drive one, simulated or real, and watch the model grow"),
      page("live", "Sending scans, tokens", "WebSocket, HTTP, MQTT; who may on a network"),
      page("logs", "Log files", "the formats, line by line, and the log.yaml"),
      page("api", "API by curl", "everything that this page does, from a script"),
      h("li", {}, h("a", { href: "docs", target: "_blank", rel: "noopener" }, "API reference"), h("span", {}, "every address and field")),
    )),
    h("section", {}, h("h3", {}, "Keys"),
      h("table", { class: "keys" }, h("tbody", {},
        [...shortcuts].map(([key, { text }]) => row(KEY_NAMES[key] ?? (key.length === 1 ? key.toUpperCase() : key), text)),
        row("W A S D", "move the camera (in the 3D view), or drive a live simulated robot"),
        row("← ↑ → ↓", "turn the camera (in the 3D view, while nothing is played)"),
      )),
      h("p", { class: "muted" }, "Mouse: drag turns, right drag moves, the wheel zooms; a click selects."),
    ),
  ), { wide: true });
}

const KEY_NAMES = { " ": "Space", ArrowLeft: "←", ArrowRight: "→", Escape: "Esc", "Ctrl+z": "Ctrl Z", "Ctrl+Shift+z": "Ctrl ⇧ Z" };
