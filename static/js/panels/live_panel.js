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
  replace(root, head, facts, keep, belief, robot);
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
  return [
    h("h2", {}, h("span", { class: "dot", dataset: { kind: live.status === "running" ? "busy" : "idle" } }), live.status !== "running" ? "Is being finished…" : live.mode === "mapping" ? "Live: maps a home" : "Live: where is it?"),
    h("h3", { title: live.name }, live.name),
    live.mode === "localization" && h("p", { class: "muted" }, "Looks for itself in ", h("a", { href: link.model(live.model_id) }, "its model"), "."),
  ];
}

function figures({ live, livePose, liveBehind, liveMapped, robot }) {
  const waiting = robot?.waiting ?? 0;
  const stored = [count(live.stored, "scan"), waiting > 0 && `, ${waiting} on the way`].filter(Boolean).join("");
  return [
    fact("Stored", stored, "confirmed: they are on the disk; what is on the way a crash could lose", waiting > LATE_SCANS),
    live.mode === "mapping" && fact("Model", lag(livePose, liveBehind, liveMapped), "how far the map is behind the scans", liveBehind > 0),
    livePose && fact("Driven", `${metres(livePose.distance_m)} in ${duration(livePose.t)}`),
    livePose && fact("Odometry", `x ${livePose.pose[0].toFixed(2)}, y ${livePose.pose[1].toFixed(2)}, ${degrees(livePose.pose[2])}`, "where the wheels believe to be"),
  ];
}

function lag(livePose, liveBehind, liveMapped) {
  if (liveBehind > 0) return `waits ${liveBehind.toFixed(1)} s for its turn`;
  return liveMapped === null || !livePose ? "–" : `${duration(Math.max(0, livePose.t - liveMapped))} behind`;
}

function keeping(live) {
  const mapping = live.mode === "mapping";
  const end = async () => {
    const text = mapping ? "What was driven so far stays as a log with its model." : "What was driven so far stays as a log.";
    if (await confirmDialog("End the session?", text, "End it")) finish();
  };
  return [
    h("p", { class: "card-buttons" },
      h("button", { type: "button", class: "button", title: "A log and a model of what there is so far; the session goes on", onclick: saveSoFar }, "Save so far"),
      h("a", { class: "button", href: files.liveLog(live.id), download: "" }, "Get the log"),
      h("button", { type: "button", class: "button", disabled: live.status !== "running", onclick: end }, "End…")),
  ];
}

function degrees(heading) {
  return `${Math.round((180 / Math.PI) * heading)}°`;
}

function fact(name, value, tip, bad = false) {
  return [h("dt", { title: tip }, name), h("dd", { class: bad ? "bad" : null }, value)];
}
