// A second model beside the one that is open: its 3D view moves with the first, and looks like it.
import { h } from "./dom.js";
import { get, same, set, watch } from "./store.js";
import { onTheme, theme } from "./theme.js";
import { watchSize } from "./view_size.js";
import { SHARPNESS, onConnected, tabToken, tell as tellFirst } from "./view3d.js";

let second = null; // {model, frame, socket}

/** Shows another model beside the open one, in `box`; the same one again changes nothing. */
export function openBeside(model, box) {
  if (second?.model === model && second.frame.isConnected) return;
  closeBeside();
  const frame = h("iframe", {
    class: "view3d", title: "3D view of the other model", src: `view/${encodeURIComponent(model)}/tab/${tabToken()}/${SHARPNESS}`,
  });
  frame.addEventListener("load", sendTheme);
  second = { model, frame, socket: null, tellSize: watchSize(frame, tell) };
  box.prepend(frame);
  connect(second);
  tellFirst({ type: "beside", model });
}

export function closeBeside() {
  if (!second) return;
  const closing = second;
  second = null;
  closing.socket?.close();
  closing.frame.remove();
  tellFirst({ type: "beside", model: null });
  set({ otherColours: {} });
}

/** Marks a node of the other model; null: none. */
export function selectBeside(node) {
  tell({ type: "select", node });
}

function connect(view) {
  const socket = new WebSocket(new URL(`view/${encodeURIComponent(view.model)}/events?tab=${tabToken()}`, document.baseURI).href.replace(/^http/, "ws"));
  view.socket = socket;
  socket.onopen = () => {
    tell({ type: "theme", theme: theme() });
    tell({ type: "layers", layers: get().layers });
    view.tellSize();
    tellFirst({ type: "beside", model: view.model });
  };
  socket.onmessage = (event) => {
    const message = JSON.parse(event.data);
    if (view === second && (message.type === "hello" || message.type === "labels")) set({ otherColours: same(get().otherColours, message.colours) });
  };
  socket.onclose = () => {
    if (view === second) setTimeout(() => view === second && connect(view), 2000);
  };
}

function tell(message) {
  if (second?.socket?.readyState === WebSocket.OPEN) second.socket.send(JSON.stringify(message));
}

function sendTheme() {
  second?.frame.contentWindow?.postMessage({ type: "theme", theme: theme() }, location.origin);
}

export function startSecondView() {
  watch(["layers"], ({ layers }) => tell({ type: "layers", layers }));
  onTheme((chosen) => {
    sendTheme();
    tell({ type: "theme", theme: chosen });
  });
  onConnected(() => second && tellFirst({ type: "beside", model: second.model }));
}
