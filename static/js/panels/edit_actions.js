// Edits of nodes: each is sent, shown, and can be taken back from its message.
import { api } from "../api.js";
import { refreshLists, takeModel } from "../actions.js";
import { get } from "../store.js";
import { attempt, single, toast } from "../toasts.js";
import { select } from "../view3d.js";

/** Sends an edit of the shown model; true when it was made. */
export const edit = single(async (change, picks = () => get().selected) => {
  const before = get().model;
  const answer = await attempt(() => api.edit(before.id, change));
  if (!answer) return false;
  take(answer);
  if (get().model?.id === answer.id) select(picks(answer));
  announce(answer);
  return true;
});

/** Gives all regions of a room one name; null takes it away. */
export const nameRoom = single(async (room, label) => {
  const { model } = get();
  const answer = await attempt(() => api.labelRoom(model.id, room, label));
  if (!answer) return;
  take(answer);
  announce(answer);
});

/** Says what the last edit was, with a way back as long as nothing else has happened. */
export function announce(model) {
  const text = sentence(model.last_edit);
  if (text) toast(text, { action: { label: "Undo", run: () => undo(model.revision) }, seconds: 8 });
}

export function undo(revision) {
  return turn((model) => model.can_undo, (model) => api.undo(model.id, revision), (answer) => `Undone: ${answer.undone_edit}.`);
}

export function redo() {
  return turn((model) => model.can_redo, (model) => api.redo(model.id), (answer) => `Done again: ${answer.last_edit}.`);
}

let turned = Promise.resolve();

/** One after the other: a second one that is asked for at once finds what the first one made. */
function turn(possible, send, words) {
  turned = turned.then(() => turnNow(possible, send, words));
  return turned;
}

async function turnNow(possible, send, words) {
  const before = get().model;
  if (!before || (before.nodes && !possible(before))) return;
  const answer = await attempt(() => send(before));
  if (!answer) return;
  take(answer);
  const known = new Set(answer.nodes.map((node) => node.id));
  const { selected, picked } = get();
  if (![selected, ...picked].every((id) => id === null || known.has(id))) select(known.has(selected) ? selected : null);
  toast(words(answer));
}

function take(answer) {
  if (get().model?.id === answer.id) takeModel(answer);
  refreshLists();
}

export function sentence(words) {
  return words ? `${words[0].toUpperCase()}${words.slice(1)}.` : "";
}
