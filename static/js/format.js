// Numbers and times as people read them.

export function bytes(count) {
  if (count < 1000) return `${count} B`;
  const units = ["kB", "MB", "GB", "TB"];
  let value = count;
  let unit = -1;
  do {
    value /= 1000;
    unit += 1;
  } while (value >= 999.5 && unit < units.length - 1);
  return `${value < 9.95 ? value.toFixed(1) : value.toFixed(0)} ${units[unit]}`;
}

export function duration(seconds) {
  if (seconds < 60) return `${seconds < 10 ? seconds.toFixed(1) : Math.round(seconds)} s`;
  const minutes = Math.floor(seconds / 60);
  const rest = Math.round(seconds % 60);
  if (minutes < 60) return rest ? `${minutes} min ${rest} s` : `${minutes} min`;
  return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

export function metres(value, digits = 1) {
  return `${value.toFixed(digits)} m`;
}

export function percent(share) {
  const value = 100 * share;
  return `${value > 0 && value < 9.95 ? value.toFixed(1) : value.toFixed(0)} %`;
}

export function count(value, singular, plural = `${singular}s`) {
  return `${value.toLocaleString("en")} ${value === 1 ? singular : plural}`;
}

export function area(value) {
  return value < 9.95 ? value.toFixed(1) : value.toFixed(0);
}

export function when(iso) {
  const date = new Date(iso);
  const days = (Date.now() - date.getTime()) / 86400000;
  if (days < 1 && new Date().getDate() === date.getDate()) {
    return `today, ${date.toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" })}`;
  }
  return date.toLocaleDateString([], { year: "numeric", month: "short", day: "numeric" });
}

/** What a node is called: its label, or the stand-in that the 3D view uses too. */
export function nodeName(node) {
  return node.label || `Region ${node.region}`;
}

/** A random word for URLs; crypto.randomUUID is missing outside HTTPS and localhost. */
export function token() {
  const numbers = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(numbers, (number) => number.toString(16).padStart(2, "0")).join("");
}

/** Minutes and seconds, "2:05". */
export function clock(seconds) {
  const whole = Math.max(0, Math.round(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}
