// "Where is the robot?": the form that localizes a log in the open model, and what was localized.
import { h, icon, iconButton, replace } from "../dom.js";
import { count, when } from "../format.js";
import { link } from "../router.js";
import { get, watch } from "../store.js";
import { localize, over, play, removeLocalization } from "./localization_actions.js";

const METHODS = [
  ["default", "Default", "pose grid: starts anywhere, recovers, admits doubt"],
  ["paper", "As in the paper", "local maps matched by correlation; to study"],
  ["mcl", "Monte Carlo", "3,000 particles; for comparison"],
];

export function localizationList(root) {
  const form = localizeForm();
  const list = h("ul", { class: "items", "aria-label": "Localizations" });
  replace(root, h("h2", {}, "Where is the robot?"), form.element, list);
  watch(["logs", "model"], ({ logs, model }) => form.offer(logs ?? [], model));
  watch(["localizations", "localizing", "route"], ({ localizations, localizing, route }) => {
    if (localizations === null) replace(list);
    else if (!localizations.length) replace(list, h("li", { class: "nothing" }, "Not localized yet. Choose a drive and see the probability of every room, step by step."));
    else replace(list, localizations.map((item) => row(item, localizing[item.id], route)));
  });
}

export function methodName(method) {
  return METHODS.find(([name]) => name === method)?.[1] ?? method;
}

function localizeForm() {
  const log = h("select", { name: "log", id: "localize-log" });
  const method = h("select", { name: "method", id: "localize-method" }, METHODS.map(([value, text, tip]) => h("option", { value, title: tip }, text)));
  const error = h("p", { class: "form-error", role: "alert" });
  const submit = h("button", { type: "submit", class: "button button-primary" }, icon("waves"), "Localize");
  const empty = h("p", { class: "nothing" }, "Upload a log of a drive through this home first.");
  const element = h("form", { class: "localize", onsubmit: async (event) => {
    event.preventDefault();
    submit.disabled = true;
    replace(error);
    try {
      await localize({ model_id: get().model.id, log_id: log.value, method: method.value });
    } catch (problem) {
      replace(error, problem.message);
    } finally {
      submit.disabled = false;
    }
  } },
  h("label", { class: "field", for: "localize-log" }, "Log", log),
  h("label", { class: "field", for: "localize-method" }, "Method", method), submit, error);
  let offered = "";
  let offeredFor = null;
  const offer = (logs, model) => {
    const own = new Set(model?.log_ids ?? []);
    const sorted = [...logs].sort((a, b) => own.has(a.id) - own.has(b.id));
    const key = JSON.stringify([model?.id, sorted.map(({ id, name }) => [id, name])]);
    if (key === offered) return;
    offered = key;
    const chosen = offeredFor === model?.id ? log.value : "";
    offeredFor = model?.id;
    replace(log, sorted.map(({ id, name }) => h("option", { value: id }, own.has(id) ? `${name} (made this map)` : name)));
    if (sorted.some(({ id }) => id === chosen)) log.value = chosen;
    for (const part of element.children) part.hidden = logs.length === 0;
    empty.hidden = logs.length > 0;
  };
  element.append(empty);
  return { element, offer };
}

function row(item, job, route) {
  const working = !over(item);
  return h("li", { class: item.id === route.localization ? "item current" : "item", dataset: { item: `localization:${item.id}`, state: item.status } },
    h("a", { href: link.localization(item.model_id, item.id), title: item.name, onclick: () => play(item.id) },
      h("span", { class: "item-name" }, item.name),
      h("span", { class: "item-facts", title: item.error }, facts(item, job)),
      working && h("progress", { max: 1, "aria-label": `Progress of ${item.name}`, ...(job?.progress ? { value: job.progress } : {}) })),
    h("span", { class: "item-buttons" }, iconButton("trash", `Delete the localization of ${item.name}`, () => removeLocalization(item))),
  );
}

function facts(item, job) {
  if (item.status === "done") return `${methodName(item.options.method)} · ${count(item.steps, "step")} · ${when(item.created)}`;
  if (item.status === "failed") return `failed: ${item.error ?? "no reason is known"}`;
  if (item.status === "cancelled") return "cancelled";
  return job?.status === "running" ? `${Math.round(100 * job.progress)} % · ${job.what || "starting"}` : "waiting for its turn";
}
