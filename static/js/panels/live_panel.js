// The right column of a live session: how it stands, where the robot is, what can be done with it.
import { files } from "../api.js";
import { confirmDialog } from "../dialogs.js";
import { h, replace } from "../dom.js";
import { count, duration, metres } from "../format.js";
import { finish, saveSoFar } from "../live.js";
import { link } from "../router.js";
import { watch } from "../store.js";
import { liveBelief } from "./live_belief.js";
import { liveRobot } from "./live_robot.js";

const LATE_SCANS = 20; // scans: five seconds at 4 Hz

export function livePanel(root) {
  const head = h("header", { class: "live-head" });
  const facts = h("dl", { class: "facts live-facts" });
  const belief = h("section", { class: "live-belief" });
  const robot = h("section", { class: "live-robot" });
  const keep = h("div", { class: "live-keep" });
  replace(root, head, facts, belief, robot, keep);
  liveBelief(belief);
  liveRobot(robot);
  watch(["live"], ({ live }) => {
    const key = live && `${live.id}:${live.status}`;
    if (!live || root.dataset.key === key) return;
    root.dataset.key = key;
    replace(head, ...heading(live));
    replace(keep, ...keeping(live));
  });
  watch(["live", "livePose", "liveBehind", "liveMapped", "robot"], (state) => state.live && replace(facts, ...figures(state)));
}

function heading(live) {
  const doing = live.mode === "mapping" ? "Maps a home; the model grows with the drive." : "Looks for itself in a model.";
  return [
    h("h2", {}, h("span", { class: "dot", dataset: { kind: live.status === "running" ? "busy" : "idle" } }), live.status === "running" ? "Live" : "Is being finished…"),
    h("h3", { title: live.name }, live.name),
    h("p", { class: "muted" }, doing, live.mode === "localization" && [" ", h("a", { href: link.model(live.model_id) }, "Open the model")]),
  ];
}

function figures({ live, livePose, liveBehind, liveMapped, robot }) {
  const waiting = robot?.waiting ?? 0;
  const knows = liveMapped === null || !livePose ? "–" : `knows all but the last ${duration(Math.max(0, livePose.t - liveMapped))}`;
  return [
    fact("Stored", count(live.stored, "scan"), "confirmed: they are on the disk"),
    fact("Sent, not confirmed", robot ? count(waiting, "scan") : "–", "what a crash could lose", waiting > LATE_SCANS),
    live.mode === "mapping" && fact("Model", liveBehind > 0 ? `waits ${liveBehind.toFixed(1)} s for its turn` : knows, "how far the map is behind the scans", liveBehind > 0),
    fact("Driven", livePose ? metres(livePose.distance_m) : "–"),
    fact("Time", livePose ? duration(livePose.t) : "–"),
    fact("Odometry", livePose ? `x ${livePose.pose[0].toFixed(2)}, y ${livePose.pose[1].toFixed(2)}, ${degrees(livePose.pose[2])}` : "–", "where the wheels believe to be"),
  ];
}

function keeping(live) {
  const mapping = live.mode === "mapping";
  const end = async () => {
    const text = mapping ? "What was driven so far stays as a log with its model." : "What was driven so far stays as a log.";
    if (await confirmDialog("End the session?", text, "End it")) finish();
  };
  return [
    h("h2", {}, "Keep"),
    h("p", { class: "card-buttons" },
      h("button", { type: "button", class: "button", title: "A log and a model of what there is so far; the session goes on", onclick: saveSoFar }, "Save so far"),
      h("a", { class: "button", href: files.liveLog(live.id), download: "" }, "Download the log"),
      h("button", { type: "button", class: "button", disabled: live.status !== "running", onclick: end }, "End…")),
  ];
}

function degrees(heading) {
  return `${Math.round((180 / Math.PI) * heading)}°`;
}

function fact(name, value, tip, bad = false) {
  return [h("dt", { title: tip }, name), h("dd", { class: bad ? "bad" : null }, value)];
}
