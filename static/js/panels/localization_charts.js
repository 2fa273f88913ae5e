// Entropy and the largest probability over the steps, rejected ones in another colour (the paper's
// Figs. 20, 21, 25 and 26). A click goes to a step.
import { h, replace } from "../dom.js";
import { watch } from "../store.js";
import { goTo } from "./localization_player.js";

const WIDTH = 320;
const HEIGHT = 96;
const LEFT = 26;
const RIGHT = 8;
const TOP = 8;
const BOTTOM = 18;
const SURE = 0.9;
const MOST_DOTS = 160;

export function localizationCharts(root) {
  const charts = [
    chart("Largest probability", "of a region", (step) => Math.max(0, ...Object.values(step.probabilities)), SURE),
    chart("Entropy", "1: no idea, 0: sure", (step) => step.entropy, null),
  ];
  replace(root, charts.map((item) => item.element), h("p", { class: "legend" },
    h("span", { class: "key key-updated" }), "updated", h("span", { class: "key key-rejected" }), "rejected"));
  watch(["localization"], ({ localization }) => {
    for (const item of charts) item.draw(localization?.steps_list ?? []);
  });
  watch(["stepIndex", "localization"], ({ stepIndex }) => {
    for (const item of charts) item.mark(stepIndex);
  });
}

function chart(title, tip, valueOf, line) {
  const plot = s("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "chart", role: "img" });
  const value = h("strong", {});
  const element = h("figure", { class: "chart-box" }, h("figcaption", {}, h("span", {}, title, h("small", {}, ` ${tip}`)), value), plot);
  let values = [];
  let x = () => LEFT;
  let cursor = null;
  let dot = null;
  plot.addEventListener("pointerdown", (event) => {
    plot.setPointerCapture(event.pointerId);
    seek(event);
  });
  plot.addEventListener("pointermove", (event) => event.buttons === 1 && seek(event));
  const seek = (event) => {
    const box = plot.getBoundingClientRect();
    const at = ((event.clientX - box.left) / box.width) * WIDTH;
    goTo(Math.round(((at - LEFT) / (WIDTH - LEFT - RIGHT)) * (values.length - 1)));
  };
  const draw = (steps) => {
    values = steps.map(valueOf);
    const span = Math.max(1, steps.length - 1);
    x = (index) => LEFT + (index / span) * (WIDTH - LEFT - RIGHT);
    const points = values.map((each, index) => `${x(index).toFixed(1)},${y(each).toFixed(1)}`).join(" ");
    cursor = s("line", { class: "chart-cursor", y1: TOP, y2: HEIGHT - BOTTOM });
    dot = s("circle", { class: "chart-now", r: 4 });
    plot.replaceChildren(...axes(steps.length, x),
      ...(line === null ? [] : [s("line", { class: "chart-sure", x1: LEFT, x2: WIDTH - RIGHT, y1: y(line), y2: y(line) })]),
      s("polyline", { class: "chart-line", points }), ...dots(steps, values, x), cursor, dot);
    const rejected = steps.filter((step) => !step.updated).length;
    plot.setAttribute("aria-label", `${title} over ${steps.length} steps, ${rejected} of them rejected`);
  };
  const mark = (index) => {
    if (values[index] === undefined || !cursor) return;
    for (const name of ["x1", "x2"]) cursor.setAttribute(name, x(index));
    dot.setAttribute("cx", x(index));
    dot.setAttribute("cy", y(values[index]));
    value.textContent = values[index].toFixed(2);
  };
  return { element, draw, mark };
}

function y(value) {
  return TOP + (1 - Math.max(0, Math.min(1, value))) * (HEIGHT - TOP - BOTTOM);
}

function axes(count, x) {
  const parts = [0, 0.5, 1].flatMap((value) => [
    s("line", { class: "chart-grid", x1: LEFT, x2: WIDTH - RIGHT, y1: y(value), y2: y(value) }),
    text(String(value), LEFT - 5, y(value) + 3.5, "end"),
  ]);
  const every = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((each) => count / each <= 7) ?? 1000;
  for (let number = every; number <= count; number += every) parts.push(text(String(number), x(number - 1), HEIGHT - 4, "middle"));
  return parts;
}

/** Every rejected step has a dot; accepted ones only while there is room. */
function dots(steps, values, x) {
  const radius = steps.length > 60 ? 1.6 : 2.4;
  return steps.flatMap((step, index) => (step.updated && steps.length > MOST_DOTS ? [] : [
    s("circle", { class: step.updated ? "chart-dot" : "chart-dot rejected", r: radius, cx: x(index).toFixed(1), cy: y(values[index]).toFixed(1) }),
  ]));
}

function text(words, left, base, anchor) {
  const element = s("text", { class: "chart-text", x: left, y: base, "text-anchor": anchor });
  element.textContent = words;
  return element;
}

function s(tag, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
