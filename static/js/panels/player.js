// Playing steps one after the other: of a localization, or of the drive along which a model grew.
import { get, set } from "../store.js";

export const SPEEDS = [0.5, 1, 2, 4, 8]; // steps a second
let timer = null;

/** The steps that are open, none if nothing is. */
export function frames() {
  const { localization, route, timeline } = get();
  return (route.growth ? timeline : localization?.steps_list) ?? [];
}

/** The step that is shown, or null. */
export function currentFrame() {
  return frames()[get().stepIndex] ?? null;
}

export function isOpen() {
  return currentFrame() !== null;
}

/** Goes to a step; what plays goes on from there. */
export function goTo(index) {
  set({ stepIndex: Math.max(0, Math.min(frames().length - 1, index)), decision: null });
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
  if (get().stepIndex >= frames().length - 1) goTo(0);
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
    if (get().stepIndex >= frames().length - 1) {
      pause();
      return;
    }
    goTo(get().stepIndex + 1);
    schedule();
  }, 1000 / get().speed);
}
