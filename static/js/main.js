// Puts the page together.
import { refreshLists, reloadModel, showRoute, takeLabels, upload } from "./actions.js";
import { takeSpan, watchWhatDrives } from "./live.js";
import { details } from "./panels/details.js";
import { startDriftView } from "./panels/drift_view.js";
import { pointed } from "./panels/drift_tools.js";
import { redo, undo } from "./panels/edit_actions.js";
import { startCut, stopCut } from "./panels/edit_cut.js";
import { startGrowthPlayer } from "./panels/growth_player.js";
import { layers } from "./panels/layers.js";
import { driveByKey, startDriving } from "./panels/live_driving.js";
import { picked, stopPicking } from "./panels/live_robot.js";
import { startLocalizationPlayer } from "./panels/localization_player.js";
import { goTo, isOpen, playPause, step } from "./panels/player.js";
import { playerControls } from "./panels/player_controls.js";
import { chooseFiles, library } from "./panels/library.js";
import { renameSelected } from "./panels/node_table.js";
import { stage } from "./panels/stage.js";
import { screenshot, topbar } from "./panels/topbar.js";
import { go, link, startRouter } from "./router.js";
import { helpDialog, shortcut, startShortcuts } from "./shortcuts.js";
import { startSecondView } from "./second_view.js";
import { get, set } from "./store.js";
import { toggleTheme } from "./theme.js";
import { toast } from "./toasts.js";
import { acceptDrops } from "./upload.js";
import { measure, moveCamera, onView, select } from "./view3d.js";

const REFRESH_MS = 15_000;

const byId = (id) => document.getElementById(id);

topbar(byId("topbar"));
library(byId("library"));
layers(byId("library"));
stage(byId("stage"));
details(byId("details"));
playerControls(byId("player"));
startLocalizationPlayer();
startGrowthPlayer();
startDriftView();
startSecondView();
startDriving();

onView({
  onLabels: takeLabels,
  onChanged: reloadModel,
  onPointed: pointed,
  onPicked: picked,
  onTrack: takeSpan,
  onDrive: driveByKey,
  onSelected: (node) => document.querySelector(`tr[data-node="${CSS.escape(node ?? "")}"]`)?.scrollIntoView({ block: "nearest" }),
  onDeleted: () => {
    toast("This model was deleted.", { kind: "error" });
    refreshLists();
    go(link.home());
  },
});

const showsRooms = ({ growth, drift, compare, localization }) => !(growth || drift || compare || localization);
const toggleSide = (side) => () => document.body.classList.toggle(`hide-${side}`);
shortcut("/", "search models and logs", () => byId("search").focus());
shortcut("u", "upload files", chooseFiles);
shortcut("1", "3D view", () => moveCamera("3d"));
shortcut("2", "top view", () => moveCamera("top"));
shortcut("f", "show everything", () => moveCamera("fit"));
shortcut("m", "measure a distance", () => measure(!get().measuring));
shortcut("r", "rename the selected room", renameSelected);
shortcut("s", "split the selected room", () => get().selected && showsRooms(get().route) && startCut(get().selected));
shortcut("Ctrl+z", "undo the last edit", () => undo());
shortcut("Ctrl+Shift+z", "redo it", redo);
shortcut(" ", "play or pause a localization or how a model grew", () => isOpen() && playPause());
shortcut("ArrowLeft", "one step back", () => isOpen() && step(-1));
shortcut("ArrowRight", "one step on", () => isOpen() && step(1));
shortcut("Home", "the first step", () => isOpen() && goTo(0));
shortcut("End", "the last step", () => isOpen() && goTo(Infinity));
shortcut("p", "save a picture", screenshot);
shortcut("t", "light or dark", toggleTheme);
shortcut("[", "hide or show the left column", toggleSide("left"));
shortcut("]", "hide or show the right column", toggleSide("right"));
shortcut("?", "this help", helpDialog);
shortcut("Escape", "end measuring, select nothing", () => {
  if (get().picking) stopPicking();
  else if (get().cutting) stopCut();
  else if (get().measuring) measure(false);
  else select(null);
});
startShortcuts();

acceptDrops(upload);
startRouter(showRoute);
refreshLists();
watchWhatDrives();
setInterval(() => document.visibilityState === "visible" && refreshLists(), REFRESH_MS);
addEventListener("focus", refreshLists);
