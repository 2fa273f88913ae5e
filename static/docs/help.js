// Shows the help pages, which are Markdown files beside this one.
import { h, replace } from "../js/dom.js";
import { markdown } from "./markdown.js";

const PAGES = { "getting-started": "Getting started", rooms: "Map and rooms", "live-robot": "A live robot", live: "Sending scans, tokens", logs: "Log files", api: "API by curl" };

async function show() {
  const name = location.hash.slice(1) in PAGES ? location.hash.slice(1) : "getting-started";
  const main = document.getElementById("page");
  replace(document.getElementById("pages"), Object.entries(PAGES).map(([key, title]) => h("a", { href: `#${key}`, "aria-current": key === name ? "page" : null }, title)),
    h("a", { href: "../docs" }, "API reference"));
  document.title = `${PAGES[name]} – EchoRooms help`;
  const answer = await fetch(`${name}.md`);
  replace(main, answer.ok ? markdown(await answer.text()) : h("p", {}, "This page is missing."));
  main.focus();
  scrollTo(0, 0);
}

addEventListener("hashchange", show);
show();
