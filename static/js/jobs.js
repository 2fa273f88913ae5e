// Following a job: server-sent events, or asking every second when they do not come through.
import { api } from "./api.js";

const POLL_MS = 1000;
const ENDED = new Set(["done", "failed", "cancelled"]);

export function ended(job) {
  return ENDED.has(job.status);
}

/** Calls `onJob` now and at every change until the job has ended. Returns a function that stops it. */
export function followJob(id, onJob, onError) {
  let stopped = false;
  let timer = null;
  const source = new EventSource(`api/jobs/${encodeURIComponent(id)}/events`);
  const stop = () => {
    stopped = true;
    source.close();
    clearTimeout(timer);
  };
  const hear = (job) => {
    if (stopped) return;
    if (ended(job)) stop();
    onJob(job);
  };
  const poll = async () => {
    try {
      hear(await api.job(id));
      if (!stopped) timer = setTimeout(poll, POLL_MS);
    } catch (error) {
      if (stopped) return;
      if (error.status === 0) timer = setTimeout(poll, 3 * POLL_MS);
      else {
        stop();
        onError(error);
      }
    }
  };
  source.onmessage = (event) => hear(JSON.parse(event.data));
  source.onerror = () => {
    source.close();
    if (!stopped) poll();
  };
  return stop;
}
