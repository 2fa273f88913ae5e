// The middle: a welcome, a log's report, a job's progress, or the 3D view.
import { h, replace } from "../dom.js";
import { get, watch } from "../store.js";
import { closeBeside, openBeside } from "../second_view.js";
import { closeView, openView } from "../view3d.js";
import { cutStrip } from "./edit_cut.js";
import { failedCard, jobCard } from "./job_card.js";
import { logReport } from "./log_report.js";
import { liveStrip, pickStrip } from "./live_strip.js";
import { viewOverlay } from "./view_overlay.js";
import { welcome } from "./welcome.js";

export function stage(root) {
  const page = h("div", { class: "page" });
  const beside = h("div", { class: "beside" });
  const view = h("div", { class: "view" }, beside);
  replace(root, page, view);
  viewOverlay(view);
  cutStrip(view);
  pickStrip(view);
  liveStrip(view);
  watch(["route", "log", "model", "job", "logs", "models", "live", "lives"], () => {
    const content = choose(get());
    const shows3d = content === "3d";
    page.hidden = shows3d;
    view.hidden = !shows3d;
    const { models, route } = get();
    const other = shows3d && models?.some((item) => item.id === route.compare) ? route.compare : null;
    view.classList.toggle("two", other !== null);
    if (shows3d) openView(route.id, view);
    else {
      closeView();
      show(page, content);
    }
    if (other) openBeside(other, beside);
    else closeBeside();
  });
}

/** What the middle shows; cards that need no redraw are kept by key. */
function choose(state) {
  const { route, log, model, job } = state;
  if (route.page === "log") {
    return log ? { key: `log:${log.id}:${log.name}`, draw: () => logReport(log) } : loading();
  }
  if (route.page === "model") {
    if (!model) return loading();
    if (model.status === "done") return "3d";
    if (model.status === "queued" || model.status === "running") {
      return { key: `job:${model.id}`, draw: () => jobCard(model), update: job };
    }
    return { key: `failed:${model.id}:${model.status}`, draw: () => failedCard(model) };
  }
  if (route.page === "live") return state.live ? "3d" : loading();
  if (state.logs === null || state.models === null) return loading();
  return { key: `home:${state.logs.length}:${state.models.length}:${(state.lives ?? []).map((live) => live.id).join(":")}`, draw: () => welcome(state) };
}

function loading() {
  return { key: "loading", draw: () => h("div", { class: "loading", role: "status" }, h("span", { class: "spinner" }), "Loading…") };
}

function show(page, content) {
  if (page.dataset.key !== content.key) {
    page.dataset.key = content.key;
    replace(page, content.draw());
    page.scrollTop = 0;
  }
  if (content.update) page.firstElementChild.dispatchEvent(new CustomEvent("job", { detail: content.update }));
}
