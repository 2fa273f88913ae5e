// One model or log in the list: a link, its facts, renaming in place, deleting.
import { h, iconButton, replace } from "../dom.js";
import { remove, rename } from "../actions.js";

export function libraryItem({ kind, item, current, href, facts, state, redraw }) {
  const element = h("li", { class: current ? "item current" : "item", dataset: { item: `${kind}:${item.id}`, state: state ?? "" } });
  const show = () => replace(element,
    h("a", { href, "aria-current": current ? "page" : null, title: item.name },
      h("span", { class: "item-name" }, item.name), h("span", { class: "item-facts" }, facts)),
    h("span", { class: "item-buttons" },
      iconButton("pencil", `Rename ${item.name}`, edit),
      iconButton("trash", `Delete ${item.name}`, () => remove(kind, item)),
    ),
  );
  const edit = () => {
    const input = h("input", { class: "rename", value: item.name, maxlength: 200, "aria-label": `New name of ${item.name}` });
    let over = false;
    const finish = async (keep) => {
      if (over) return;
      over = true;
      const name = input.value.trim();
      input.blur();
      show();
      if (keep && name && name !== item.name) await rename(kind, item, name);
    };
    input.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== "Escape") return;
      finish(event.key === "Enter");
      element.querySelector("a").focus();
      redraw(); // the list waited while there was a name being typed in it
    });
    input.addEventListener("blur", () => finish(true));
    replace(element, input);
    input.focus();
    input.select();
  };
  show();
  return element;
}
