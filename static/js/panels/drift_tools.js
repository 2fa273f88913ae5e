// What a person says about the drift: closures judged, two places called the same, a stretch dragged.
import { api } from "../api.js";
import { refreshLists, showRoute } from "../actions.js";
import { h, replace } from "../dom.js";
import { clock } from "../format.js";
import { get, set, watch } from "../store.js";
import { attempt, single, toast } from "../toasts.js";

const NEAR_M = 1.5; // metres from the drive at which a click still means it
const APART_S = 5; // seconds between two visits of a place

/** Sends what was said; the model is made again with it. */
export const say = single(async (change) => {
  const { model, route } = get();
  set({ driftTool: null });
  const answer = await attempt(() => (change === null ? api.forgetDriftEdits(model.id) : api.editDrift(model.id, change)));
  if (!answer) return;
  refreshLists();
  if (get().route.id === route.id) await showRoute(get().route);
});

/** A click in the 3D view while the drift is shown. */
export function pointed({ point, t, away_m }) {
  const { driftTool: tool } = get();
  if (tool === null) {
    chooseNear(t, away_m);
    return;
  }
  const first = tool.t === undefined;
  if ((first || tool.op === "same_place") && away_m > NEAR_M) {
    toast("That is far from the drive; click on its line.", { kind: "error" });
  } else if (first) {
    set({ driftTool: { ...tool, t } });
  } else if (tool.op === "drag") {
    say({ op: "drag", t: tool.t, x: point[0], y: point[1] });
  } else if (Math.abs(t - tool.t) < APART_S) {
    toast("That is the same visit of the place; click where the drive comes back to it.", { kind: "error" });
  } else {
    say({ op: "same_place", t_source: Math.min(t, tool.t), t_target: Math.max(t, tool.t) });
  }
}

/** Without a tool a click looks at the closure that ends nearest. */
function chooseNear(t, away) {
  const accepted = (get().drift?.closures ?? []).filter((closure) => closure.accepted);
  const gap = (closure) => Math.min(Math.abs(closure.t_source - t), Math.abs(closure.t_target - t));
  const nearest = accepted.sort((a, b) => gap(a) - gap(b))[0];
  set({ driftClosure: nearest && away <= NEAR_M && gap(nearest) <= APART_S ? nearest.id : null });
}

export function driftTools(root) {
  const button = (op, text, tip) => h("button", {
    type: "button", class: "button", title: tip, dataset: { op },
    onclick: () => set({ driftTool: get().driftTool?.op === op ? null : { op }, ...(op === "drag" && { driftShare: 1 }) }),
  }, text);
  const buttons = [
    button("same_place", "Same place…", "two moments at which the robot was at one place"),
    button("drag", "Drag a stretch…", "a place of the drive that belongs elsewhere"),
  ];
  const help = h("p", { class: "drift-help", role: "status" });
  replace(root, h("h2", {}, "Say more"), h("div", { class: "drift-buttons" }, buttons), help);
  watch(["driftTool", "drift"], ({ driftTool, drift }) => {
    for (const item of buttons) item.setAttribute("aria-pressed", String(driftTool?.op === item.dataset.op));
    help.hidden = driftTool === null;
    if (driftTool === null) return;
    replace(help, words(driftTool, drift), " ", h("button", { type: "button", class: "link-button", onclick: () => set({ driftTool: null }) }, "Cancel"));
  });
}

function words({ op, t }, drift) {
  const at = t === undefined ? "" : clock(t - drift.trajectory[0][0]);
  if (op === "drag") return at ? `Now click where the robot was at ${at}.` : "Click the place of the drive that lies wrong.";
  return at ? `Now click the drive where it was at the same place as at ${at}.` : "Click the drive at a place that it comes back to.";
}
