// Driving by hand: W A S D or the arrows while the map (or nothing) has the focus, or the pad.
import { h } from "../dom.js";
import { tellRobot } from "../live.js";
import { get, watch } from "../store.js";
import { driveKeys } from "../view3d.js";

const SPEED_MPS = 0.25;
const TURN_RADPS = 0.8;
const AGAIN_MS = 350; // a command holds for one simulated second, shorter when time runs faster
const WAYS = { w: "ahead", arrowup: "ahead", s: "back", arrowdown: "back", a: "left", arrowleft: "left", d: "right", arrowright: "right" };
const ARROWS = { ahead: "↑", left: "↰", right: "↱", back: "↓" };
const TIPS = { ahead: "Ahead (W)", left: "Turn left (A)", right: "Turn right (D)", back: "Back (S)" };

const held = new Set();
let timer = null;

export function startDriving() {
  watch(["robot", "route"], () => driveKeys(canDrive()));
  addEventListener("keydown", (event) => own(event) && driveByKey(event.key, true), true);
  addEventListener("keyup", (event) => own(event) && driveByKey(event.key, false), true);
  addEventListener("blur", () => setTimeout(() => document.hasFocus() || letGo()));
}

/** A key went down or up, here or in the 3D view. */
export function driveByKey(key, down) {
  hold(WAYS[key.toLowerCase()], down);
}

/** Four buttons for fingers and mice. */
export function drivePad() {
  return h("div", { class: "pad", role: "group", "aria-label": "Drive" }, Object.entries(ARROWS).map(([way, text]) => {
    const button = h("button", { type: "button", class: `button pad-${way}`, title: TIPS[way], "aria-label": TIPS[way] }, text);
    button.addEventListener("pointerdown", (event) => {
      button.setPointerCapture(event.pointerId);
      hold(way, true);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) button.addEventListener(end, () => hold(way, false));
    return button;
  }));
}

function own(event) {
  if (!canDrive() || event.ctrlKey || event.metaKey || event.altKey || !(event.key.toLowerCase() in WAYS)) return false;
  if (document.querySelector("dialog[open]")) return false;
  const focused = event.target instanceof Element && event.target.closest("input, textarea, select, [contenteditable]");
  if (focused && event.type === "keydown") return false;
  event.preventDefault();
  event.stopImmediatePropagation();
  return true;
}

function canDrive() {
  const { robot, route } = get();
  return route.page === "live" && robot !== null && !robot.ended && robot.task !== "waiting";
}

function hold(way, down) {
  if (!way || held.has(way) === down) return;
  if (down) held.add(way);
  else held.delete(way);
  if (held.size === 0) {
    letGo();
    return;
  }
  send();
  timer ??= setInterval(send, AGAIN_MS / Math.max(1, get().robot?.speed ?? 1));
}

function send() {
  if (!canDrive()) {
    letGo();
    return;
  }
  const speed = SPEED_MPS * (held.has("ahead") - held.has("back"));
  const turn = TURN_RADPS * (held.has("left") - held.has("right"));
  tellRobot({ type: "drive", speed, turn_rate: turn });
}

function letGo() {
  const drove = timer !== null;
  clearInterval(timer);
  timer = null;
  held.clear();
  if (drove && canDrive()) tellRobot({ type: "stop" });
}
