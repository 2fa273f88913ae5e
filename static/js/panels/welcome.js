// The first page: what to do next, from nothing at all to a model that waits to be opened.
import { files } from "../api.js";
import { h, icon } from "../dom.js";
import { count, when } from "../format.js";
import { link } from "../router.js";
import { chooseFiles } from "./library.js";
import { startDialog } from "./live_dialog.js";

export function welcome({ logs, models, lives }) {
  return h("article", { class: "welcome" },
    h("img", { src: "logo.svg", alt: "", width: 56, height: 56 }),
    h("h2", {}, models.length || logs.length ? "Welcome back" : "From sonar to named rooms"),
    h("p", { class: "lead" }, lead(logs, models)),
    lives?.length ? driving(lives) : null,
    models.length ? recent(models) : null,
    !models.length && logs.length ? h("p", {}, h("a", { class: "button button-primary", href: link.log(logs[0].id) }, `Open “${logs[0].name}”`)) : null,
    !logs.length && h("button", { type: "button", class: "button button-primary button-large", onclick: chooseFiles }, icon("upload"), "Upload a log"),
    !lives?.length && h("p", {}, h("button", { type: "button", class: "button", onclick: startDialog }, icon("waves"), "Drive a simulated robot")),
    !models.length && steps(),
    h("p", { class: "muted" }, "New here? ", h("a", { href: "docs/index.html#getting-started", target: "_blank", rel: "noopener" }, "Getting started"), " takes five minutes. Press ", h("kbd", {}, "?"), " for help and keys."),
  );
}

function lead(logs, models) {
  if (models.length) return "Open a model to see its rooms, or upload another log.";
  if (logs.length) return "A log is here. Open it, read its report, and make a model of it.";
  return "EchoRooms turns the log of a robot with cheap sonars into a map, cuts the map into rooms, and lets you name them.";
}

function driving(lives) {
  return h("ul", { class: "driving", "aria-label": "Robots that drive now" }, lives.map((live) => h("li", {}, h("a", { class: "button button-primary", href: link.live(live.id) },
    h("span", { class: "dot", dataset: { kind: "busy" } }), `Watch “${live.name}”`))));
}

function recent(models) {
  return h("ul", { class: "recent" }, models.slice(0, 6).map((model) => h("li", {}, h("a", { href: link.model(model.id), class: "tile" },
    model.status === "done"
      ? h("img", { src: files.grid(model.id, model.revision), alt: "", loading: "lazy" })
      : h("span", { class: "tile-blank" }, icon(model.status === "failed" ? "alert" : "map")),
    h("strong", {}, model.name),
    h("span", {}, model.status === "done" ? count(model.node_count, "region") : model.status, " · ", when(model.created)),
  ))));
}

function steps() {
  const step = (number, title, text) => h("li", {}, h("span", { class: "step-number", "aria-hidden": "true" }, number), h("div", {}, h("strong", {}, title), h("p", {}, text)));
  return h("ol", { class: "steps" },
    step(1, "Upload a log", "Odometry and sonar readings of a drive through every room: a .jsonl file, or a zip of text files with a log.yaml."),
    step(2, "Make a model", "EchoRooms draws the map, cuts it into regions and finds the doorways. It takes seconds."),
    step(3, "Name the rooms", "Click a node, type “kitchen”. The name is still there tomorrow."),
  );
}
