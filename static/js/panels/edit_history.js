// Undo and redo, with what they would do.
import { iconButton, replace } from "../dom.js";
import { watch } from "../store.js";
import { redo, undo } from "./edit_actions.js";

export function editHistory(root) {
  const back = iconButton("undo", "Undo", () => undo());
  const forth = iconButton("redo", "Redo", () => redo());
  replace(root, back, forth);
  watch(["model"], ({ model }) => {
    describe(back, "Undo", "Ctrl+Z", model?.can_undo, model?.last_edit);
    describe(forth, "Redo", "Ctrl+Shift+Z", model?.can_redo, model?.undone_edit);
  });
}

function describe(button, verb, keys, possible, what) {
  button.disabled = !possible;
  button.title = possible ? `${verb}: ${what} (${keys})` : `${verb} (${keys})`;
  button.setAttribute("aria-label", possible ? `${verb}: ${what}` : verb);
}
