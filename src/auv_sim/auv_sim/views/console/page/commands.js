/* Start (pressed for a second), Hold, Resume and Abort (one click, always enabled, never asks). */
import { $, write } from "./dom.js";
import { flights, shown } from "./flights.js";
import { paints, repaint } from "./painting.js";

const PRESS = 1000, MEANWHILE = {
  running: "Hold sets thrust and fins to 0: the vehicle drifts with the current, and a buoyant one comes up.",
  holding: "On hold: thrust and fins are 0. The vehicle drifts with the current, and a buoyant one comes up. Resume flies back to the path.",
};
let ask = null, pressed = null;

/* ask: the link's. */
export function commands(asks) { ask = asks; }

/* Show what a request led to. */
export function answered(what, answer) {
  const line = $("answer");
  line.className = answer.ok ? "ok" : "bad";
  line.textContent = `${what}: ${answer.message || (answer.ok ? "done" : "refused")}`;
}

async function send(what, words) {
  const line = $("answer");
  line.className = ""; line.textContent = `${words} …`;
  answered(words, await ask(what, { vehicle: flights.chosen }));
}

function press() {
  const start = $("start");
  if (start.getAttribute("aria-disabled") === "true" || pressed) return;
  start.classList.add("pressed");
  pressed = setTimeout(() => { pressed = null; start.classList.remove("pressed"); send("start", "Start"); }, PRESS);
}

function release() {
  if (pressed) { clearTimeout(pressed); write($("answer"), "Start: keep it pressed for one second."); $("answer").className = ""; }
  pressed = null;
  $("start").classList.remove("pressed");
}

const start = $("start"), isPress = e => e.key === "Enter" || e.key === " ";
start.addEventListener("pointerdown", e => { if (e.button === 0) press(); });
for (const end of ["pointerup", "pointerleave", "pointercancel", "blur"]) start.addEventListener(end, release);
start.addEventListener("keydown", e => { if (isPress(e)) { e.preventDefault(); if (!e.repeat) press(); } });
start.addEventListener("keyup", e => { if (isPress(e)) { e.preventDefault(); release(); } });
start.addEventListener("contextmenu", e => e.preventDefault());
document.addEventListener("visibilitychange", release);
$("hold").addEventListener("click", () => send("hold", "Hold"));
$("resume").addEventListener("click", () => send("resume", "Resume"));
export const abort = () => send("abort", "Abort");
$("abort").addEventListener("click", abort);

/* Why Start is locked; empty: it is not. */
function locked(t) {
  if (!t || flights.link !== "open") return "no data";
  if (["running", "holding"].includes(t.state)) return `the mission is ${t.state}`;
  if (t.preflight && !t.preflight.ready) return "the pre-flight line is not ready";
  return t.can.start ? "" : "guidance does not offer it now";
}

paints(() => {
  const v = shown(), t = v && v.tick, may = Boolean(flights.hello && flights.hello.may_command);
  $("commands").hidden = Boolean(flights.hello) && !may;
  const why = locked(t), linked = flights.link === "open";
  start.setAttribute("aria-disabled", String(Boolean(why)));
  start.title = why ? `Locked: ${why}` : "Keep pressed for one second";
  if (why) { clearTimeout(pressed); pressed = null; start.classList.remove("pressed"); }
  $("hold").disabled = !(linked && t && t.can.hold);
  $("resume").disabled = !(linked && t && t.can.resume);
  write($("meanwhile"), t && MEANWHILE[t.state] || "");
});
