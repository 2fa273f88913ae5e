// Short messages in the corner; errors stay until they are closed or have been there long enough.
import { h, icon, iconButton } from "./dom.js";

const MOST = 4;

export function toast(message, { kind = "info", action = null, seconds = kind === "error" ? 12 : 5 } = {}) {
  const box = document.getElementById("toasts");
  const element = h("div", { class: `toast toast-${kind}`, role: kind === "error" ? "alert" : "status" },
    icon(kind === "error" ? "alert" : "check"),
    h("p", {}, message),
    action && h("button", { type: "button", class: "link-button", onclick: () => { close(); action.run(); } }, action.label),
    iconButton("close", "Dismiss", () => close()),
  );
  const close = () => element.remove();
  box.append(element);
  while (box.children.length > MOST) box.firstElementChild.remove();
  setTimeout(close, seconds * 1000);
  return close;
}

export function showError(error) {
  toast(error.message || "Something went wrong.", { kind: "error" });
}

/** Async work of which a second call, while it runs, does nothing: buttons are clicked twice. */
export function single(work) {
  let runs = false;
  return async (...given) => {
    if (runs) return undefined;
    runs = true;
    try {
      return await work(...given);
    } finally {
      runs = false;
    }
  };
}

/** Runs async work from an event handler; a failure becomes a toast. */
export async function attempt(work) {
  try {
    return await work();
  } catch (error) {
    showError(error);
    return undefined;
  }
}
