// Uploads: files dropped anywhere or chosen, one after another, each with its progress.
import { answer, ApiError } from "./api.js";
import { token } from "./format.js";
import { get, set } from "./store.js";

/** What some dropped files are: logs one by one, and a map when a .yaml comes with its image. */
export function classify(files) {
  const list = [...files];
  const is = (pattern) => (file) => pattern.test(file.name.toLowerCase());
  const yaml = list.find(is(/\.ya?ml$/));
  const image = list.find(is(/\.(pgm|png)$/));
  if (yaml && image) return [{ kind: "map", yaml, image }, ...logs(list.filter((file) => file !== yaml && file !== image))];
  return logs(list);
}

function logs(files) {
  return files.map((file) => ({ kind: "log", file }));
}

/** Sends a form; progress goes to the store's `uploads`. Resolves with the answer. */
export function send(path, name, fields) {
  const id = token();
  const form = new FormData();
  for (const [key, value] of Object.entries(fields)) if (value) form.append(key, value);
  const update = (changes) => set({ uploads: get().uploads.map((item) => (item.id === id ? { ...item, ...changes } : item)) });
  const finish = () => set({ uploads: get().uploads.filter((item) => item.id !== id) });
  return new Promise((resolve, reject) => {
    const sending = new XMLHttpRequest();
    sending.open("POST", path);
    sending.setRequestHeader("accept", "application/json");
    sending.upload.onprogress = (event) => {
      if (event.lengthComputable) update({ share: event.loaded / event.total });
    };
    sending.onload = () => {
      finish();
      try {
        resolve(answer(sending.status, sending.responseText));
      } catch (error) {
        reject(error);
      }
    };
    sending.onerror = () => {
      finish();
      reject(new ApiError(0, `${name} could not be sent: the connection broke off.`));
    };
    sending.onabort = () => {
      finish();
      reject(new ApiError(0, `The upload of ${name} was cancelled.`));
    };
    set({ uploads: [...get().uploads, { id, name, share: 0, cancel: () => sending.abort() }] });
    sending.send(form);
  });
}

export const sendLog = (file, ring) => send("api/logs", file.name, { file, ring });
export const sendMap = (yaml, image, options) => send("api/models/import", yaml.name, { yaml, image, ...options });

/** Files may be dropped anywhere on the page; `onFiles` gets them. */
export function acceptDrops(onFiles) {
  let depth = 0;
  const mark = (on) => document.body.classList.toggle("dropping", on);
  const carriesFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  addEventListener("dragenter", (event) => {
    if (!carriesFiles(event)) return;
    depth += 1;
    mark(true);
  });
  addEventListener("dragleave", () => {
    depth = Math.max(0, depth - 1);
    if (depth === 0) mark(false);
  });
  addEventListener("dragover", (event) => {
    if (carriesFiles(event)) event.preventDefault();
  });
  addEventListener("drop", (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    depth = 0;
    mark(false);
    onFiles(event.dataTransfer.files);
  });
}
