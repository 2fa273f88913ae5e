// The right column: the rooms of a model, or the form that makes one from a log.
import { h, replace } from "../dom.js";
import { get, watch } from "../store.js";
import { comparePanel } from "./compare_panel.js";
import { convexityChart } from "./convexity_chart.js";
import { editHistory } from "./edit_history.js";
import { growthPanel } from "./growth_panel.js";
import { livePanel } from "./live_panel.js";
import { localizationList } from "./localization_list.js";
import { localizationPanel } from "./localization_panel.js";
import { modelFacts } from "./model_facts.js";
import { modellingForm } from "./modelling_form.js";
import { nodeTable } from "./node_table.js";
import { selection } from "./selection.js";

export function details(root) {
  const table = h("section", {});
  const history = h("div", { class: "edit-history", role: "group", "aria-label": "Undo and redo" });
  const chosen = h("section", { class: "selection", "aria-live": "polite" });
  const localizations = h("section", { class: "localizations" });
  const convexity = h("section", {});
  const facts = h("section", {});
  const live = h("section", { class: "live" });
  const rooms = h("div", { class: "stack" }, live, table, chosen, localizations, convexity, facts);
  const played = h("div", { class: "stack localization" });
  const grew = h("div", { class: "stack growth" });
  const form = h("div", { class: "stack" });
  const compared = h("div", { class: "stack" });
  replace(root, rooms, played, grew, compared, form);
  nodeTable(table);
  table.querySelector("h2").append(history);
  editHistory(history);
  selection(chosen);
  convexityChart(convexity);
  modelFacts(facts);
  localizationList(localizations);
  localizationPanel(played);
  growthPanel(grew);
  comparePanel(compared);
  livePanel(live);
  watch(["route", "log", "model", "live"], () => {
    const { log, model, route } = get();
    const isLive = route.page === "live" && get().live !== null;
    const showsRooms = isLive || (route.page === "model" && model?.status === "done");
    live.hidden = !isLive;
    facts.hidden = localizations.hidden = convexity.hidden = isLive;
    table.hidden = chosen.hidden = isLive && !model?.nodes?.length;
    const showsForm = route.page === "log" && log !== null;
    rooms.hidden = !showsRooms || route.localization !== null || route.growth || route.compare !== null;
    grew.hidden = !showsRooms || !route.growth;
    compared.hidden = !showsRooms || route.compare === null;
    played.hidden = !showsRooms || route.localization === null;
    form.hidden = !showsForm;
    root.hidden = !showsRooms && !showsForm;
    if (showsForm && form.dataset.log !== log.id) replace(form, modellingForm(log));
    form.dataset.log = showsForm ? log.id : "";
  });
}
