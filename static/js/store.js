// What the page knows. Panels read it and hear of the keys that they draw.

const state = {
  logs: null, // summaries, null until loaded
  models: null,
  route: { page: "home", id: null, localization: null, growth: false, drift: false, compare: null },
  log: null, // detail of the log that is shown
  model: null, // detail of the model that is shown
  job: null, // the job that makes the shown model
  localizations: null, // summaries of those in the shown model, null until loaded
  localizing: {}, // localization id -> its job while it runs
  localization: null, // the one that is open, with its steps as `steps_list`
  timeline: null, // the moments of the drive along which the shown model grew, null until loaded
  decision: null, // which tentative part of the shown moment is looked at, from 0
  stepIndex: 0, // which step of a localization or of the timeline is shown, from 0
  playing: false,
  speed: 1, // steps a second
  drift: null, // what the API tells of the drift of the shown model's drive, null until loaded
  driftShare: 1, // where the 3D view shows the drive: 0 at the odometry, 1 corrected
  driftClosure: null, // id of the closure that is looked at
  driftTool: null, // what clicks in the 3D view say: {op: same_place | drag, t}; `t` (s): the first place
  selected: null, // node id
  picked: [], // ids of nodes selected beside it
  cutting: null, // id of the node that is being split
  layers: {}, // name -> shown, as the 3D view says
  colours: {}, // node id -> #rrggbb
  otherColours: {}, // the same of the model beside it
  comparison: null, // with the model beside it, which is its `other`
  view: "3d",
  connection: "none", // none | connecting | ready | lost
  measuring: false,
  measured: null, // {points, distance_m}
  lives: null, // live sessions that have not ended
  live: null, // the one that is shown
  robot: null, // the simulated robot that feeds it, if one does
  livePose: null, // its last pose event
  liveBelief: null, // its last belief event
  liveBehind: 0, // seconds that its last step had to wait
  liveMapped: null, // session's time (s) until which the model knows the drive
  liveView: { follow: false, paused: false, at: null }, // how it is drawn; `at`: seconds, null = now
  picking: null, // what the next click in the map is for: {kind, text, name}
  uploads: [], // {id, name, share, error}
  offline: false,
};

const listeners = new Set();
let pending = null;

export function get() {
  return state;
}

/** Changes keys; listeners run once, after the code that is running now. */
export function set(changes) {
  const changed = Object.keys(changes).filter((key) => state[key] !== changes[key]);
  if (changed.length === 0) return;
  Object.assign(state, changes);
  if (pending === null) {
    pending = new Set();
    queueMicrotask(flush);
  }
  for (const key of changed) pending.add(key);
}

/** The old value when nothing in it has changed, so that nothing is drawn again. */
export function same(old, fresh) {
  return JSON.stringify(old) === JSON.stringify(fresh) ? old : fresh;
}

/** Runs `draw` now and after every change of one of the keys. */
export function watch(keys, draw) {
  const listener = { keys: new Set(keys), draw };
  listeners.add(listener);
  draw(state);
  return () => listeners.delete(listener);
}

function flush() {
  const keys = pending;
  pending = null;
  for (const listener of [...listeners]) {
    if ([...keys].some((key) => listener.keys.has(key))) listener.draw(state);
  }
}
