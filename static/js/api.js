// The HTTP API. Every failure becomes an ApiError whose message is the problem's one-line detail.

export class ApiError extends Error {
  constructor(status, detail, problem = {}) {
    super(detail);
    this.status = status;
    this.problem = problem;
  }
}

export async function request(method, path, body) {
  const options = { method, headers: { accept: "application/json" } };
  if (body !== undefined) {
    options.body = JSON.stringify(body);
    options.headers["content-type"] = "application/json";
  }
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    throw new ApiError(0, "The server does not answer. Is EchoRooms still running?");
  }
  return answer(response.status, await response.text());
}

/** The JSON of an answer, or the ApiError that it means. */
export function answer(status, text) {
  let data = null;
  try {
    data = text ? JSON.parse(text) : null;
  } catch {
    // Not JSON: a proxy's error page, perhaps.
  }
  if (status >= 200 && status < 300) return data;
  throw new ApiError(status, data?.detail || `The server answered with ${status}.`, data ?? {});
}

const id = encodeURIComponent;

/** Addresses of files to take away, and of the picture of a model's grid. */
export const files = {
  log: (log) => `api/logs/${id(log)}/file`,
  liveLog: (live) => `api/live/${id(live)}/log`,
  liveEvents: (live) => new URL(`api/live/${id(live)}/events`, document.baseURI).href.replace(/^http/, "ws"),
  folder: (model) => `api/models/${id(model)}/folder.zip`,
  grid: (model, revision) => `api/models/${id(model)}/grid.png?v=${revision}`,
};

export const api = {
  logs: () => request("GET", "api/logs"),
  log: (log) => request("GET", `api/logs/${id(log)}`),
  renameLog: (log, name) => request("PATCH", `api/logs/${id(log)}`, { name }),
  deleteLog: (log) => request("DELETE", `api/logs/${id(log)}`),
  models: () => request("GET", "api/models"),
  model: (model) => request("GET", `api/models/${id(model)}`),
  createModel: (body) => request("POST", "api/models", body),
  renameModel: (model, name) => request("PATCH", `api/models/${id(model)}`, { name }),
  deleteModel: (model) => request("DELETE", `api/models/${id(model)}`),
  labelNode: (model, node, label) => request("PATCH", `api/models/${id(model)}/nodes/${id(node)}`, { label }),
  labelRoom: (model, room, label) => request("PATCH", `api/models/${id(model)}/rooms/${id(room)}`, { label }),
  comparison: (model, other) => request("GET", `api/models/${id(model)}/comparison/${id(other)}`),
  drift: (model) => request("GET", `api/models/${id(model)}/drift`),
  editDrift: (model, change) => request("POST", `api/models/${id(model)}/drift/edits`, change),
  forgetDriftEdits: (model) => request("DELETE", `api/models/${id(model)}/drift/edits`),
  keepCalibration: (model) => request("PUT", `api/models/${id(model)}/drift/calibration`),
  timeline: (model) => request("GET", `api/models/${id(model)}/timeline`),
  edit: (model, change) => request("POST", `api/models/${id(model)}/edits`, change),
  undo: (model, revision) => request("POST", `api/models/${id(model)}/undo`, { revision: revision ?? null }),
  redo: (model) => request("POST", `api/models/${id(model)}/redo`),
  addLog: (model, log) => request("POST", `api/models/${id(model)}/logs`, { log_id: log }),
  localizations: (model) => request("GET", `api/localizations?model_id=${id(model)}`),
  localization: (localization) => request("GET", `api/localizations/${id(localization)}`),
  localizationSteps: (localization) => request("GET", `api/localizations/${id(localization)}/steps`),
  localize: (body) => request("POST", "api/localizations", body),
  deleteLocalization: (localization) => request("DELETE", `api/localizations/${id(localization)}`),
  lives: () => request("GET", "api/live"),
  live: (live) => request("GET", `api/live/${id(live)}`),
  finishLive: (live) => request("DELETE", `api/live/${id(live)}`),
  saveLive: (live) => request("POST", `api/live/${id(live)}/models`),
  robots: () => request("GET", "api/robots"),
  robot: (robot) => request("GET", `api/robots/${id(robot)}`),
  robotChoices: () => request("GET", "api/robots/choices"),
  makeRobot: (order) => request("POST", "api/robots", order),
  tellRobot: (robot, command) => request("POST", `api/robots/${id(robot)}/commands`, command),
  removeRobot: (robot) => request("DELETE", `api/robots/${id(robot)}`),
  job: (job) => request("GET", `api/jobs/${id(job)}`),
  cancelJob: (job) => request("DELETE", `api/jobs/${id(job)}`),
};
