// Begin to drive: a simulated robot is made, or it is said how a real one sends its scans.
import { api } from "../api.js";
import { openDialog } from "../dialogs.js";
import { h, replace } from "../dom.js";
import { go, link } from "../router.js";
import { get } from "../store.js";
import { showError } from "../toasts.js";

const HOMES = { paper: "the paper's home (5 rooms)", mirrored: "four look-alike rooms", corridor: "a long plain corridor", hall: "one large hall", office: "an office corridor" };
const RANDOM = "random";
const ODOMETRY = { calibrated: "calibrated", bad: "bad: it drifts", none: "without errors" };
const SONARS = 12;
const SEEDS = 1000;

export async function startDialog() {
  let choices;
  try {
    choices = await api.robotChoices();
  } catch (error) {
    showError(error);
    return;
  }
  await openDialog("Drive a robot", (close) => h("div", { class: "start-live" }, simulated(choices, close), real()), { wide: true });
}

function simulated(choices, close) {
  const number = h("input", { type: "number", id: "robot-number", min: 0, max: 999_999_999, step: 1, value: 17, required: true });
  const numberField = h("label", { class: "field field-inline", for: "robot-number" }, "Number of the home", number);
  const home = select("Home", "home", [[RANDOM, "a furnished home, made from a number"], ...choices.homes.map((name) => [name, HOMES[name] ?? name])], "paper");
  const ring = select("Sonars", "ring", choices.rings.map((name) => [name, name]), "paper-12");
  const odometry = select("Odometry", "odometry", choices.odometry.map((name) => [name, ODOMETRY[name] ?? name]), "calibrated");
  const made = (get().models ?? []).filter((model) => model.status === "done");
  const model = select("What for", "model_id", [["", "map the home"], ...made.map((item) => [item.id, `find itself in “${item.name}”`])], "");
  const mode = select("At first", "mode", [["tour", "tour by itself"], ["drive", "stand: I drive"]], "tour");
  const error = h("p", { class: "form-error", role: "alert" });
  const submit = h("button", { type: "submit", class: "button button-primary button-large" }, "Start");
  const form = h("form", { class: "form" },
    h("h3", {}, "A simulated robot"), h("p", { class: "muted" }, "For people who have none. It sends its scans as a real robot would."),
    home, numberField, ring, odometry, model, mode, error, submit);
  const adapt = () => {
    numberField.hidden = new FormData(form).get("home") !== RANDOM;
    number.disabled = numberField.hidden;
  };
  form.addEventListener("change", adapt);
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    submit.disabled = true;
    replace(error);
    replace(submit, "The robot is being built…");
    try {
      const robot = await api.makeRobot(order(new FormData(form), number.value));
      close();
      go(link.live(robot.session_id));
    } catch (problem) {
      replace(error, problem.message);
    } finally {
      submit.disabled = false;
      replace(submit, "Start");
    }
  });
  adapt();
  return form;
}

function order(data, number) {
  const home = data.get("home");
  return {
    home: home === RANDOM ? `random-${Number(number)}` : home,
    ring: data.get("ring"), odometry: data.get("odometry"), mode: data.get("mode"), model_id: data.get("model_id") || null,
    seed: Math.floor(Math.random() * SEEDS),
  };
}

/** How a real robot begins; its session then is in the list on the left. */
function real() {
  const address = new URL("api/live", document.baseURI).href;
  return h("section", { class: "real-robot" },
    h("h3", {}, "A real robot"), h("p", { class: "muted" }, "It begins a session by sending its header, and appears on the left under Live."),
    copied("Send once", `POST ${address}\nContent-Type: application/json\n\n${JSON.stringify({ mode: "mapping", header: header() })}`),
    copied("then every scan, over a WebSocket", `${address.replace(/^http/, "ws")}/ID/scans`),
    copied("as one line each; the answer confirms it", '{"t": 12.25, "odom": [0.4, 1.2, 0.1], "ranges": [1.02, null, …]}'),
    h("p", {}, h("a", { href: "docs/index.html#live-robot", target: "_blank", rel: "noopener" }, "More about live robots")),
  );
}

function header() {
  const sonars = Array.from({ length: SONARS }, (_, index) => {
    const angle = ((2 * Math.PI * index) / SONARS + Math.PI) % (2 * Math.PI) - Math.PI;
    return { x: round(0.2 * Math.cos(angle)), y: round(0.2 * Math.sin(angle)), heading: round(angle), beam_width: 0.87, min_range: 0.1, max_range: 4 };
  });
  return { format: "echorooms-log", version: 1, name: "my robot", robot: { radius: 0.22 }, sonars };
}

function round(value) {
  return Math.round(1000 * value) / 1000;
}

function copied(title, text) {
  return h("figure", { class: "copied" }, h("figcaption", {}, title,
    h("button", { type: "button", class: "link-button", onclick: (event) => {
      navigator.clipboard?.writeText(text);
      replace(event.target, "Copied");
    } }, "Copy")), h("pre", { tabindex: 0 }, text));
}

function select(text, name, options, chosen) {
  return h("label", { class: "field" }, text, h("select", { name }, options.map(([value, title]) => h("option", { value, selected: value === chosen }, title))));
}
