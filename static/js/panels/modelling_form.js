// How a model is to be made from a log.
import { h, replace } from "../dom.js";
import { createModel } from "../actions.js";
import { get } from "../store.js";

const remembered = new Map(); // log id -> options of a model that failed

export function rememberOptions(log, options) {
  remembered.set(log, options);
}

export function modellingForm(log) {
  const before = remembered.get(log.id) ?? {};
  const name = field("Name", h("input", { name: "name", maxlength: 200, placeholder: log.name }), "what the model is called");
  const autonomous = radio("mode", "autonomous", "Find the regions", "how many there are follows from the home", before.mode !== "offline");
  const offline = radio("mode", "offline", "A number of regions", "the map is cut into as many", before.mode === "offline");
  const regions = h("input", { type: "number", id: "regions", name: "regions", min: 1, max: 1000, step: 1, value: before.regions ?? 10, required: true });
  const regionsField = h("label", { class: "field field-inline", for: "regions" }, "Regions", regions);
  const method = select("Method", "method", [["default", "Default"], ["paper", "As in the paper"]], before.method);
  const mapping = select("Map", "mapping", [["cemal", "CEMAL (keeps thin walls)"], ["bayes", "Bayes (log-odds)"]], before.mapping);
  const odometry = select("Odometry", "odometry", [["", "Default"], ["raw", "As it is in the log"], ["calibrated", "Calibrated on the echoes"], ["corrected", "Corrected for drift"]], before.odometry);
  const known = log.robot && h("label", { class: "check", title: log.robot.sentences.join(" ") }, h("input", { type: "checkbox", name: "calibration", value: "robot" }), `What is known of this robot's odometry (from ${log.robot.model_name})`);
  const named = (get().models ?? []).filter((model) => model.status === "done" && model.labels.length);
  const labels = select("Names from", "labels_from", [["", "none"], ...named.map((model) => [model.id, model.name])], "");
  const resolution = select("Resolution", "resolution", [["0.05", "5 cm"], ["0.1", "10 cm (coarse)"], ["0.025", "2.5 cm (fine, slow)"]], before.resolution);
  const error = h("p", { class: "form-error", role: "alert" });
  const submit = h("button", { type: "submit", class: "button button-primary button-large" }, "Make the model");
  const form = h("form", { class: "form", novalidate: false },
    h("h2", {}, "Make a model"),
    !log.report.good_for_map && h("p", { class: "hint" }, "The report says that this log is not good enough for a map. You can try all the same."),
    name,
    h("fieldset", {}, h("legend", {}, "Regions"), autonomous, offline, regionsField),
    h("details", { class: "advanced" }, h("summary", {}, "More options"), mapping, method, odometry, known, resolution, named.length > 0 && labels),
    error, submit,
  );
  const adapt = () => {
    const isOffline = new FormData(form).get("mode") === "offline";
    regionsField.hidden = !isOffline;
    regions.disabled = !isOffline;
  };
  form.addEventListener("change", adapt);
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    submit.disabled = true;
    replace(error);
    try {
      await createModel(body(log, new FormData(form)));
      remembered.delete(log.id);
    } catch (problem) {
      replace(error, problem.message);
    } finally {
      submit.disabled = false;
    }
  });
  adapt();
  return h("div", {}, form, others(log));
}

function body(log, data) {
  const given = { log_id: log.id, mode: data.get("mode"), mapping: data.get("mapping"), method: data.get("method"), resolution: Number(data.get("resolution")) };
  if (data.get("mode") === "offline") given.regions = Number(data.get("regions"));
  if (data.get("labels_from")) given.labels_from = data.get("labels_from");
  if (data.get("calibration")) given.calibration = "robot";
  if (data.get("odometry")) given.odometry = data.get("odometry");
  given.name = data.get("name").trim() || log.name;
  return given;
}

/** Models that this log is already in. */
function others(log) {
  const models = (get().models ?? []).filter((model) => model.log_ids.includes(log.id));
  if (!models.length) return null;
  return h("section", { class: "made-from" }, h("h2", {}, "Made from this log"), h("ul", {}, models.map((model) => h("li", {}, h("a", { href: `#/models/${encodeURIComponent(model.id)}` }, model.name)))));
}

function field(text, input, tip) {
  return h("label", { class: "field", title: tip }, text, input);
}

function radio(name, value, text, tip, checked) {
  return h("label", { class: "radio" }, h("input", { type: "radio", name, value, checked }), h("span", {}, text, h("small", {}, tip)));
}

function select(text, name, options, chosen) {
  return field(text, h("select", { name }, options.map(([value, title]) => h("option", { value, selected: String(chosen ?? "") === value }, title))));
}
