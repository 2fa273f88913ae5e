// What a person does, and what the page does about it: the API is asked, the store is set.
import { api } from "./api.js";
import { confirmDialog } from "./dialogs.js";
import { leaveSession, showSession } from "./live.js";
import { askRing } from "./panels/ring_dialog.js";
import { showLocalizations } from "./panels/localization_actions.js";
import { announce } from "./panels/edit_actions.js";
import { ended, followJob } from "./jobs.js";
import { go, link } from "./router.js";
import { get, same, set } from "./store.js";
import { attempt, showError, single, toast } from "./toasts.js";
import { classify, sendLog, sendMap } from "./upload.js";

let stopFollowing = null;

export async function refreshLists() {
  try {
    const [logs, models, sessions] = await Promise.all([api.logs(), api.models(), api.lives()]);
    const { logs: oldLogs, models: oldModels, lives: oldLives } = get();
    const lives = sessions.filter((session) => session.status !== "ended");
    set({ logs: same(oldLogs, logs), models: same(oldModels, models), lives: same(oldLives, lives), offline: false });
  } catch (error) {
    if (error.status === 0) set({ offline: true });
    else showError(error);
  }
}

export async function showRoute(route) {
  stopFollowing?.();
  stopFollowing = null;
  set({ job: null });
  leaveSession();
  if (route.page === "log") await showLog(route.id);
  else if (route.page === "live") await showSession(route.id);
  else if (route.page === "model") await showModel(route.id);
  else set({ log: null, model: null });
  await showLocalizations(get().route);
}

async function showLog(id) {
  set({ model: null, log: get().log?.id === id ? get().log : null });
  try {
    const log = await api.log(id);
    if (get().route.id === id) set({ log });
  } catch (error) {
    leave(error);
  }
}

async function showModel(id) {
  set({ log: null, model: get().model?.id === id ? get().model : null });
  try {
    const model = await api.model(id);
    if (get().route.id !== id) return;
    set({ model });
    if (model.job_id && (model.status === "queued" || model.status === "running")) follow(model);
  } catch (error) {
    leave(error);
  }
}

function follow(model) {
  stopFollowing = followJob(model.job_id, (job) => {
    if (job.status !== get().job?.status) refreshLists();
    set({ job });
    if (!ended(job)) return;
    if (job.status === "done") toast(`${model.name} is ready.`);
    else if (job.error) showError(new Error(job.error));
    if (get().route.id !== model.id) return;
    showModel(model.id).then(() => {
      set({ job: null });
      return showLocalizations(get().route);
    });
  }, showError);
}

/** The 3D view says that labels changed, here or in another tab. */
export function takeLabels(labels) {
  const { model } = get();
  if (!model?.nodes) return;
  const known = model.nodes.every((node) => node.id in labels);
  if (!known) {
    reloadModel();
    return;
  }
  if (model.nodes.some((node) => node.label !== labels[node.id])) {
    set({ model: { ...model, nodes: model.nodes.map((node) => ({ ...node, label: labels[node.id] })) } });
    reloadModel();
  }
}

export async function reloadModel() {
  const { route, live } = get();
  const id = route.page === "live" ? live?.model_id : route.page === "model" && route.id;
  if (!id) return;
  await attempt(async () => {
    const model = await api.model(id);
    if (get().route.id === route.id) takeModel(model);
  });
}

/** Shows a model as the API tells it, unless something newer of it is shown already: answers overtake each other. */
export function takeModel(model) {
  const shown = get().model;
  if (shown?.id !== model.id || shown.revision <= model.revision) set({ model: same(shown, model) });
}

export async function labelNode(node, label) {
  const { model } = get();
  const before = model.nodes.find((item) => item.id === node)?.label ?? null;
  const show = (text) => {
    const shown = get().model;
    if (shown?.id === model.id) set({ model: { ...shown, nodes: shown.nodes.map((item) => (item.id === node ? { ...item, label: text } : item)) } });
  };
  show(label || null);
  try {
    const answer = await api.labelNode(model.id, node, label || null);
    if (get().model?.id === model.id) takeModel(answer);
    announce(answer);
    refreshLists();
  } catch (error) {
    show(before);
    showError(error);
  }
}

export async function upload(files) {
  for (const item of classify(files)) {
    const work = item.kind === "map" ? uploadMap(item) : uploadLog(item.file);
    await work.catch(showError);
  }
}

async function uploadMap({ yaml, image }) {
  const { id } = await sendMap(yaml, image, {});
  await refreshLists();
  go(link.model(id));
}

async function uploadLog(file, ring) {
  try {
    const log = await sendLog(file, ring);
    await refreshLists();
    go(link.log(log.id));
  } catch (error) {
    const needsRing = !ring && error.status === 422 && /\bring\b|sonars: Field required/i.test(error.message);
    const chosen = needsRing ? await askRing(file.name) : undefined;
    if (!chosen) throw error;
    await uploadLog(file, chosen);
  }
}

/** Starts a model; throws so that the form can show the error beside itself. */
export async function createModel(body) {
  const { id } = await api.createModel(body);
  await refreshLists();
  go(link.model(id));
}

export const addLog = single((model, log) => attempt(async () => {
  await api.addLog(model.id, log);
  await refreshLists();
  await showRoute(get().route);
}));

export async function cancelJob(id) {
  await attempt(() => api.cancelJob(id));
}

export async function rename(kind, item, name) {
  await attempt(async () => {
    const answer = await (kind === "log" ? api.renameLog(item.id, name) : api.renameModel(item.id, name));
    if (get()[kind]?.id === item.id) set({ [kind]: answer });
    await refreshLists();
  });
}

export async function remove(kind, item) {
  const text = kind === "log"
    ? "The log and its report are removed from this machine. Models that were made from it must be deleted first."
    : "The model, its map and the names of its rooms are removed from this machine. The log stays.";
  if (!(await confirmDialog(`Delete “${item.name}”?`, text, "Delete"))) return;
  await attempt(async () => {
    await (kind === "log" ? api.deleteLog(item.id) : api.deleteModel(item.id));
    toast(`${item.name} was deleted.`);
    if (get().route.page === kind && get().route.id === item.id) go(link.home());
    await refreshLists();
  });
}

function leave(error) {
  showError(error);
  if (error.status === 404) go(link.home());
}
