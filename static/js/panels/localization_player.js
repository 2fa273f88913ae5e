// Playing a localization: which step is shown, and what the 3D view is told about it.
import { get, set, watch } from "../store.js";
import { showBelief } from "../view3d.js";
import { wasAskedFor } from "./localization_actions.js";

export const SPEEDS = [0.5, 1, 2, 4, 8]; // steps a second
const MOST_TEMPLATE_POINTS = 400;
let timer = null;

export function startPlayer() {
  let shown = null;
  let waits = false; // plays as soon as the 3D view is there
  watch(["localization", "connection"], ({ localization, connection }) => {
    const id = localization?.steps_list.length ? localization.id : null;
    if (id !== shown) {
      shown = id;
      pause();
      set({ stepIndex: 0 });
      waits = id !== null && wasAskedFor(id) && !matchMedia("(prefers-reduced-motion: reduce)").matches;
    }
    if (waits && connection === "ready") {
      waits = false;
      if (!get().playing && get().stepIndex === 0) playPause();
    }
  });
  watch(["localization", "stepIndex"], () => showBelief(beliefOf(currentStep())));
}

/** The step that is shown, or null. */
export function currentStep() {
  const { localization, stepIndex } = get();
  return localization?.steps_list[stepIndex] ?? null;
}

export function isOpen() {
  return currentStep() !== null;
}

/** Goes to a step; what plays goes on from there. */
export function goTo(index) {
  const last = (get().localization?.steps_list.length ?? 1) - 1;
  set({ stepIndex: Math.max(0, Math.min(last, index)) });
}

/** One step back or on; playing ends. */
export function step(by) {
  pause();
  goTo(get().stepIndex + by);
}

export function playPause() {
  if (get().playing) {
    pause();
    return;
  }
  const last = get().localization.steps_list.length - 1;
  if (get().stepIndex >= last) goTo(0);
  set({ playing: true });
  schedule();
}

export function pause() {
  clearTimeout(timer);
  set({ playing: false });
}

export function setSpeed(speed) {
  set({ speed });
  if (get().playing) schedule();
}

function schedule() {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const { localization, stepIndex } = get();
    if (!localization || stepIndex >= localization.steps_list.length - 1) {
      pause();
      return;
    }
    goTo(stepIndex + 1);
    schedule();
  }, 1000 / get().speed);
}

/** What the 3D view draws of a step. */
function beliefOf(step) {
  if (!step) return null;
  const every = Math.max(1, Math.ceil(step.template.length / MOST_TEMPLATE_POINTS));
  return {
    probabilities: step.probabilities,
    unknown: step.unknown,
    pose: step.pose,
    template: step.template.filter((_, index) => index % every === 0),
    candidates: Object.fromEntries(Object.entries(step.candidates).map(([node, [x, y, score]]) => [
      node, [x, y, step.candidate_headings?.[node] ?? 0, Math.max(0, Math.min(1, score))],
    ])),
  };
}
