// The right column while two models are shown side by side: which nodes are the same, what differs.
import { h, icon, replace } from "../dom.js";
import { api } from "../api.js";
import { area, count, metres, nodeName, percent } from "../format.js";
import { go, link } from "../router.js";
import { selectBeside } from "../second_view.js";
import { get, set, watch } from "../store.js";
import { showError, toast } from "../toasts.js";
import { select } from "../view3d.js";

const OPTIONS = "options."; // what a person chose
const SAME = 0.9; // overlap from which on two nodes are called the same

export function comparePanel(root) {
  const head = h("header", { class: "localization-head" });
  const body = h("div", { class: "stack" });
  replace(root, head, body);
  let pair = null;
  let asked = null; // the pair and its revisions
  watch(["route", "model", "models"], ({ route, model, models }) => {
    const ready = route.compare && models && model?.id === route.id && model.status === "done";
    const other = ready && models.find((item) => item.id === route.compare);
    if (ready && !other) {
      toast("The model beside it is gone.", { kind: "error" });
      go(link.model(route.id));
    }
    const now = other ? `${route.id} ${route.compare}` : null;
    const key = other ? `${now} ${model.revision} ${other.revision}` : null;
    if (key === asked) return;
    if (now !== pair) set({ comparison: null });
    [pair, asked] = [now, key];
    if (key) load(route.id, route.compare, () => asked === key);
  });
  watch(["route", "model", "models", "comparison", "colours", "otherColours"], (state) => {
    if (!state.route.compare || !state.model) return;
    replace(head, heading(state));
    replace(body, state.comparison ? found(state) : h("p", { class: "muted", role: "status" }, "Comparing…"));
  });
}

async function load(model, other, stillWanted) {
  try {
    const [difference, detail] = await Promise.all([api.comparison(model, other), api.model(other)]);
    if (stillWanted()) set({ comparison: { ...difference, other: detail } });
  } catch (error) {
    showError(error);
    if (stillWanted()) go(link.model(model));
  }
}

function heading({ model, models, route }) {
  const others = (models ?? []).filter((item) => item.status === "done" && item.id !== model.id);
  const choice = h("select", { "aria-label": "The other model", onchange: () => go(link.compare(model.id, choice.value)) },
    others.map((item) => h("option", { value: item.id, selected: item.id === route.compare }, item.name)));
  return [
    h("a", { class: "back", href: link.model(model.id) }, icon("left"), "Rooms"),
    h("h2", {}, "Side by side"),
    h("p", { class: "compare-names" }, h("strong", {}, "left"), h("span", {}, model.name)),
    h("p", { class: "compare-names" }, h("strong", {}, "right"), choice),
  ];
}

function found({ comparison, model, colours, otherColours }) {
  const { other } = comparison;
  const row = (what, mine, theirs) => h("tr", {}, h("th", { scope: "row" }, what), h("td", { class: "num" }, mine), h("td", { class: "num" }, theirs));
  return [
    h("section", {}, h("table", { class: "nodes compare" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, h("span", { class: "unseen" }, "What")), h("th", { scope: "col", class: "num" }, "left"), h("th", { scope: "col", class: "num" }, "right"))),
      h("tbody", {},
        row("Regions", model.node_count, other.node_count), row("Rooms", model.room_count, other.room_count),
        row("Floor, m²", area(model.area_m2), area(other.area_m2)),
        row("Most hidden pairs", mostHidden(model), mostHidden(other)))),
    h("p", { class: "muted" }, comparison.free_overlap > 0
      ? `The free space of both maps overlaps by ${percent(comparison.free_overlap)}.`
      : "The maps do not overlap: these models are not of one drive, so only their parameters can be compared.")),
    h("section", {}, h("h2", {}, "Regions", h("small", {}, "overlap")), h("ul", { class: "pairs" },
      comparison.nodes.map((pair) => pairItem(pair, model, other, colours, otherColours)),
      comparison.only_here.map((id) => alone(id, model, colours, "only on the left", () => select(id))),
      comparison.only_there.map((id) => alone(id, other, otherColours, "only on the right", () => selectBeside(id))))),
    h("section", {}, h("h2", {}, "Parameters that differ"), parameters(comparison.parameters)),
  ];
}

/** Those that both have first; those of a method that only one was made with are many. */
function parameters(differing) {
  if (!differing.length) return h("p", { class: "nothing" }, "None: both were made with the same parameters.");
  const isGiven = (value) => value !== null && value !== undefined;
  const own = differing.filter(({ value, other_value: theirs }) => !isGiven(value) || !isGiven(theirs));
  const choices = own.filter(({ name }) => name.startsWith(OPTIONS));
  const others = own.filter((parameter) => !choices.includes(parameter));
  return [
    listed(differing.filter((parameter) => !own.includes(parameter)).concat(choices)),
    others.length > 0 && h("details", { class: "advanced" }, h("summary", {}, `Only one of them has: ${count(others.length, "parameter")}`), listed(others)),
  ];
}

function listed(some) {
  return h("dl", { class: "facts parameters" }, some.map(({ name, value, other_value: theirs }) => [
    h("dt", {}, name.split(".").map((part, index) => (index ? [".", h("wbr"), part] : part))), h("dd", {}, `${told(value)} →\u00a0${told(theirs)}`),
  ]));
}

function pairItem(pair, model, other, colours, otherColours) {
  const mine = model.nodes.find((node) => node.id === pair.node);
  const theirs = other.nodes.find((node) => node.id === pair.other);
  if (!mine || !theirs) return null;
  const change = pair.overlap >= SAME ? "the same" : `${pair.area_change_m2 >= 0 ? "+" : "−"}${area(Math.abs(pair.area_change_m2))} m², ${metres(pair.moved_m, 2)} apart`;
  return h("li", {}, h("button", { type: "button", class: "pair", onclick: () => {
    select(get().selected === mine.id ? null : mine.id);
    selectBeside(get().selected === mine.id ? theirs.id : null);
  } },
  swatch(colours[mine.id]), h("span", { class: "bar-name" }, nodeName(mine)), swatch(otherColours[theirs.id]), h("span", { class: "bar-name" }, nodeName(theirs)),
  h("span", { class: "bar-figure" }, percent(pair.overlap)), h("span", { class: "pair-change" }, change)));
}

function alone(id, model, colours, words, onclick) {
  const node = model.nodes.find((item) => item.id === id);
  return node && h("li", {}, h("button", { type: "button", class: "pair", onclick }, swatch(colours[id]),
    h("span", { class: "bar-name pair-alone" }, nodeName(node)), h("span", { class: "pair-change" }, words)));
}

function swatch(colour) {
  return h("span", { class: "swatch", style: { background: colour ?? "" } });
}

function mostHidden(model) {
  return model.nodes.length ? Math.max(...model.nodes.map((node) => node.convexity)).toFixed(2) : "–";
}

function told(value) {
  return value === null || value === undefined ? "–" : typeof value === "number" ? String(Number(value.toPrecision(6))) : String(value);
}
