// The drift of the shown model's drive: loading it, and what the 3D view shows of it.
import { api } from "../api.js";
import { get, set, watch } from "../store.js";
import { showError } from "../toasts.js";
import { onConnected, select, tell } from "../view3d.js";

export function startDriftView() {
  let loaded = null; // the model and revision whose drift is there
  let shown = false;
  watch(["route", "model"], ({ route, model }) => {
    const wanted = route.drift && model?.id === route.id && model.status === "done" ? `${model.id} ${model.revision}` : null;
    if (wanted === loaded) return;
    const another = wanted?.split(" ")[0] !== get().drift?.model;
    loaded = wanted;
    set({ driftTool: null, driftClosure: null, ...(another && { drift: null, driftShare: 1 }) });
    if (wanted === null) return;
    select(null);
    load(model.id, () => loaded === wanted);
  });
  const show = () => {
    const { route, drift, driftShare, driftClosure, driftTool } = get();
    const on = route.drift && drift !== null && !drift.missing;
    if (on || shown) tell({ type: "drift", on, share: driftShare, closure: driftClosure, places: driftTool?.t === undefined ? [] : [driftTool.t] });
    shown = on;
  };
  watch(["route", "drift", "driftShare", "driftClosure", "driftTool"], show);
  onConnected(show);
}

async function load(model, stillWanted) {
  try {
    const drift = await api.drift(model);
    if (stillWanted()) set({ drift: { ...drift, model } });
  } catch (error) {
    if (stillWanted()) set({ drift: { model, missing: true } });
    if (error.status !== 404) showError(error);
  }
}
