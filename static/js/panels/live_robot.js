// What can be done with a simulated robot and its home.
import { h, icon, replace } from "../dom.js";
import { tellRobot } from "../live.js";
import { get, set, watch } from "../store.js";
import { focusView, pick } from "../view3d.js";
import { drivePad } from "./live_driving.js";

const TASKS = {
  tour: "It tours by itself.", goal: "It drives to its goal.", drive: "You drive it.", stand: "It stands.",
  waiting: "It waits until its model is made; then it looks for itself in it.",
};
const SPEEDS = [1, 2, 4, 10];

/** The next click in the map is a place for this: {kind, text, name}. */
export function startPicking(picking) {
  set({ picking });
  pick(true);
  focusView();
}

export function stopPicking() {
  if (get().picking === null) return;
  set({ picking: null });
  pick(false);
}

/** A place in the map was clicked. */
export async function picked({ x, y }) {
  const { picking } = get();
  stopPicking();
  if (picking?.kind === "goal") await tellRobot({ type: "goal", x, y });
  if (picking?.kind === "place") await tellRobot({ type: "place", x, y });
  if (picking?.kind === "furniture") await tellRobot({ type: "furniture", name: picking.name, x, y });
}

export function liveRobot(root) {
  const said = h("p", { class: "robot-said", role: "status" });
  const tour = button("Tour", "Let it drive by itself", () => tellRobot({ type: "tour" }));
  const stop = button("Stop", "Let it stand", () => tellRobot({ type: "stop" }));
  const goal = button("Click a goal", "Click where it is to drive to", () => startPicking({ kind: "goal", text: "Click where the robot is to drive to." }));
  const carry = button("Pick it up", "Carry it elsewhere; its odometry does not notice", () => startPicking({ kind: "place", text: "Click where to put the robot down. Its odometry will not notice." }));
  const localize = h("button", { type: "button", class: "button button-primary localize-now", onclick: () => tellRobot({ type: "localize" }) }, icon("waves"), "Localize in this map");
  const hint = h("p", { class: "muted" });
  const speed = h("select", { "aria-label": "Speed of time", onchange: () => tellRobot({ type: "speed", speed: Number(speed.value) }) }, SPEEDS.map((value) => h("option", { value }, `${value} ×`)));
  const doors = h("ul", { class: "doors", "aria-label": "Doors" });
  const piece = h("select", { "aria-label": "Furniture" });
  const move = button("Move…", "Click where it is to stand", () => startPicking({ kind: "furniture", name: piece.value, text: `Click where the ${piece.value} is to stand.` }));
  replace(root, h("h2", {}, "The robot", h("small", {}, "simulated")), said,
    h("div", { class: "robot-drive" }, drivePad(), h("div", { class: "robot-buttons" }, tour, stop, goal, carry)),
    h("label", { class: "field field-inline robot-speed" }, "Time runs", speed), localize, hint,
    h("details", { class: "advanced" }, h("summary", {}, "The home: doors and furniture"), doors, h("div", { class: "furniture" }, piece, move)));
  watch(["robot", "route", "model", "picking"], ({ robot, model, picking }) => {
    root.hidden = !robot;
    if (!robot) return;
    const mapping = robot.mode === "mapping";
    const waits = robot.task === "waiting" || robot.ended !== null;
    replace(said, sentence(robot));
    for (const part of [tour, stop, goal, carry, move, speed]) part.disabled = waits;
    press(tour, robot.task === "tour");
    press(goal, picking?.kind === "goal" || robot.task === "goal");
    press(carry, picking?.kind === "place");
    localize.hidden = !mapping || waits;
    localize.disabled = !model?.nodes?.length;
    replace(hint, mapping && !waits ? "Ends the mapping. Then pick it up: bars tell where it finds itself." : null);
    if (document.activeElement !== speed) speed.value = String(robot.speed);
    showDoors(doors, robot.doors);
    showFurniture(piece, robot.furniture);
  });
}

function sentence(robot) {
  if (robot.ended) return `It drives no more: ${robot.ended}.`;
  if (robot.blocked) return "It has run into something.";
  if (robot.task === "stand" && robot.toured) return "It has been everywhere, and stands.";
  return TASKS[robot.task] ?? robot.task;
}

function showDoors(list, doors) {
  const key = JSON.stringify(doors);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  replace(list, doors.map((door) => h("li", {}, h("label", { class: "check" },
    h("input", { type: "checkbox", checked: !door.shut, onchange: async (event) => {
      const done = await tellRobot({ type: "door", name: door.name, shut: !event.target.checked });
      if (!done) event.target.checked = !door.shut;
    } }), `${door.rooms[0]} – ${door.rooms[1]}`, h("small", {}, door.shut ? "shut" : "open")))),
  doors.length === 0 && h("li", { class: "nothing" }, "It has no doors that could be shut."));
}

function showFurniture(choice, furniture) {
  const key = furniture.map((piece) => piece.name).join("\n");
  if (choice.dataset.key === key) return;
  choice.dataset.key = key;
  const names = furniture.map((piece) => piece.name);
  replace(choice, names.map((name) => h("option", { value: name, selected: name === "sofa" }, name)));
  choice.parentElement.hidden = names.length === 0;
}

function button(text, tip, onclick) {
  return h("button", { type: "button", class: "button", title: tip, onclick }, text);
}

function press(element, on) {
  element.setAttribute("aria-pressed", String(on));
}
