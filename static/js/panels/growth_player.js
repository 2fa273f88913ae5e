// How a model grew along its drive: loading the moments, and what the 3D view shows of one.
import { api } from "../api.js";
import { get, same, set, watch } from "../store.js";
import { showError } from "../toasts.js";
import { showMoment } from "../view3d.js";
import { currentFrame, pause } from "./player.js";

export function startGrowthPlayer() {
  let loaded = null; // the model and revision whose moments are there
  watch(["route", "model"], ({ route, model }) => {
    const wanted = route.growth && model?.id === route.id && model.status === "done" ? `${model.id} ${model.revision}` : null;
    if (wanted === loaded) return;
    const isNewer = wanted !== null && loaded?.startsWith(`${model.id} `); // a name was given: the drive is the same
    loaded = wanted;
    if (!isNewer) {
      pause();
      set({ timeline: null, stepIndex: 0, decision: null });
    }
    if (wanted !== null) load(model.id, () => loaded === wanted);
  });
  watch(["route", "timeline", "stepIndex", "decision"], ({ route, stepIndex, decision }) => {
    showMoment(route.growth && currentFrame() ? { step: stepIndex, decision } : null);
  });
}

async function load(model, stillWanted) {
  try {
    const timeline = await api.timeline(model);
    if (!stillWanted()) return;
    const { timeline: before, stepIndex } = get();
    set({ timeline: same(before, timeline), stepIndex: before ? Math.max(0, Math.min(stepIndex, timeline.length - 1)) : firstOfInterest(timeline) });
  } catch (error) {
    if (stillWanted()) set({ timeline: [] });
    showError(error);
  }
}

/** The first step at which something was extracted: earlier ones only wait. */
function firstOfInterest(timeline) {
  return Math.max(0, timeline.findIndex((moment) => moment.decisions.some((decision) => decision.accepted)));
}

/** The decision that is looked at in the moment that is shown, or null. */
export function chosenDecision() {
  return currentFrame()?.decisions[get().decision] ?? null;
}
