// Localizations of the model that is shown: the list, making one, deleting one, opening one.
import { api } from "../api.js";
import { confirmDialog } from "../dialogs.js";
import { ended, followJob } from "../jobs.js";
import { go, link } from "../router.js";
import { get, set } from "../store.js";
import { attempt, showError, toast } from "../toasts.js";

const following = new Map(); // localization id -> stop
let opened = null; // {id, plays}: what the person asked for on this page

/** What the store's `localizations` and `localization` should be at this route. */
export async function showLocalizations(route) {
  const { model } = get();
  if (route.page !== "model" || model?.id !== route.id || model.status !== "done") {
    stopFollowing();
    set({ localizations: null, localization: null });
    return;
  }
  if (get().localization?.id !== route.localization) set({ localization: null });
  await refreshLocalizations();
  if (route.localization) await openLocalization(route.localization);
}

export async function refreshLocalizations() {
  const { route } = get();
  if (route.page !== "model") return;
  try {
    const list = await api.localizations(route.id);
    if (get().route.id !== route.id) return;
    if (JSON.stringify(list) !== JSON.stringify(get().localizations)) set({ localizations: list });
    for (const item of list) if (!over(item)) follow(item);
  } catch (error) {
    if (error.status !== 0 && error.status !== 404) showError(error);
  }
}

/** Starts one and opens it; throws so that the form can show the error beside itself. */
export async function localize(body) {
  const { id } = await api.localize(body);
  play(id);
  await refreshLocalizations();
  go(link.localization(body.model_id, id));
}

/** The next time that this localization is opened it plays at once. */
export function play(id) {
  opened = { id, plays: true };
}

/** Whether it was opened by a click, not by its address. */
export function wasAskedFor(id) {
  const asked = opened?.id === id && opened.plays;
  if (asked) opened = null;
  return asked;
}

export async function removeLocalization(item) {
  const text = "What was computed is removed from this machine. The model and the log stay.";
  if (!(await confirmDialog(`Delete the localization of “${item.name}”?`, text, "Delete"))) return;
  await attempt(async () => {
    await api.deleteLocalization(item.id);
    toast(`The localization of ${item.name} was deleted.`);
    const { route } = get();
    if (route.localization === item.id) go(link.model(route.id));
    await refreshLocalizations();
  });
}

export function over(item) {
  return ended(item);
}

async function openLocalization(id) {
  try {
    const item = await api.localization(id);
    const { route } = get();
    if (route.localization !== id) return;
    if (item.model_id !== route.id) {
      go(link.localization(item.model_id, id));
      return;
    }
    const steps = item.status === "done" ? await api.localizationSteps(id) : [];
    if (get().route.localization === id) set({ localization: { ...item, steps_list: steps } });
  } catch (error) {
    showError(error);
    const { route } = get();
    if (error.status === 404 && route.localization === id) go(link.model(route.id));
  }
}

function follow(item) {
  if (following.has(item.id) || !item.job_id) return;
  const stop = followJob(item.job_id, (job) => {
    set({ localizing: { ...get().localizing, [item.id]: job } });
    if (!ended(job)) return;
    following.delete(item.id);
    const { [item.id]: _, ...others } = get().localizing;
    set({ localizing: others });
    refreshLocalizations();
    if (get().route.localization === item.id) openLocalization(item.id);
  }, () => following.delete(item.id));
  following.set(item.id, stop);
}

function stopFollowing() {
  for (const stop of following.values()) stop();
  following.clear();
}
