/* Start (pressed for a second), Hold, Resume (one click) and Abort (one press, always enabled, without confirmation). */
import { $, write } from "./dom.js";
import { digestOf, flights, locked, shown } from "./flights.js";
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

async function send(what, words, fields = {}) {
  const line = $("answer");
  line.className = ""; line.textContent = `${words} …`;
  answered(words, await ask(what, flights.namespace, fields));
}

/* Start what was shown when the press began, or nothing. */
function press() {
  const start = $("start"), { namespace } = flights, digest = digestOf(shown());
  if (start.getAttribute("aria-disabled") === "true" || pressed) return;
  start.classList.add("pressed");
  pressed = setTimeout(() => {
    pressed = null; start.classList.remove("pressed");
    const same = namespace === flights.namespace && digest === digestOf(shown());
    const why = same ? locked(shown()) : "another mission is shown than when the press began";
    if (why) answered("Start", { ok: false, message: `nothing was sent: ${why}` }); else send("start", "Start", { digest });
  }, PRESS);
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
for (const end of ["visibilitychange", "vehicle"]) document.addEventListener(end, release);
$("hold").addEventListener("click", () => send("hold", "Hold"));
$("resume").addEventListener("click", () => send("resume", "Resume"));
export const abort = () => send("abort", "Abort");
/* A click may be lost where the pointer slides off: Abort goes with the first event of a press, and once. While another button of the
   mouse is held there is no pointerdown; keys and assistive technology make a click alone. */
const stop = $("abort");
let sent = false;
function sendOnce() { if (!sent) abort(); sent = true; }
/* No click follows what begins or ends elsewhere, so that the next press counts. */
for (const kind of ["pointerdown", "pointercancel", "keydown"]) addEventListener(kind, () => { sent = false; }, true);
for (const kind of ["pointerup", "mouseup"]) addEventListener(kind, e => { if (e.target !== stop) sent = false; }, true);
for (const kind of ["pointerdown", "mousedown"]) stop.addEventListener(kind, e => { if (e.button === 0) sendOnce(); });
stop.addEventListener("click", () => { sendOnce(); sent = false; });

paints(() => {
  const v = shown(), t = v && v.tick, may = Boolean(flights.hello && flights.hello.may_command);
  $("commands").hidden = Boolean(flights.hello) && !may;
  const why = locked(v), linked = flights.link === "open";
  start.setAttribute("aria-disabled", String(Boolean(why)));
  start.title = why ? `Locked: ${why}` : "Keep pressed for one second";
  if (why && pressed) {
    clearTimeout(pressed); pressed = null; start.classList.remove("pressed");
    answered("Start", { ok: false, message: `nothing was sent: ${why}` });
  }
  $("hold").disabled = !(linked && t && t.can.hold);
  $("resume").disabled = !(linked && t && t.can.resume);
  write($("meanwhile"), t && MEANWHILE[t.state] || "");
});
