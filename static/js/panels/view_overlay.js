// What lies over the 3D view: waiting, a lost connection, measuring.
import { h, replace } from "../dom.js";
import { metres } from "../format.js";
import { watch } from "../store.js";
import { measure } from "../view3d.js";

export function viewOverlay(root) {
  const veil = h("div", { class: "veil", role: "status" });
  const strip = h("div", { class: "strip", role: "status" });
  root.append(veil, strip);
  let wasReady = false;
  watch(["connection", "measuring", "measured"], ({ connection, measuring, measured }) => {
    if (connection === "ready") wasReady = true;
    if (connection === "none" || connection === "connecting") wasReady = false;
    veil.hidden = connection === "ready" || wasReady;
    replace(veil, h("span", { class: "spinner" }), connection === "lost" ? "The 3D view cannot be reached; trying again…" : "Setting up the 3D view…");
    strip.hidden = !(measuring || (connection === "lost" && wasReady));
    strip.classList.toggle("bad", connection === "lost");
    replace(strip, connection === "lost" ? "The connection was lost; trying again…" : measureText(measured),
      measuring && connection !== "lost" && h("button", { type: "button", class: "link-button", onclick: () => measure(false) }, "Done"));
  });
}

function measureText(measured) {
  if (measured?.distance_m !== null && measured?.distance_m !== undefined) {
    return [h("strong", {}, metres(measured.distance_m, 2)), " Click again to measure anew."];
  }
  return measured?.points.length ? "Now click the other end." : "Click two points on the floor.";
}
