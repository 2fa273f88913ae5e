// Addresses that can be sent to somebody: #/models/ID, #/models/ID/localizations/LID, #/models/ID/growth,
// #/models/ID/drift, #/models/ID/compare/OTHER, #/logs/ID, #/live/ID, #/.
import { set } from "./store.js";

export function parse(hash) {
  const [, log] = hash.match(/^#\/logs\/([^/]+)$/) ?? [];
  const [, live] = hash.match(/^#\/live\/([^/]+)$/) ?? [];
  const [, model, more, localization, other] = hash.match(/^#\/models\/([^/]+)(\/localizations\/([^/]+)|\/compare\/([^/]+)|\/growth|\/drift)?$/) ?? [];
  const home = { page: "home", id: null, localization: null, growth: false, drift: false, compare: null };
  try {
    if (log) return { ...home, page: "log", id: decodeURIComponent(log) };
    if (live) return { ...home, page: "live", id: decodeURIComponent(live) };
    if (!model) return home;
    return {
      page: "model",
      id: decodeURIComponent(model),
      localization: localization ? decodeURIComponent(localization) : null,
      growth: more === "/growth",
      drift: more === "/drift",
      compare: other ? decodeURIComponent(other) : null,
    };
  } catch {
    return home;
  }
}

export const link = {
  home: () => "#/",
  model: (id) => `#/models/${encodeURIComponent(id)}`,
  compare: (model, other) => `${link.model(model)}/compare/${encodeURIComponent(other)}`,
  growth: (model) => `${link.model(model)}/growth`,
  drift: (model) => `${link.model(model)}/drift`,
  localization: (model, id) => `${link.model(model)}/localizations/${encodeURIComponent(id)}`,
  live: (id) => `#/live/${encodeURIComponent(id)}`,
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
