// The bar below the map: play and pause, step by step, the scrubber, speed, and the step's sentence.
import { h, icon, iconButton, replace } from "../dom.js";
import { clock, metres, nodeName } from "../format.js";
import { get, watch } from "../store.js";
import { SPEEDS, currentFrame, frames, goTo, playPause, setSpeed, step as go } from "./player.js";

export function playerControls(root) {
  const back = iconButton("left", "One step back (←)", () => go(-1));
  const on = iconButton("right", "One step on (→)", () => go(1));
  const play = h("button", { type: "button", class: "button button-primary play", onclick: playPause });
  const scrubber = h("input", { type: "range", min: 0, step: 1, class: "scrubber", "aria-label": "Step", oninput: () => goTo(Number(scrubber.value)) });
  const place = h("span", { class: "player-place" });
  const speed = h("select", { class: "player-speed", "aria-label": "Speed", title: "steps a second", onchange: () => setSpeed(Number(speed.value)) },
    SPEEDS.map((value) => h("option", { value, selected: value === get().speed }, `${value} / s`)));
  const state = h("span", { class: "step-state" });
  const why = h("p", { class: "player-why", "aria-live": "off" });
  replace(root,
    h("div", { class: "player-row" }, back, play, on, scrubber, place, speed),
    h("div", { class: "player-row player-told" }, state, why));
  watch(["localization", "timeline", "route", "stepIndex", "playing", "speed", "model"], ({ route, stepIndex, playing, speed: chosen, model }) => {
    const now = currentFrame();
    root.hidden = now === null || model === null;
    if (root.hidden) return;
    const count = frames().length;
    const word = playing ? "Pause" : "Play";
    replace(play, icon(playing ? "pause" : "play"));
    play.setAttribute("aria-label", word);
    play.title = `${word} (Space)`;
    back.disabled = stepIndex === 0;
    on.disabled = stepIndex === count - 1;
    scrubber.max = count - 1;
    scrubber.value = stepIndex;
    scrubber.style.setProperty("--share", count > 1 ? stepIndex / (count - 1) : 1);
    scrubber.setAttribute("aria-valuetext", `step ${stepIndex + 1} of ${count}`);
    const told = route.growth ? ofGrowth(now) : ofLocalization(now, model.nodes);
    replace(place, h("strong", {}, `Step ${stepIndex + 1}`), ` of ${count}`, h("span", { class: "muted" }, told.where));
    speed.value = chosen;
    state.dataset.updated = String(told.good);
    replace(state, told.word);
    state.title = told.tip;
    replace(why, told.sentence);
    why.title = told.sentence;
  });
}

function ofLocalization(step, nodes) {
  return {
    where: clock(step.t - frames()[0].t),
    good: step.updated,
    word: step.updated ? "updated" : "rejected",
    tip: step.updated ? "The readings of this step changed the belief." : "The readings of this step did not make the belief clearer: it stays as it was.",
    sentence: inWords(step.why, nodes),
  };
}

function ofGrowth(moment) {
  const extracted = moment.decisions.filter((decision) => decision.accepted).length;
  return {
    where: `${metres(moment.distance_m, 1)} driven, ${clock(moment.t)}`,
    good: extracted > 0,
    word: extracted ? "extracted" : "waits",
    tip: extracted ? "A part of the space that was left became a region at this step." : "No part was convex, explored and far enough from the robot.",
    sentence: sentence(moment.said),
  };
}

/** A step's sentence with the names that the nodes have now. */
export function inWords(told, nodes) {
  const names = new Map(nodes.map((node) => [node.id, nodeName(node)]));
  return sentence(told.replace(/[\w-]+/g, (word) => names.get(word) ?? word));
}

function sentence(words) {
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;
}
