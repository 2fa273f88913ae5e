// What was found in a log, in plain sentences first and in figures below.
import { files } from "../api.js";
import { h, icon } from "../dom.js";
import { bytes, count, duration, metres, percent, when } from "../format.js";

const MOST_LINES = 5;
const FORMATS = { "echorooms-log": "EchoRooms log" };
const LEAST_SCALE = 0.2;

export function logReport(log) {
  const report = log.report;
  return h("article", { class: "report" },
    h("header", {}, h("h2", {}, log.name), h("p", { class: "muted" }, `${FORMATS[report.format] ?? report.format}, ${bytes(log.size_bytes)}, uploaded ${when(log.created)} · `, h("a", { href: files.log(log.id), download: "" }, "download"))),
    verdict(report),
    robot(log.robot),
    h("section", {}, h("h3", {}, "Figures"), figures(report)),
    h("section", {}, h("h3", {}, "Sonars"), sonars(report)),
    events(report),
    findings("Clock", report.clock),
    findings("Left out", report.skipped),
    findings("Noticed", report.notes),
  );
}

function verdict(report) {
  const [first, ...more] = report.verdict;
  return h("section", { class: report.good_for_map ? "verdict good" : "verdict bad" },
    icon(report.good_for_map ? "check" : "alert"),
    h("div", {}, h("p", { class: "verdict-first" }, first), more.map((sentence) => h("p", {}, sentence))),
  );
}

function robot(known) {
  if (!known) return null;
  return h("section", {}, h("h3", {}, "This robot's odometry is known"), h("ul", { class: "findings" }, known.sentences.map((sentence) => h("li", {}, sentence))),
    h("p", { class: "muted" }, `From the drive of ${known.model_name}, ${when(known.kept)}. Choose it under More options to begin with it.`));
}

function figures(report) {
  const fact = (name, value, tip) => h("div", { title: tip }, h("dt", {}, name), h("dd", {}, value));
  return h("dl", { class: "figures" },
    fact("Scans", report.scans.toLocaleString("en")),
    fact("Sonars", report.sonars),
    fact("Duration", duration(report.duration_s)),
    fact("Driven", metres(report.distance_m)),
    fact("Rate", `${report.rate_hz.toFixed(1)} Hz`, "one over the median time between scans"),
    fact("Extent", metres(report.extent_m), "diagonal of the box around the drive"),
    fact("No echo", percent(report.no_echo), "share of readings without an echo"),
    fact("Repeated", percent(report.latched), "share of readings that only repeat an earlier measurement; they are ignored"),
  );
}

function sonars(report) {
  const scale = Math.max(LEAST_SCALE, ...report.no_echo_per_sonar);
  const note = h("p", { class: "muted" }, `Share of readings without an echo, sonar by sonar; a full bar is ${percent(scale)}.`);
  const bars = h("ul", { class: "sonars" }, report.no_echo_per_sonar.map((share, index) => h("li", { title: `sonar ${index}: ${percent(share)} without echo` },
    h("span", { class: "unseen" }, `Sonar ${index}: ${percent(share)} without echo`),
    h("span", { class: "sonar-bar", "aria-hidden": "true", style: { "--share": share / scale } }),
    h("span", { class: "sonar-number", "aria-hidden": "true" }, index),
  )));
  return [note, bars];
}

function events(report) {
  if (!report.gap_count && !report.jump_count) return null;
  return h("section", {}, h("h3", {}, "Gaps and jumps"), h("ul", { class: "findings" },
    report.gaps.map((gap) => h("li", {}, `At ${gap.t.toFixed(1)} s: ${duration(gap.seconds)} without scans, ${metres(gap.metres, 2)} driven meanwhile.`)),
    more(report.gap_count - report.gaps.length, "gap"),
    report.jumps.map((jump) => h("li", {}, `At ${jump.t.toFixed(1)} s: the odometry jumps ${metres(jump.metres, 2)} and turns ${(jump.radians * 180 / Math.PI).toFixed(0)}°.`)),
    more(report.jump_count - report.jumps.length, "jump"),
  ));
}

function findings(title, list) {
  if (!list.length) return null;
  return h("section", {}, h("h3", {}, title), h("ul", { class: "findings" }, list.map((finding) => h("li", {},
    finding.what, h("span", { class: "muted" }, ` ${finding.count > 1 ? `${count(finding.count, "time")}` : ""}${where(finding)}`),
  ))));
}

function where({ source, lines, count: times }) {
  const parts = [];
  if (source) parts.push(source);
  if (lines?.length) {
    const shown = lines.slice(0, MOST_LINES);
    parts.push(`line${shown.length > 1 ? "s" : ""} ${shown.join(", ")}${times > shown.length ? ", …" : ""}`);
  }
  return parts.length ? ` (${parts.join(", ")})` : "";
}

function more(number, word) {
  return number > 0 ? h("li", { class: "muted" }, `and ${count(number, `smaller ${word}`)}`) : null;
}
