// A live session on the page: what it tells over its events, and the simulated robot that feeds it.
import { api, files } from "./api.js";
import { reloadModel, refreshLists } from "./actions.js";
import { go, link } from "./router.js";
import { get, set, watch } from "./store.js";
import { attempt, showError, toast } from "./toasts.js";
import { showLive } from "./view3d.js";

const ASK_MS = 1000;
const RETRY_MS = 1500;
const LOOK_MS = 3000;
const NOW = { follow: false, paused: false, at: null };
const NOTHING = { live: null, robot: null, livePose: null, liveBelief: null, liveBehind: 0, liveMapped: null, picking: null };
const ENDED = 4409;
const NO_SUCH_SESSION = 4404;

let shown = null; // {id, socket, timer, first, over}

/** Shows a session: asks for it, listens to it. */
export async function showSession(id) {
  set({ ...NOTHING, log: null, model: null });
  const here = { id, socket: null, timer: null, first: null, over: false };
  shown = here;
  try {
    const [live, robots] = await Promise.all([api.live(id), api.robots()]);
    if (shown !== here) return;
    if (live.status === "ended") {
      leaveFor(live);
      return;
    }
    set({ live, robot: robots.find((robot) => robot.session_id === id && !robot.ended) ?? null });
    showLive(NOW);
    listen(here);
    here.timer = setInterval(() => askRobot(here), ASK_MS);
    reloadModel();
  } catch (error) {
    showError(error);
    if (error.status === 404) go(link.home());
  }
}

export function leaveSession() {
  if (!shown) return;
  clearInterval(shown.timer);
  shown.socket?.close();
  shown = null;
  set(NOTHING);
}

/** A page that was opened without saying what to show, shows a robot as soon as one drives. */
export function watchWhatDrives() {
  if (location.hash !== "") return;
  const looking = setInterval(() => (location.hash === "" ? refreshLists() : clearInterval(looking)), LOOK_MS);
  const stop = watch(["lives"], ({ lives }) => {
    if (location.hash !== "") queueMicrotask(() => stop());
    else if (lives?.length) go(link.live(lives[0].id));
  });
}

/** The 3D view says from when on it can look back. */
export function takeSpan({ first_t: first }) {
  if (shown) shown.first = first;
}

/** Seconds: from when to when the session can be looked at, null before the first scan. */
export function span() {
  const last = get().livePose?.t ?? get().live?.last_t ?? null;
  return last === null ? null : { first: shown?.first ?? last, last };
}

/** Tells the simulated robot something; its answer is shown, its refusal said. */
export async function tellRobot(command) {
  const { robot } = get();
  if (!robot) return undefined;
  return attempt(async () => {
    const answer = await api.tellRobot(robot.id, command);
    if (get().robot?.id === robot.id) set({ robot: answer });
    return answer;
  });
}

/** Ends the session: a log and its model stay. */
export async function finish() {
  const { robot, live } = get();
  await attempt(() => (robot ? api.removeRobot(robot.id) : api.finishLive(live.id)));
  if (get().live?.id === live.id) set({ robot: null, live: { ...live, status: "finishing" } });
}

/** Keeps what is there so far as a log and a model of its own; the session goes on. */
export async function saveSoFar() {
  await attempt(async () => {
    const { id } = await api.saveLive(get().live.id);
    await refreshLists();
    toast("Saved as a log; its model is being made.", { action: { label: "Open", run: () => go(link.model(id)) } });
  });
}

function listen(here) {
  const socket = new WebSocket(files.liveEvents(here.id));
  here.socket = socket;
  socket.onmessage = (event) => {
    if (shown === here) hear(here, JSON.parse(event.data));
  };
  socket.onclose = ({ code }) => {
    if (shown !== here || here.over) return;
    if (code === ENDED || code === NO_SUCH_SESSION) ended(here);
    else setTimeout(() => shown === here && listen(here), RETRY_MS);
  };
}

function hear(here, event) {
  if (event.type === "pose") {
    here.first ??= event.t;
    set({ livePose: event, live: { ...get().live, stored: event.stored, last_t: event.t } });
  } else if (event.type === "belief") {
    set({ liveBelief: event });
  } else if (event.type === "behind") {
    set({ liveBehind: event.seconds });
  } else if (event.type === "map") {
    set({ liveBehind: 0, liveMapped: event.t });
  } else if (event.type === "nodes") {
    reloadModel();
  } else if (event.type === "ended") {
    ended(here);
  }
}

/** The session is over; a simulated robot that goes on localizing takes the page with it. */
async function ended(here) {
  here.over = true;
  refreshLists();
  await attempt(async () => {
    const { robot } = get();
    const drives = robot && (await api.robot(robot.id).then((answer) => !answer.ended, () => false));
    if (drives) return; // `askRobot` follows it to its next session, or sees it end
    const live = await api.live(here.id);
    if (shown === here) leaveFor(live);
  });
}

function leaveFor(live) {
  if (live.stored === 0) {
    toast("The session ended without a scan.");
    go(link.home());
    return;
  }
  toast(live.mode === "mapping" ? "The drive has ended; its model gets its last touch." : "The drive has ended; it is kept as a log.", {
    action: { label: "Open the log", run: () => go(link.log(live.log_id)) }, seconds: 10,
  });
  go(link.model(live.model_id));
}

async function askRobot(here) {
  const { robot } = get();
  if (!robot || document.visibilityState !== "visible") return;
  try {
    const answer = await api.robot(robot.id);
    if (shown !== here || get().robot?.id !== robot.id) return;
    set({ robot: answer });
    if (answer.session_id !== here.id && !answer.ended) go(link.live(answer.session_id));
    else if (answer.ended && here.over) ended(here);
  } catch (error) {
    if (error.status === 404 && shown === here) set({ robot: null });
  }
}
