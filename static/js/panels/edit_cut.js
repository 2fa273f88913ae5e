// Splitting a node: two clicks in the 3D view draw a line, a button cuts along it.
import { h, replace } from "../dom.js";
import { metres, nodeName } from "../format.js";
import { get, set, watch } from "../store.js";
import { measure } from "../view3d.js";
import { edit } from "./edit_actions.js";

/** Points are drawn as those of a measurement; the tool itself is off meanwhile. */
export function startCut(node) {
  measure(true);
  set({ measuring: false, cutting: node });
}

export function stopCut() {
  if (get().cutting === null) return;
  measure(false);
  set({ cutting: null });
}

/** The strip over the 3D view that leads through a cut. */
export function cutStrip(root) {
  const strip = h("div", { class: "strip", role: "status", hidden: true });
  root.append(strip);
  let offered = null; // the line for which Split has had the focus
  watch(["cutting", "measured", "measuring", "model", "connection", "selected"], (state) => {
    const { cutting, measured, measuring, model, connection, selected } = state;
    const node = model?.nodes?.find((item) => item.id === cutting);
    if (cutting !== null && (!node || measuring || connection === "none")) {
      set({ cutting: null });
      return;
    }
    if (cutting !== null && selected !== cutting) {
      stopCut();
      return;
    }
    strip.hidden = !node || connection === "lost";
    if (!node) return;
    const split = show(strip, node, measured);
    if (split && measured !== offered && !isTyping()) split.focus();
    offered = measured;
  });
}

/** Draws the strip; returns the button that splits once there is a line to split along. */
function show(strip, node, measured) {
  const drawn = measured?.points.length === 2;
  const split = h("button", { type: "button", class: "button button-primary", onclick: () => cut(node.id, measured.points) }, "Split");
  replace(strip, words(node, measured), drawn && split,
    h("button", { type: "button", class: "link-button", onclick: stopCut }, "Cancel"));
  return drawn ? split : null;
}

function isTyping() {
  return document.activeElement.matches("input, textarea, select");
}

function words(node, measured) {
  if (measured?.points.length === 2) return h("span", {}, "Split ", h("strong", {}, nodeName(node)), ` along ${metres(measured.distance_m, 2)}? Click again to draw anew.`);
  if (measured?.points.length) return "Now click the other end of the cut.";
  return h("span", {}, "Click where the cut through ", h("strong", {}, nodeName(node)), " begins.");
}

async function cut(node, line) {
  if (await edit({ op: "split", node, line }, () => node)) stopCut();
}
