// Addresses that can be sent to somebody: #/models/ID, #/logs/ID, #/.
import { set } from "./store.js";

export function parse(hash) {
  const [, page, id] = hash.match(/^#\/(models|logs)\/([^/]+)$/) ?? [];
  if (!page) return { page: "home", id: null };
  try {
    return { page: page === "models" ? "model" : "log", id: decodeURIComponent(id) };
  } catch {
    return { page: "home", id: null };
  }
}

export const link = {
  home: () => "#/",
  model: (id) => `#/models/${encodeURIComponent(id)}`,
  log: (id) => `#/logs/${encodeURIComponent(id)}`,
};

export function go(address) {
  location.hash = address;
}

export function startRouter(onRoute) {
  const apply = () => {
    const route = parse(location.hash);
    set({ route });
    onRoute(route);
  };
  addEventListener("hashchange", apply);
  apply();
}
