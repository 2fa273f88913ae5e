// A model in the making: how far it is, and a way to stop it; or why it failed.
import { h, icon } from "../dom.js";
import { cancelJob, remove } from "../actions.js";
import { duration } from "../format.js";
import { go, link } from "../router.js";
import { rememberOptions } from "./modelling_form.js";

export function jobCard(model) {
  const bar = h("progress", { max: 1, "aria-label": "Progress" });
  const what = h("p", { class: "job-what", role: "status" }, "Waiting for its turn…");
  const time = h("span", { class: "muted" });
  const share = h("strong", {});
  const cancel = h("button", { type: "button", class: "button", onclick: () => {
    cancel.disabled = true;
    cancelJob(model.job_id);
  } }, "Cancel");
  const card = h("article", { class: "card job" },
    h("h2", {}, "Making the model"), what, bar,
    h("div", { class: "job-facts" }, share, time, h("span", { class: "grow" }), cancel),
  );
  card.addEventListener("job", ({ detail: job }) => {
    if (job.status === "queued") return;
    if (job.progress > 0) bar.value = job.progress;
    share.textContent = `${Math.round(100 * job.progress)} %`;
    what.textContent = job.what ? sentence(job.what) : "Starting…";
    if (job.started) time.textContent = duration(Math.max(0, (Date.now() - new Date(job.started)) / 1000));
  });
  return card;
}

export function failedCard(model) {
  const cancelled = model.status === "cancelled";
  const again = model.log_ids[0] && h("button", { type: "button", class: "button button-primary", onclick: () => {
    rememberOptions(model.log_ids[0], model.options);
    go(link.log(model.log_ids[0]));
  } }, "Try again from its log");
  return h("article", { class: "card" },
    h("h2", { class: cancelled ? "" : "bad" }, icon("alert"), cancelled ? "The model was cancelled" : "The model could not be made"),
    !cancelled && model.error && h("p", { class: "failure" }, model.error),
    h("div", { class: "card-buttons" }, again,
      h("button", { type: "button", class: "button", onclick: () => remove("model", model) }, "Delete")),
  );
}

function sentence(text) {
  return `${text.charAt(0).toUpperCase()}${text.slice(1)}…`;
}

