// Runs before viser's own script.
(() => {
  // viser only reconnects while its document has the focus, which it never has inside a page.
  document.hasFocus = () => document.visibilityState === "visible";

  // Labels as rounded chips: viser draws them as white rectangles. Where nothing matches, it still does.
  const shaderSource = WebGL2RenderingContext.prototype.shaderSource;
  WebGL2RenderingContext.prototype.shaderSource = function (shader, source) {
    return shaderSource.call(this, shader, chips(source));
  };
  const placed = "vec2 local = (aRect.xy + corner * aRect.zw) * scale;";
  // Only the chips have no atlas rectangle; they get more room left and right of the text.
  const roomy = `float room = aUvRect.z == 0.0 ? 0.2 * aRect.w : 0.0;
  vec2 local = (aRect.xy - vec2(room, 0.0) + corner * (aRect.zw + vec2(2.0 * room, 0.0))) * scale;`;
  const declared = "varying vec2 vUv;";
  const rectangle = "gl_FragColor = vec4(1.0, 1.0, 1.0, 0.85 * vAlpha);";
  const rounded = `
    vec2 size = 1.0 / max(fwidth(vCorner), vec2(1e-5));
    vec2 reach = size * 0.5 - 0.5;
    float corner = min(reach.y, 7.0);
    vec2 over = abs((vCorner - 0.5) * size) - reach + corner;
    float away = length(max(over, 0.0)) + min(max(over.x, over.y), 0.0) - corner;
    float body = 1.0 - smoothstep(-0.9, 0.6, away);
    float rim = smoothstep(-2.0, -0.9, away);
    gl_FragColor = vec4(mix(vec3(1.0), vec3(0.66, 0.71, 0.80), rim * 0.7), body * 0.93 * vAlpha);`;
  function chips(source) {
    const vertex = source.includes("aUvRect") && source.includes("uLabelData");
    if (!vertex && !source.includes(rectangle)) return source;
    return source
      .replace(declared, `${declared}\nvarying vec2 vCorner;`)
      .replace(placed, roomy)
      .replace("vUv = vec2(", "vCorner = corner;\n  vUv = vec2(")
      .replace(rectangle, rounded);
  }

  const root = document.documentElement;
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  root.dataset.theme = dark.matches ? "dark" : "light";

  const parent = window.parent;
  if (parent === window) return;

  // The page around us owns the theme and the shortcuts.
  let plays = false;
  let drives = false;
  window.addEventListener("message", (event) => {
    if (event.origin !== window.location.origin || event.source !== parent) return;
    if (event.data?.type === "theme") root.dataset.theme = event.data.theme === "dark" ? "dark" : "light";
    if (event.data?.type === "keys") [plays, drives] = [event.data.player === true, event.data.drives === true];
  });
  const cameraKeys = new Set(["w", "a", "s", "d", "q", "e", "arrowup", "arrowdown", "arrowleft", "arrowright"]);
  const playerKeys = new Set(["arrowleft", "arrowright"]);
  const driveKeys = new Set(["w", "a", "s", "d", "arrowup", "arrowdown", "arrowleft", "arrowright"]);
  const drive = (event) => {
    if (!drives || event.ctrlKey || event.metaKey || event.altKey || !driveKeys.has(event.key.toLowerCase())) return false;
    event.preventDefault();
    event.stopImmediatePropagation();
    parent.postMessage({ type: "drive", key: event.key, down: event.type === "keydown" }, window.location.origin);
    return true;
  };
  window.addEventListener("keyup", drive, true);
  window.addEventListener("keydown", (event) => {
    if (drive(event)) return;
    if (plays && playerKeys.has(event.key.toLowerCase())) event.stopImmediatePropagation();
    else if (cameraKeys.has(event.key.toLowerCase()) && !event.ctrlKey && !event.metaKey) return;
    if (event.key === "k" && (event.ctrlKey || event.metaKey)) event.stopImmediatePropagation();
    // Dispatched, not posted: "r" has to put the cursor into a name before the next key is typed.
    const pressed = new parent.CustomEvent("view-key", { cancelable: true, detail: {
      frame: window, key: event.key, ctrlKey: event.ctrlKey, metaKey: event.metaKey, altKey: event.altKey, shiftKey: event.shiftKey,
    } });
    if (!parent.dispatchEvent(pressed)) event.preventDefault();
  }, true);
})();
