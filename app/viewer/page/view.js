// Runs before viser's own script.
(() => {
  // viser only reconnects while its document has the focus, which it never has inside a page.
  document.hasFocus = () => document.visibilityState === "visible";

  const root = document.documentElement;
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  root.dataset.theme = dark.matches ? "dark" : "light";

  const parent = window.parent;
  if (parent === window) return;

  // The page around us owns the theme and the shortcuts.
  window.addEventListener("message", (event) => {
    if (event.origin !== window.location.origin || event.source !== parent) return;
    if (event.data?.type === "theme") root.dataset.theme = event.data.theme === "dark" ? "dark" : "light";
  });
  const cameraKeys = new Set(["w", "a", "s", "d", "q", "e", "arrowup", "arrowdown", "arrowleft", "arrowright"]);
  window.addEventListener("keydown", (event) => {
    if (cameraKeys.has(event.key.toLowerCase()) && !event.ctrlKey && !event.metaKey) return;
    if (event.key === "k" && (event.ctrlKey || event.metaKey)) event.stopImmediatePropagation();
    parent.postMessage({
      type: "key", key: event.key, ctrl: event.ctrlKey, meta: event.metaKey, alt: event.altKey, shift: event.shiftKey,
    }, window.location.origin);
  }, true);
})();
