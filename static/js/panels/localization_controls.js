// The bar below the map: play and pause, step by step, the scrubber, speed, and the step's sentence.
import { h, icon, iconButton, replace } from "../dom.js";
import { nodeName } from "../format.js";
import { get, watch } from "../store.js";
import { SPEEDS, currentStep, goTo, playPause, setSpeed, step as go } from "./localization_player.js";

export function localizationControls(root) {
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
  watch(["localization", "stepIndex", "playing", "speed", "model"], ({ localization, stepIndex, playing, speed: chosen, model }) => {
    const now = currentStep();
    root.hidden = now === null || model === null;
    if (root.hidden) return;
    const steps = localization.steps_list;
    const word = playing ? "Pause" : "Play";
    replace(play, icon(playing ? "pause" : "play"));
    play.setAttribute("aria-label", word);
    play.title = `${word} (Space)`;
    back.disabled = stepIndex === 0;
    on.disabled = stepIndex === steps.length - 1;
    scrubber.max = steps.length - 1;
    scrubber.value = stepIndex;
    scrubber.style.setProperty("--share", steps.length > 1 ? stepIndex / (steps.length - 1) : 1);
    scrubber.setAttribute("aria-valuetext", `step ${now.step} of ${steps.length}`);
    replace(place, h("strong", {}, `Step ${stepIndex + 1}`), ` of ${steps.length}`, h("span", { class: "muted" }, clock(now.t - steps[0].t)));
    speed.value = chosen;
    state.dataset.updated = String(now.updated);
    replace(state, now.updated ? "updated" : "rejected");
    state.title = now.updated ? "The readings of this step changed the belief." : "The readings of this step did not make the belief clearer: it stays as it was.";
    const sentence = inWords(now.why, model.nodes);
    replace(why, sentence);
    why.title = sentence;
  });
}

/** A step's sentence with the names that the nodes have now. */
export function inWords(sentence, nodes) {
  const names = new Map(nodes.map((node) => [node.id, nodeName(node)]));
  const told = sentence.replace(/[\w-]+/g, (word) => names.get(word) ?? word);
  return `${told.charAt(0).toUpperCase()}${told.slice(1)}${/[.!?]$/.test(told) ? "" : "."}`;
}

function clock(seconds) {
  const whole = Math.max(0, Math.round(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}
