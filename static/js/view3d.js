// The 3D view in an iframe, and the channel over which the page and its view talk.
import { h } from "./dom.js";
import { token } from "./format.js";
import { press } from "./shortcuts.js";
import { get, same, set } from "./store.js";
import { onTheme, theme } from "./theme.js";
import { watchSize } from "./view_size.js";

const TAB_KEY = "echorooms.tab";
const RETRY_MS = [500, 1000, 2000, 4000, 8000];
const NO_SUCH_MODEL = 4404;
const PASSED_ON = { picked: "onPicked", track: "onTrack", pointed: "onPointed" };
/** `?fixedDpr=0.5` in the page's address makes the 3D view coarser, for slow machines. */
export const SHARPNESS = /^\?fixedDpr=[\d.]+$/.test(location.search) ? location.search : "";

let current = null; // {model, socket, frame, tries, timer}
let belief = null; // what is played
let moment = null; // {step, decision} of the drive that is shown instead of the finished model
let drives = false; // whether the camera's keys drive a robot
const handlers = {};
const connected = new Set();

/** Hears what the view says: onLabels, onSelected, onChanged, onDeleted, onPicked, onTrack, onPointed, onDrive. */
export function onView(events) {
  Object.assign(handlers, events);
}

/** Calls back whenever the channel to the view is there (again). */
export function onConnected(callback) {
  connected.add(callback);
}

/** Shows a model in `frameBox`; the same model again changes nothing. */
export function openView(model, frameBox) {
  if (current?.model === model && current.frame.isConnected) return;
  closeView();
  const frame = h("iframe", {
    class: "view3d",
    title: "3D view of the map",
    src: `view/${encodeURIComponent(model)}/tab/${tabToken()}/${SHARPNESS}`,
  });
  frame.addEventListener("load", () => {
    sendTheme();
    sendKeys();
  });
  current = { model, frame, socket: null, tries: 0, timer: null, tellSize: watchSize(frame, tell) };
  set({ connection: "connecting", selected: null, colours: {}, measuring: false, measured: null, view: "3d" });
  frameBox.prepend(frame); // below the strips
  connect(current);
}

export function closeView() {
  if (!current) return;
  const closing = current;
  current = null;
  clearTimeout(closing.timer);
  closing.socket?.close();
  closing.frame.remove();
  set({ connection: "none", selected: null, measuring: false, measured: null });
}

/** The canvas that the scene is drawn on; viser has another, empty one for selecting rectangles. */
export function frameCanvas() {
  const canvases = current?.frame.contentDocument?.querySelectorAll("canvas") ?? [];
  return [...canvases].find((canvas) => canvas.width > 0) ?? null;
}

export function focusView() {
  current?.frame.focus();
}

/** Sends a message to the view of the open model. */
export function tell(message) {
  if (current?.socket?.readyState === WebSocket.OPEN) current.socket.send(JSON.stringify(message));
}

/** Selects a node, and others beside it. */
export function select(node, picked = []) {
  set({ selected: node, picked });
  tell({ type: "select", node, others: picked });
}

export function showLayer(name, shown) {
  set({ layers: { ...get().layers, [name]: shown } });
  tell({ type: "layers", layers: { [name]: shown } });
}

export function moveCamera(view) {
  tell({ type: "camera", view });
}

export function measure(on) {
  set({ measuring: on, measured: null });
  tell({ type: "measure", on });
}

/** Shows the belief of a step of a localization; null ends it. */
export function showBelief(next) {
  if (next === belief) return;
  belief = next;
  tell({ type: "playback", belief });
  sendKeys();
}

/** Shows a moment of the drive instead of the finished model; null ends it. */
export function showMoment(next) {
  if (JSON.stringify(next) === JSON.stringify(moment)) return;
  moment = next;
  tell({ type: "moment", step: null, ...moment });
  sendKeys();
}

/** How a live session is drawn: {follow, paused, at}. */
export function showLive(liveView) {
  set({ liveView });
  tell({ type: "live", ...liveView });
}

