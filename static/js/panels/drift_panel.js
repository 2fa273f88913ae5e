// The right column while one looks at the drift of a drive: what was found, and what can be said about it.
import { api } from "../api.js";
import { h, icon, replace } from "../dom.js";
import { clock } from "../format.js";
import { link } from "../router.js";
import { get, set, watch } from "../store.js";
import { attempt, toast } from "../toasts.js";
import { driftTools, say } from "./drift_tools.js";
import { editHistory } from "./edit_history.js";

const MADE_AT = { raw: "the odometry as it is", calibrated: "calibrated odometry", corrected: "the corrected trajectory" };
const MOST_REJECTED = 40; // of the closures that were not believed, the best ones

export function driftPanel(root) {
  const head = h("header", { class: "localization-head" });
  const history = h("div", { class: "edit-history", role: "group", "aria-label": "Undo and redo" });
  const note = h("div", { class: "localization-note", role: "status" });
  const slider = h("section", { class: "drift-slider" });
  const found = h("section", {});
  const tools = h("section", {});
  const said = h("section", {});
  const closures = h("section", {});
  const parts = [slider, found, tools, said, closures];
  replace(root, head, note, ...parts);
  editHistory(history);
  driftSlider(slider);
  driftTools(tools);
  watch(["route", "model", "drift"], ({ route, model, drift }) => {
    if (!route.drift || !model) return;
    replace(head, h("a", { class: "back", href: link.model(model.id) }, icon("left"), "Rooms"),
      h("h2", { class: "drift-title" }, "Drift of the drive", history),
      drift?.used && h("p", { class: "muted" }, `The map was made at ${MADE_AT[drift.used]}.`));
    replace(note, drift === null ? h("p", { class: "muted" }, "Loading…") : drift.missing && nothing());
    for (const part of parts) part.hidden = !drift?.used;
    if (!drift?.used) return;
    replace(found, ...findings(drift));
    replace(said, ...wordsOf(drift));
    replace(closures, ...listed(drift));
  });
  watch(["driftClosure"], ({ driftClosure }) => {
    for (const item of closures.querySelectorAll("li")) item.classList.toggle("chosen", item.dataset.closure === driftClosure);
    closures.querySelector("li.chosen")?.scrollIntoView({ block: "nearest" });
  });
}

function nothing() {
  return [h("h3", {}, "No drive"), h("p", { class: "muted" }, "This model was made of a map, or by an earlier version. Model the log again to see its drift.")];
}

function driftSlider(root) {
  const range = h("input", { type: "range", min: 0, max: 1, step: 0.05, class: "scrubber", "aria-label": "From raw odometry to corrected", oninput: () => set({ driftShare: Number(range.value) }) });
  replace(root, h("button", { type: "button", class: "link-button drift-raw", onclick: () => set({ driftShare: 0 }) }, "Raw"), range,
    h("button", { type: "button", class: "link-button", onclick: () => set({ driftShare: 1 }) }, "Corrected"));
  watch(["driftShare"], ({ driftShare }) => {
    range.value = driftShare;
    range.style.setProperty("--share", driftShare);
    range.setAttribute("aria-valuetext", `${Math.round(100 * driftShare)} % corrected`);
  });
}

function findings({ sentences, calibration }) {
  const facts = calibration && [
    ["Distance", 100 * calibration.distance_scale, 100 * calibration.distance_scale_sigma, "%"],
    ["Turns", 100 * calibration.turn_scale, 100 * calibration.turn_scale_sigma, "%"],
    ["Drift", degrees(calibration.drift_per_metre), degrees(calibration.drift_per_metre_sigma), "°/m"],
  ];
  return [h("h2", {}, "What was found"), h("ul", { class: "drift-found" }, sentences.map((text) => h("li", {}, text))),
    facts && h("p", { class: "muted drift-odometry" }, "The odometry, measured against true:"),
    facts && h("dl", { class: "facts" }, facts.map(([name, value, sigma, unit]) => [h("dt", {}, name), h("dd", {}, `${signed(value)} ± ${sigma.toFixed(2)} ${unit}`)])),
    facts && h("p", { class: "grew" }, h("button", { type: "button", class: "button", onclick: keep }, "Keep for this robot"))];
}

