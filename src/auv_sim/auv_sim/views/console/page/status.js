/* The head of the page: state and reason, progress, figures, pre-flight line, vehicles; the banner. */
import { $, clock, el, keep, renew, write } from "./dom.js";
import { fmt } from "./drawing.js";
import { flights, guided, isLocated, reasonOf, shown, stateOf } from "./flights.js";
import { heading } from "./rows.js";
import { paints, repaint } from "./painting.js";

const STATES = ["idle", "running", "holding", "complete", "aborted"];
const LOST = {
  lost: "No link to the console's server. What is shown is old. Abort does not reach the vehicle from here.",
  refused: "The console was restarted. Open the address that it printed.",
  outdated: "The console is of another version than this page. Reload the page; until then nothing is sent.",
};

function badge(v) {
  const sure = guided(v), state = v.tick ? v.tick.state : "", known = STATES.includes(state) ? state : "unknown";
  $("state").dataset.state = sure ? known : "silent";
  write($("state-name"), state || "no state");
  write($("state-reason"), reasonOf(v));
}

function progress(v) {
  const t = v.tick, share = t && Number.isFinite(t.share) ? Math.max(0, Math.min(1, t.share)) : 0, bar = $("progress");
  $("flown").style.width = `${100 * share}%`;
  bar.setAttribute("aria-valuenow", Math.round(100 * share));
  write($("share"), t && Number.isFinite(t.share) ? `${fmt(100 * share, 1)} %` : "–");
  const mission = v.course && v.course.mission;
  write($("mission-name"), mission ? `${mission.name}  ${mission.digest ? mission.digest.slice(0, 8) : ""}` : "no mission");
  write($("lengths"), t ? `${fmt(t.flown, 0)} of ${fmt(t.length, 0)} m` : "–");
}

function figures(v) {
  const t = v.tick, table = v.table, next = t && t.next_joint, there = isLocated(v), p = there && t && t.pose;
  const last = (name, digits, unit) => there ? `${fmt(table.last(name), digits)} ${unit}` : "–";
  write($("mission-time"), t ? clock(t.mission_time) : "–");
  write($("to-go"), t ? clock(t.time_to_go) : "–");
  write($("next-joint"), next ? `${next.kind} in ${fmt(next.distance, 0)} m, ${clock(next.time)}` : "–");
  write($("now-heading"), p && Number.isFinite(p[3]) ? `${String(Math.round(heading(p[3])) % 360).padStart(3, "0")}°` : "–");
  write($("now-speed"), last("u", 2, "m/s"));
  $("depth-box").hidden = !table.seen.has("depth");
  write($("now-depth"), table.seen.has("depth") ? last("depth", 1, "m") : "–");
  write($("now-ye"), last("ye", 2, "m"));
}

function preflight(v) {
  const t = v.tick, line = $("preflight"), before = !t || !["running", "holding"].includes(t.state);
  line.hidden = !before || !t || !t.preflight;
  if (line.hidden) return;
  line.dataset.ready = t.preflight.ready;
  write($("preflight-word"), t.preflight.ready ? "Ready to start" : "Not ready");
  renew($("preflight-items"), t.preflight.items, item => el("li", { class: item.ok ? "ok" : "bad", title: item.text },
    el("b", { text: item.ok ? "✓" : "✗", "aria-hidden": "true" }), ` ${item.name}`, el("span", { text: item.text ? ` ${item.text}` : "" })));
}

function vehicles() {
  const list = $("vehicles");
  list.hidden = flights.vehicles.length < 2 && Boolean(shown());
  if (list.hidden) return;
  keep(list, flights.vehicles, v => v.namespace,
    ({ name, namespace }) => el("button", { type: "button", onclick: () => choose(namespace) }, el("i"), `${name || namespace} `, el("small")),
    (button, v) => {
      button.setAttribute("aria-pressed", String(v === shown()));
      button.querySelector("i").style.background = `var(--${v.colour})`;
      write(button.querySelector("small"), v.alarms.some(a => a.active) ? `${stateOf(v)}, alarm` : stateOf(v));
    });
}

/* Show another vehicle. */
export function choose(namespace) {
  if (!namespace || namespace === flights.namespace) return;
  flights.namespace = namespace;
  document.dispatchEvent(new Event("vehicle"));
  repaint();
}

/* Show at once whether the link stands; the page does not wait for its next paint. */
export function showLink() {
  const banner = $("banner");
  banner.hidden = flights.link === "open";
  write(banner, LOST[flights.link] || "");
  document.body.classList.toggle("old", flights.link !== "open");
  if (flights.link !== "open") $("state").dataset.state = "silent";
}

/* After a restart of the console the vehicle that was shown may not be discovered yet: show no other in its place. */
function unlisted(hello) {
  const { namespace } = flights;
  $("state").dataset.state = "silent"; $("preflight").hidden = true;
  write($("state-name"), "no state");
  write($("state-reason"), !hello ? "not heard yet" : namespace ? `${namespace} is not heard yet` : "no vehicle is heard in this ROS domain");
  for (const one of document.querySelectorAll("#figures dd, #lengths, #share")) write(one, "–");
  write($("mission-name"), "no mission");
  $("flown").style.width = "0";
  document.title = namespace ? `not heard · ${namespace}` : "console";
}

function draw() {
  const v = shown(), hello = flights.hello;
  write($("viewer"), hello ? `browser ${hello.viewer}` : "");
  $("view-only").hidden = !hello || hello.may_command;
  vehicles();
  if (!v) { unlisted(hello); return; }
  badge(v); progress(v); figures(v); preflight(v);
  document.title = `${stateOf(v)} · ${v.name || v.namespace}`;
}
paints(draw);
