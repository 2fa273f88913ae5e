// The Markdown that the help pages use -> elements: headings, lists, tables, code, links, pictures.
import { h } from "../js/dom.js";

/** Blocks of a text. Whatever is not Markdown stays text. */
export function markdown(text) {
  const lines = text.replaceAll("\r", "").split("\n");
  const blocks = [];
  let at = 0;
  const take = (belongs) => {
    const taken = [];
    while (at < lines.length && belongs(lines[at])) taken.push(lines[at++]);
    return taken;
  };
  while (at < lines.length) {
    const line = lines[at];
    if (line.trim() === "") at += 1;
    else if (line.startsWith("```")) {
      at += 1;
      const code = take((next) => !next.startsWith("```"));
      at += 1;
      blocks.push(h("pre", { tabindex: 0 }, h("code", {}, code.join("\n"))));
    } else if (/^#{1,3} /.test(line)) {
      at += 1;
      const [, marks, title] = line.match(/^(#+) (.*)$/);
      blocks.push(h(`h${marks.length}`, {}, inline(title)));
    } else if (line.startsWith("|")) blocks.push(table(take((next) => next.startsWith("|"))));
    else if (ITEM.test(line)) blocks.push(list(take((next) => ITEM.test(next) || /^ {2,}\S/.test(next))));
    else blocks.push(h("p", {}, inline(take((next) => next.trim() !== "" && !/^(#|```|\|)/.test(next) && !ITEM.test(next)).join(" "))));
  }
  return blocks;
}

const ITEM = /^(-|\d+\.) /;
const INLINE = /(`[^`]+`)|(\*\*[^*]+\*\*)|(!?\[[^\]]*\]\([^)]+\))/;

function list(lines) {
  const items = [];
  for (const line of lines) {
    if (ITEM.test(line)) items.push(line.replace(ITEM, ""));
    else items[items.length - 1] += ` ${line.trim()}`;
  }
  return h(/^\d/.test(lines[0]) ? "ol" : "ul", {}, items.map((item) => h("li", {}, inline(item))));
}

function table(lines) {
  const cells = (line) => line.replace(/^\||\|$/g, "").split(/(?<!\\)\|/).map((cell) => cell.trim().replaceAll("\\|", "|"));
  const [head, , ...rows] = lines.map(cells);
  return h("table", {},
    h("thead", {}, h("tr", {}, head.map((cell) => h("th", { scope: "col" }, inline(cell))))),
    h("tbody", {}, rows.map((row) => h("tr", {}, row.map((cell) => h("td", {}, inline(cell)))))),
  );
}

function inline(text) {
  return text.split(INLINE).filter(Boolean).map((part) => {
    if (part.startsWith("`") && part.endsWith("`") && part.length > 1) return h("code", {}, part.slice(1, -1));
    if (part.startsWith("**") && part.endsWith("**") && part.length > 3) return h("strong", {}, part.slice(2, -2));
    const link = part.match(/^(!?)\[([^\]]*)\]\(([^)]+)\)$/);
    if (!link || /^\s*javascript:/i.test(link[3])) return part;
    return link[1] ? h("img", { src: link[3], alt: link[2] }) : h("a", { href: link[3] }, link[2]);
  });
}
