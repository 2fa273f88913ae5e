// How the open model was made.
import { h, icon, replace } from "../dom.js";
import { files } from "../api.js";
import { addLog } from "../actions.js";
import { bytes, count, when } from "../format.js";
import { go, link } from "../router.js";
import { watch } from "../store.js";

const WORDS = { mode: "Regions", regions: "Number asked", method: "Method", mapping: "Map", odometry: "Odometry", resolution: "Resolution" };

export function modelFacts(root) {
  const ways = h("div", { class: "model-ways" });
  const about = h("div", {});
  const details = h("details", { class: "advanced" }, h("summary", {}, "About this model"), about);
  replace(root, ways, details);
  watch(["model", "models", "logs"], ({ model, models, logs }) => {
    ways.hidden = details.hidden = !model || model.status !== "done";
    if (details.hidden) return;
    const options = Object.entries(WORDS).filter(([key]) => model.options[key] !== undefined && model.options[key] !== null);
    replace(ways, model.log_ids.length > 0 && model.options.regions == null && model.options.mode !== "offline" && h("p", { class: "grew" },
      h("a", { class: "button", href: link.growth(model.id) }, icon("play"), "How it grew along the drive")),
    model.log_ids.length > 0 && h("p", { class: "grew" }, h("a", { class: "button", href: link.drift(model.id) }, icon("waves"), "Drift of the drive")),
    beside(model, models ?? []));
    const chosen = about.querySelector("select")?.value;
    replace(about, h("dl", { class: "facts" },
      fact("Floor", `${model.area_m2.toFixed(0)} m², ${count(model.node_count, "region")}, ${count(model.room_count, "room")}`),
      fact("Made", when(model.created)),
      fact("Log", model.log_ids.length ? model.log_ids.map((id) => h("a", { href: link.log(id) }, logs?.find((log) => log.id === id)?.name ?? id)) : "an imported map"),
      options.map(([key, name]) => fact(name, key === "resolution" ? `${(100 * model.options[key]).toFixed(1).replace(/\.0$/, "")} cm` : String(model.options[key]))),
      fact("On disk", bytes(model.size_bytes)),
    ),
    h("p", {}, h("a", { class: "button", href: files.folder(model.id), download: "" }, "Download the model folder")),
    model.log_ids.length > 0 && goOn(model, logs ?? [], chosen));
  });
}

/** The way to a second model; those of the same log come first. */
function beside(model, models) {
  const own = new Set(model.log_ids);
  const shared = (item) => (item.log_ids ?? []).some((id) => own.has(id));
  const others = models.filter((item) => item.id !== model.id && item.status === "done").sort((a, b) => shared(b) - shared(a));
  if (!others.length) return null;
  const choice = h("select", { "aria-label": "Compare with", onchange: () => choice.value && go(link.compare(model.id, choice.value)) },
    h("option", { value: "" }, "Compare with…"), others.map((item) => h("option", { value: item.id }, item.name)));
  return h("p", { class: "grew" }, choice);
}

/** Another log of the same drive makes the map larger; `chosen` stays so when this is drawn again. */
function goOn(model, logs, chosen) {
  const others = logs.filter((log) => !model.log_ids.includes(log.id));
  if (!others.length) return null;
  const choice = h("select", { "aria-label": "Log" }, others.map((log) => h("option", { value: log.id, selected: log.id === chosen }, log.name)));
  return h("div", { class: "go-on" }, h("p", { class: "muted" }, "Go on with another log of the same drive:"), choice,
    h("button", { type: "button", class: "button", onclick: () => addLog(model, choice.value) }, "Make it again with both"));
}

function fact(name, value) {
  return [h("dt", {}, name), h("dd", {}, value)];
}
