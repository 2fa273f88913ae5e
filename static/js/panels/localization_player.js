// What the 3D view shows of the step of a localization that is played.
import { get, set, watch } from "../store.js";
import { showBelief } from "../view3d.js";
import { wasAskedFor } from "./localization_actions.js";
import { currentFrame, pause, playPause } from "./player.js";

const MOST_TEMPLATE_POINTS = 400;

export function startLocalizationPlayer() {
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
  watch(["localization", "stepIndex", "route"], () => showBelief(beliefOf(currentStep())));
}

/** The step of a localization that is shown, or null. */
export function currentStep() {
  return get().route.localization ? currentFrame() : null;
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