/** Whether the next clicks are places on the floor, told to onPicked. */
export function pick(on) {
  tell({ type: "pick", on });
}

/** Whether the keys W A S D and the arrows drive a robot, not the camera; told to onDrive. */
export function driveKeys(on) {
  drives = on;
  sendKeys();
}

function connect(view) {
  const socket = new WebSocket(new URL(
    `view/${encodeURIComponent(view.model)}/events?tab=${tabToken()}`, document.baseURI,
  ).href.replace(/^http/, "ws"));
  view.socket = socket;
  socket.onopen = () => {
    view.tries = 0;
    tell({ type: "theme", theme: theme() });
    tell({ type: "playback", belief });
    if (moment) tell({ type: "moment", ...moment });
    tell({ type: "live", ...get().liveView });
    tell({ type: "pick", on: get().picking !== null });
    view.tellSize();
    for (const callback of connected) callback();
  };
  socket.onmessage = (event) => {
    if (view === current) hear(JSON.parse(event.data));
  };
  socket.onclose = (event) => {
    if (view !== current) return;
    set({ connection: "lost" });
    if (event.code === NO_SUCH_MODEL) return;
    view.timer = setTimeout(() => connect(view), RETRY_MS[Math.min(view.tries, RETRY_MS.length - 1)]);
    view.tries += 1;
  };
}

function hear(message) {
  switch (message.type) {
    case "hello":
      set({ colours: same(get().colours, message.colours) });
      greet(message);
      handlers.onLabels?.(message.labels);
      break;
    case "ready":
      set({ connection: message.connected ? "ready" : get().connection === "ready" ? "lost" : "connecting" });
      break;
    case "selected":
      set({ selected: message.node, picked: [] });
      handlers.onSelected?.(message.node);
      break;
    case "labels":
      set({ colours: same(get().colours, message.colours) });
      handlers.onLabels?.(message.labels);
      break;
    case "camera":
      set({ view: message.view });
      break;
    case "measured":
      set({ measured: message });
      break;
    case "model_changed":
      handlers.onChanged?.(current.model);
      break;
    case "model_deleted":
      handlers.onDeleted?.(current.model);
      break;
    default:
      handlers[PASSED_ON[message.type]]?.(message);
  }
}

/** The first time the view says what this tab shows; after a lost connection, or a click meanwhile, the page does. */
function greet({ layers, selected }) {
  if (!current.greeted) set({ layers });
  else tell({ type: "layers", layers: get().layers });
  if (!current.greeted && get().selected === null) set({ selected, picked: [] });
  else select(get().selected, get().picked);
  current.greeted = true;
}

function sendTheme() {
  current?.frame.contentWindow?.postMessage({ type: "theme", theme: theme() }, location.origin);
}

/** While something is played, the arrows left and right are the player's, not the camera's. */
function sendKeys() {
  current?.frame.contentWindow?.postMessage({ type: "keys", player: belief !== null || moment !== null, drives }, location.origin);
}

/** One token per tab; a copied tab gets its own, since session storage is copied with it. */
export function tabToken() {
  if (!tabToken.value) {
    const navigation = performance.getEntriesByType("navigation")[0]?.type;
    let kept = null;
    try {
      kept = navigation === "reload" ? sessionStorage.getItem(TAB_KEY) : null;
    } catch {
      kept = null;
    }
    tabToken.value = kept ?? token();
    try {
      sessionStorage.setItem(TAB_KEY, tabToken.value);
    } catch {
      // Without storage a reload is a new tab.
    }
  }
  return tabToken.value;
}

addEventListener("message", (event) => {
  if (event.origin !== location.origin || event.source !== current?.frame.contentWindow) return;
  if (event.data?.type === "drive") handlers.onDrive?.(String(event.data.key), event.data.down === true);
});
addEventListener("view-key", (event) => {
  const { frame, ...key } = event.detail;
  if (frame === current?.frame.contentWindow && press({ ...key, target: null })) event.preventDefault();
});
onTheme((chosen) => {
  sendTheme();
  tell({ type: "theme", theme: chosen });
});
