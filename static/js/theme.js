// Light or dark: the system's choice until somebody chooses.

const KEY = "echorooms.theme";
const listeners = new Set();

export function theme() {
  return document.documentElement.dataset.theme;
}

export function toggleTheme() {
  const next = theme() === "dark" ? "light" : "dark";
  try {
    localStorage.setItem(KEY, next);
  } catch {
    // It lasts until the page is closed, then.
  }
  apply(next);
}

export function onTheme(listener) {
  listeners.add(listener);
  listener(theme());
}

function apply(next) {
  document.documentElement.dataset.theme = next;
  for (const listener of listeners) listener(next);
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => {
  let chosen = null;
  try {
    chosen = localStorage.getItem(KEY);
  } catch {
    chosen = null;
  }
  if (!chosen) apply(event.matches ? "dark" : "light");
});
