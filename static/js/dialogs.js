// Modal dialogs on the browser's own <dialog>: focus is kept inside, Escape closes.
import { h, iconButton } from "./dom.js";

/** Opens a dialog; `content(close)` gives its body. Resolves with what `close` was called with. */
export function openDialog(title, content, { wide = false } = {}) {
  return new Promise((resolve) => {
    const close = (result) => {
      dialog.close();
      dialog.remove();
      resolve(result);
    };
    const dialog = h("dialog", { class: wide ? "dialog dialog-wide" : "dialog", "aria-labelledby": "dialog-title" },
      h("header", {}, h("h2", { id: "dialog-title" }, title), iconButton("close", "Close", () => close(undefined))),
      content(close),
    );
    dialog.addEventListener("cancel", (event) => {
      event.preventDefault();
      close(undefined);
    });
    dialog.addEventListener("click", (event) => {
      if (event.target === dialog) close(undefined);
    });
    document.body.append(dialog);
    dialog.showModal();
    dialog.querySelector("[autofocus]")?.focus();
  });
}

/** Asks before something that cannot be undone. */
export function confirmDialog(title, text, verb) {
  return openDialog(title, (close) => h("div", {},
    h("p", {}, text),
    h("div", { class: "dialog-buttons" },
      h("button", { type: "button", class: "button", onclick: () => close(false) }, "Cancel"),
      h("button", { type: "button", class: "button button-danger", autofocus: true, onclick: () => close(true) }, verb),
    ),
  )).then(Boolean);
}
