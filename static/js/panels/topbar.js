// The bar at the top: what is shown, and what can be done with the view.
import { h, icon, iconButton, replace } from "../dom.js";
import { link } from "../router.js";
import { saveScreenshot } from "../screenshot.js";
import { helpDialog } from "../shortcuts.js";
import { get, watch } from "../store.js";
import { onTheme, toggleTheme } from "../theme.js";
import { attempt } from "../toasts.js";
import { measure, moveCamera } from "../view3d.js";

const CONNECTIONS = {
  none: ["idle", "No map is open"],
  connecting: ["busy", "The 3D view is being set up"],
  ready: ["good", "Connected"],
  lost: ["bad", "The connection was lost; trying again"],
};

export function topbar(root) {
  const title = h("h1", { class: "title" });
  const dot = h("span", { class: "dot", role: "status" });
  const view3d = segment("3D", "Look from the side (1)", "3d");
  const viewTop = segment("Top", "Look straight down (2)", "top");
  const ruler = h("button", { type: "button", class: "button", title: "Measure a distance (M)", onclick: () => measure(!get().measuring) }, icon("ruler"), h("span", { class: "wide-only" }, "Measure"));
  const tools = h("div", { class: "tools", role: "toolbar", "aria-label": "3D view" },
    h("div", { class: "segments", role: "group", "aria-label": "Camera" }, view3d, viewTop),
    h("button", { type: "button", class: "button", title: "Show everything (F)", onclick: () => moveCamera("fit") }, icon("fit"), h("span", { class: "wide-only" }, "Fit")),
    ruler,
    h("button", { type: "button", class: "button", title: "Save a picture (P)", onclick: screenshot }, icon("camera"), h("span", { class: "wide-only" }, "Picture")),
  );
  const themeBox = h("span");
  replace(root,
    h("a", { class: "brand", href: link.home(), "aria-label": "EchoRooms, home" }, h("img", { src: "logo.svg", alt: "", width: 26, height: 26 }), h("span", {}, "EchoRooms")),
    title, h("span", { class: "grow" }), tools,
    iconButton("help", "Help and keys (?)", helpDialog), themeBox, dot,
  );
  onTheme((theme) => replace(themeBox, iconButton(
    theme === "dark" ? "sun" : "moon", theme === "dark" ? "Light theme (T)" : "Dark theme (T)", toggleTheme,
  )));
  watch(["model", "log", "live", "view", "connection", "measuring", "offline"], (state) => {
    const shown = state.live ?? state.model ?? state.log;
    replace(title, shown?.name ?? "");
    document.title = shown ? `${shown.name} – EchoRooms` : "EchoRooms";
    tools.hidden = state.connection === "none";
    view3d.setAttribute("aria-pressed", String(state.view === "3d"));
    viewTop.setAttribute("aria-pressed", String(state.view === "top"));
    ruler.setAttribute("aria-pressed", String(state.measuring));
    const [kind, text] = state.offline ? ["bad", "The server does not answer"] : CONNECTIONS[state.connection];
    dot.dataset.kind = kind;
    dot.title = text;
    replace(dot, h("span", { class: "unseen" }, text));
  });
}

export function screenshot() {
  return attempt(() => saveScreenshot(get().model?.name ?? "map"));
}

function segment(text, tip, view) {
  return h("button", { type: "button", title: tip, "aria-pressed": "false", onclick: () => moveCamera(view) }, text);
}
