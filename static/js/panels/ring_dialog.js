// A text log does not say where its sonars sit: asks for the ring.
import { h } from "../dom.js";
import { openDialog } from "../dialogs.js";

const PRESETS = [
  ["paper-12", "12 sonars in a circle", "every 30 degrees, 0.2 m around the centre"],
  ["circle-8", "8 sonars in a circle", "every 45 degrees"],
  ["circle-16", "16 sonars in a circle", "every 22.5 degrees"],
  ["p3dx-front-8", "Pioneer 3-DX, front", "8 sonars"],
  ["p3dx-16", "Pioneer 3-DX, all around", "16 sonars"],
];

/** Resolves with a preset's name or the text of a ring file; undefined when cancelled. */
export function askRing(name) {
  return openDialog("Where are the sonars?", (close) => {
    const file = h("input", { type: "file", accept: ".yaml,.yml,.json", id: "ring-file" });
    file.addEventListener("change", async () => close(await file.files[0].text()));
    return h("div", {},
      h("p", {}, `${name} has readings but does not say where the sonars sit on the robot.`),
      h("div", { class: "choices" }, PRESETS.map(([id, title, text], index) => h("button", {
        type: "button", class: "choice", autofocus: index === 0, onclick: () => close(id),
      }, h("strong", {}, title), h("span", {}, text)))),
      h("label", { class: "field", for: "ring-file" }, "or a ring file of your own", file),
    );
  });
}
