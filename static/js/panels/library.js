// The left column: models and logs with search, and the place to drop files on.
import { h, icon, replace } from "../dom.js";
import { bytes, count, duration } from "../format.js";
import { upload } from "../actions.js";
import { link } from "../router.js";
import { get, watch } from "../store.js";
import { libraryItem } from "./library_item.js";
import { startDialog } from "./live_dialog.js";

const STATUS = { queued: "waiting", running: "being made", failed: "failed", cancelled: "cancelled" };

export function library(root) {
  let words = [];
  const search = h("input", {
    type: "search", id: "search", placeholder: "Search…", "aria-label": "Search models and logs",
    oninput: () => {
      words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
      draw(get());
    },
  });
  const chooser = h("input", { type: "file", multiple: true, class: "unseen", tabindex: -1, "aria-hidden": "true", onchange: () => {
    upload([...chooser.files]);
    chooser.value = "";
  } });
  const lives = section("Live");
  lives.element.querySelector("h2").append(h("button", { type: "button", class: "link-button section-button", onclick: startDialog }, "Start…"));
  const models = section("Models");
  const logs = section("Logs");
  const uploads = h("ul", { class: "uploads", "aria-label": "Uploads", "aria-live": "polite" });
  replace(root,
    h("div", { class: "search" }, icon("search"), search),
    lives.element, models.element, logs.element, uploads,
    h("button", { type: "button", class: "drop-zone", id: "upload", onclick: () => chooser.click() },
      icon("upload"), h("strong", {}, "Upload a log"), h("span", {}, "drop files anywhere, or click")),
    chooser,
  );

  const draw = ({ models: allModels, logs: allLogs, lives: allLives, route }) => {
    fill(lives, allLives, (live) => matches(words, live.name), "No robot is driving.", (live) => liveItem(live, route));
    fill(models, allModels, (model) => matches(words, model.name, ...model.labels), "No model yet. Open a log to make one.", (model) => libraryItem({
      kind: "model", item: model, current: route.page === "model" && route.id === model.id, href: link.model(model.id),
      facts: STATUS[model.status] ?? `${count(model.node_count, "region")} · ${bytes(model.size_bytes)}`,
      state: model.status, redraw: () => draw(get()),
    }));
    fill(logs, allLogs, (log) => matches(words, log.name), "No log yet.", (log) => libraryItem({
      kind: "log", item: log, current: route.page === "log" && route.id === log.id, href: link.log(log.id),
      facts: `${duration(log.duration_s)} · ${log.distance_m.toFixed(0)} m · ${bytes(log.size_bytes)}`, redraw: () => draw(get()),
    }));
  };
  watch(["models", "logs", "lives", "route"], draw);
  watch(["uploads"], (state) => replace(uploads, state.uploads.map(uploadItem)));
}

function liveItem(live, route) {
  const current = route.page === "live" && route.id === live.id;
  const doing = live.status === "finishing" ? "is being finished" : live.mode === "mapping" ? "is mapping" : "is localizing";
  return h("li", { class: current ? "item current" : "item", dataset: { item: `live:${live.id}`, state: "running" } },
    h("a", { href: link.live(live.id), "aria-current": current ? "page" : null, title: live.name },
      h("span", { class: "item-name" }, live.name), h("span", { class: "item-facts" }, `${doing} · ${count(live.stored, "scan")}`)));
}

export function chooseFiles() {
  document.getElementById("upload").click();
}

function section(title) {
  const number = h("span", { class: "number" });
  const list = h("ul", { class: "items" });
  return { list, number, element: h("section", {}, h("h2", {}, title, number), list) };
}

function fill(part, items, keep, empty, draw) {
  if (part.list.contains(document.activeElement) && document.activeElement.tagName === "INPUT") return;
  if (items === null) {
    replace(part.list, h("li", { class: "skeleton" }), h("li", { class: "skeleton" }));
    return;
  }
  const kept = items.filter(keep);
  part.number.textContent = items.length ? String(items.length) : "";
  replace(part.list, kept.length ? kept.map(draw) : h("li", { class: "nothing" }, items.length ? "Nothing matches." : empty));
}

function matches(words, ...texts) {
  const text = texts.join(" ").toLowerCase();
  return words.every((word) => text.includes(word));
}

function uploadItem({ name, share, cancel }) {
  const reading = share >= 1;
  return h("li", { class: "upload" },
    h("div", { class: "upload-name" }, h("span", {}, name), h("span", {}, reading ? "reading…" : `${Math.round(100 * share)} %`)),
    h("progress", reading ? {} : { value: share, max: 1 }),
    h("button", { type: "button", class: "link-button", onclick: cancel }, "Cancel"),
  );
}
