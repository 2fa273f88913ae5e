// The right column while a localization is open: how far it is, or its bars and charts.
import { h, icon, replace } from "../dom.js";
import { cancelJob } from "../actions.js";
import { count } from "../format.js";
import { link } from "../router.js";
import { watch } from "../store.js";
import { localize, over, removeLocalization } from "./localization_actions.js";
import { goneNodes, localizationBars } from "./localization_bars.js";
import { localizationCharts } from "./localization_charts.js";
import { methodName } from "./localization_list.js";
import { attempt } from "../toasts.js";

export function localizationPanel(root) {
  const head = h("header", { class: "localization-head" });
  const note = h("div", { class: "localization-note", role: "status" });
  const bars = h("section", {});
  const charts = h("section", { class: "charts" });
  const marks = legend();
  replace(root, head, note, bars, charts, marks);
  localizationBars(bars);
  localizationCharts(charts);
  watch(["route", "localization", "localizing", "model", "logs"], (state) => {
    const { route, localization, model } = state;
    if (!route.localization || !model?.nodes) return;
    replace(head, heading(model, localization));
    const steps = localization?.steps_list ?? [];
    for (const part of [bars, charts, marks]) part.hidden = steps.length === 0;
    replace(note, steps.length ? edited(steps[0], model, localization) : waiting(state));
  });
}

function heading(model, localization) {
  return [
    h("a", { class: "back", href: link.model(model.id) }, icon("left"), "Rooms"),
    h("h2", {}, "Where is the robot?"),
    h("h3", { title: localization?.name }, localization?.name ?? "…"),
    localization && h("p", { class: "muted" }, [methodName(localization.options.method), localization.steps > 0 && count(localization.steps, "step")].filter(Boolean).join(" · ")),
  ];
}

function waiting({ localization, localizing }) {
  if (!localization) return h("p", { class: "muted" }, "Loading…");
  const again = h("button", { type: "button", class: "button button-primary", onclick: () => repeat(localization) }, "Localize again");
  const remove = h("button", { type: "button", class: "button", onclick: () => removeLocalization(localization) }, "Delete");
  if (!over(localization)) return working(localization, localizing[localization.id]);
  if (localization.status === "failed") {
    return [h("h3", { class: "bad" }, "It could not be localized"), h("p", { class: "failure" }, localization.error ?? "No reason is known."), h("p", { class: "card-buttons" }, again, remove)];
  }
  if (localization.status === "cancelled") return [h("h3", {}, "It was cancelled"), h("p", { class: "card-buttons" }, again, remove)];
  return [h("h3", {}, "No steps"), h("p", { class: "muted" }, "The drive ended before the robot had moved far enough for a first step."), h("p", { class: "card-buttons" }, remove)];
}

function working(localization, job) {
  return [
    h("p", {}, job?.status === "running" ? `Localizing… ${Math.round(100 * job.progress)} %` : "Waiting for its turn…"),
    h("progress", { max: 1, "aria-label": "Progress", ...(job?.progress ? { value: job.progress } : {}) }),
    h("p", { class: "muted" }, job?.what || null),
    localization.job_id && h("p", { class: "card-buttons" }, h("button", { type: "button", class: "button", onclick: () => cancelJob(localization.job_id) }, "Cancel")),
  ];
}

/** The model was edited since: what of this localization cannot be shown. */
function edited(step, model, localization) {
  const gone = goneNodes(step, model);
  const fresh = model.nodes.filter((node) => !(node.id in step.probabilities)).length;
  if (!gone.length && !fresh) return null;
  const parts = [
    gone.length && `${count(gone.length, "region")} of this localization ${gone.length === 1 ? "is" : "are"} no longer in it`,
    fresh && `${count(fresh, "region")} came later`,
  ].filter(Boolean).join(", ");
  return h("div", { class: "edited" }, icon("alert"), h("p", {}, `The model was edited since: ${parts}. `,
    h("button", { type: "button", class: "link-button", onclick: () => repeat(localization) }, "Localize again")));
}

function repeat({ model_id, log_id, options }) {
  return attempt(() => localize({ model_id, log_id, ...options }));
}

function legend() {
  const line = (mark, text) => h("li", {}, h("span", { class: `mark mark-${mark}` }), text);
  return h("ul", { class: "marks", "aria-label": "In the map" },
    line("robot", "the robot at its most probable pose"), line("template", "its local map, laid onto the map there"),
    line("candidate", "the best place in every region"));
}

