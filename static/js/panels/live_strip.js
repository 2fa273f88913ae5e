// Over the 3D view of a live session: follow, pause, look back; and what the next click is for.
import { h, icon, replace } from "../dom.js";
import { duration } from "../format.js";
import { span } from "../live.js";
import { get, watch } from "../store.js";
import { showLive } from "../view3d.js";
import { stopPicking } from "./live_robot.js";

export function pickStrip(root) {
  const strip = h("div", { class: "strip", role: "status", hidden: true });
  root.append(strip);
  watch(["picking", "connection"], ({ picking, connection }) => {
    strip.hidden = !picking || connection === "lost";
    if (picking) replace(strip, picking.text, h("button", { type: "button", class: "link-button", onclick: stopPicking }, "Cancel"));
  });
}

export function liveStrip(root) {
  const follow = h("button", { type: "button", class: "button", title: "The camera goes with the robot", onclick: () => change({ follow: !get().liveView.follow }) }, "Follow");
  const pause = h("button", { type: "button", class: "button", onclick: () => change({ paused: !get().liveView.paused }) });
  const scrubber = h("input", { type: "range", min: 0, max: 1, step: "any", class: "scrubber", "aria-label": "Look back", oninput: () => lookBack(Number(scrubber.value)) });
  const place = h("span", { class: "live-place" });
  const now = h("button", { type: "button", class: "button", onclick: () => change({ at: null, paused: false }) }, "Now");
  const marks = h("span", { class: "live-marks" }, h("span", { class: "mark mark-echo" }), "echo", h("span", { class: "mark mark-miss" }), "no echo");
  const strip = h("div", { class: "live-strip", role: "toolbar", "aria-label": "Live view", hidden: true }, follow, pause, scrubber, place, now, marks);
  root.append(strip);
  watch(["live", "livePose", "liveView", "connection"], ({ live, liveView, connection }) => {
    strip.hidden = !live || connection !== "ready";
    const range = span();
    if (strip.hidden) return;
    follow.setAttribute("aria-pressed", String(liveView.follow));
    pause.setAttribute("aria-pressed", String(liveView.paused));
    pause.title = liveView.paused ? "Draw again" : "Stop drawing; the session goes on";
    replace(pause, icon(liveView.paused ? "play" : "pause"), liveView.paused ? "Draw" : "Pause");
    now.disabled = liveView.at === null && !liveView.paused;
    scrubber.disabled = !range || range.last <= range.first;
    if (!range) return;
    if (liveView.at === null) scrubber.value = "1";
    else scrubber.value = String((liveView.at - range.first) / Math.max(range.last - range.first, 1e-9));
    place.textContent = liveView.at === null ? duration(range.last) : `${duration(range.last - liveView.at)} ago`;
  });
}

function lookBack(share) {
  const { first, last } = span();
  change({ at: share >= 0.999 ? null : first + share * (last - first) });
}

function change(changes) {
  showLive({ ...get().liveView, ...changes });
}