async function keep() {
  const kept = await attempt(() => api.keepCalibration(get().model.id));
  if (kept) toast("Kept: it is offered for the next logs of robots with this sonar ring.");
}

function degrees(radians) {
  return (180 * radians) / Math.PI;
}

function signed(value) {
  return `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(2)}`;
}

/** What a person has said so far, each with the way to take it back. */
function wordsOf(drift) {
  const rows = saidRows(drift);
  if (!rows.length) return [];
  const remove = (text, change) => h("button", { type: "button", class: "link-button", "aria-label": `Remove: ${text}`, onclick: () => say(change) }, "Remove");
  return [h("h2", {}, "Said so far"), h("ul", { class: "drift-said" }, rows.map(([text, change]) => h("li", {}, h("span", {}, text), remove(text, change)))),
    rows.length > 1 && h("p", { class: "grew" }, h("button", { type: "button", class: "button", onclick: () => say(null) }, "Take all of it back"))];
}

/** What was said, in words, and the edit that takes it back. */
function saidRows({ trajectory, edits }) {
  const { rejected = [], accepted = [], same_places = [], dragged = [] } = edits;
  const at = (t) => clock(t - trajectory[0][0]);
  const both = (source, target) => `${at(source)} and ${at(target)}`;
  const ends = (id) => both(...id.slice(1).split("_").map((millis) => Number(millis) / 1000));
  const judged = (ids, verdict) => ids.map((id) => [`${ends(id)} are ${verdict}`, { op: "forget", closure: id }]);
  return [
    ...judged(rejected, "not the same place"),
    ...judged(accepted, "the same place, as the sonar thought"),
    ...same_places.map(({ t_source, t_target }) => [`${both(t_source, t_target)} are the same place`, { op: "forget_same_place", t_source, t_target }]),
    ...dragged.map(({ t, x, y }) => [`${at(t)} belongs at (${x.toFixed(1)}, ${y.toFixed(1)})`, { op: "forget_drag", t }]),
  ];
}

function listed(drift) {
  const byScore = (a, b) => b.score - a.score;
  const used = drift.closures.filter((closure) => closure.accepted).sort((a, b) => a.t_target - b.t_target);
  const others = drift.closures.filter((closure) => !closure.accepted);
  const shown = [...others.filter((closure) => closure.by_person), ...others.filter((closure) => !closure.by_person).sort(byScore).slice(0, MOST_REJECTED)];
  const items = (list) => h("ul", { class: "closures" }, list.map((closure) => item(closure, drift)));
  return [
    h("h2", {}, "Places found again", h("small", {}, `${used.length} used`)),
    used.length ? items(used) : h("p", { class: "nothing" }, "None: the robot came nowhere twice, or the sonar could not tell."),
    shown.length > 0 && h("details", { class: "advanced", open: shown.some((closure) => closure.by_person) }, h("summary", {}, `Not used: ${others.length}${others.length > shown.length ? `, the best ${shown.length}` : ""}`), items(shown)),
  ];
}

function item(closure, drift) {
  const at = (t) => clock(t - drift.trajectory[0][0]);
  const name = `${at(closure.t_source)} – ${at(closure.t_target)}`;
  const judge = (op, text) => h("button", { type: "button", class: "link-button", "aria-label": `${text} ${name}`, onclick: () => say({ op, closure: closure.id }) }, text);
  const look = () => set({ driftClosure: closure.id });
  const way = closure.by_person && isJudged(closure, drift.edits) ? judge("forget", "Undo") : closure.by_person ? null : closure.accepted ? judge("reject", "Reject") : judge("accept", "Accept");
  return h("li", { class: closure.id === get().driftClosure ? "chosen" : "", dataset: { closure: closure.id }, onmouseenter: look, onfocusin: look },
    h("button", { type: "button", class: "closure", onclick: look },
      h("span", { class: `key ${closure.accepted ? "key-extracted" : "key-rejected"}` }),
      h("span", { class: "closure-name" }, name), h("span", { class: "closure-score", title: "agreement of the two local maps" }, closure.score.toFixed(2)),
      h("span", { class: "closure-why" }, closure.reason)),
    way);
}

function isJudged(closure, edits) {
  return [...(edits.rejected ?? []), ...(edits.accepted ?? [])].includes(closure.id);
}
