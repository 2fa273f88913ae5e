// A small chart of values 0..1 over the steps that are played. A click or a drag goes to a step.
import { h } from "../dom.js";
import { count } from "../format.js";
import { goTo } from "./player.js";

const WIDTH = 320;
const HEIGHT = 96;
const LEFT = 26;
const RIGHT = 8;
const TOP = 8;
const BOTTOM = 18;

/**
 * `draw({count, lines: [{values, kind}], dots: [{index, value, kind}], thresholds: [value], label})`;
 * a value of null is a gap. `mark(index, figure)` moves the cursor and tells the figure there.
 */
export function stepChart(title, tip) {
  const plot = s("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "chart", role: "img" });
  const value = h("strong", {});
  const element = h("figure", { class: "chart-box" }, h("figcaption", {}, h("span", {}, title, h("small", {}, ` ${tip}`)), value), plot);
  const cursor = s("line", { class: "chart-cursor", y1: TOP, y2: HEIGHT - BOTTOM });
  const now = s("circle", { class: "chart-now", r: 4 });
  let drawn = { count: 0, lines: [] };
  const x = (index) => LEFT + (index / Math.max(1, drawn.count - 1)) * (WIDTH - LEFT - RIGHT);
  const seek = (event) => {
    const box = plot.getBoundingClientRect();
    const at = ((event.clientX - box.left) / box.width) * WIDTH;
    goTo(Math.round(((at - LEFT) / (WIDTH - LEFT - RIGHT)) * (drawn.count - 1)));
  };
  plot.addEventListener("pointerdown", (event) => {
    plot.setPointerCapture(event.pointerId);
    seek(event);
  });
  plot.addEventListener("pointermove", (event) => event.buttons === 1 && seek(event));
  const draw = (content) => {
    drawn = content;
    plot.replaceChildren(
      ...axes(content.count, x),
      ...content.thresholds.map((at) => s("line", { class: "chart-sure", x1: LEFT, x2: WIDTH - RIGHT, y1: y(at), y2: y(at) })),
      ...content.lines.flatMap(({ values, kind }) => stretches(values).map((stretch) => s("polyline", {
        class: `chart-line ${kind ?? ""}`, points: stretch.map(([index, each]) => `${x(index).toFixed(1)},${y(each).toFixed(1)}`).join(" "),
      }))),
      ...content.dots.map(({ index, value: each, kind }) => s("circle", {
        class: `chart-dot ${kind ?? ""}`, r: content.count > 60 ? 1.6 : 2.4, cx: x(index).toFixed(1), cy: y(each).toFixed(1),
      })),
      cursor, now);
    plot.setAttribute("aria-label", `${title} over ${count(content.count, "step")}${content.label ?? ""}`);
  };
  const mark = (index, figure) => {
    const at = drawn.lines[0]?.values[index] ?? null;
    for (const name of ["x1", "x2"]) cursor.setAttribute(name, x(index));
    now.setAttribute("visibility", at === null ? "hidden" : "visible");
    now.setAttribute("cx", x(index));
    now.setAttribute("cy", y(at ?? 0));
    value.textContent = figure ?? (at === null ? "–" : at.toFixed(2));
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

/** The stretches without a gap, as lists of [index, value]. */
function stretches(values) {
  const found = [[]];
  values.forEach((value, index) => {
    if (value === null) found.push([]);
    else found.at(-1).push([index, value]);
  });
  return found.filter((stretch) => stretch.length > 0);
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
