/* The console's page: connect, keep what arrives, paint it. */
import { $, kept } from "./dom.js";
import { forgetColours } from "./drawing.js";
import { asksOf, flights, shown, take, takeRows } from "./flights.js";
import { Link } from "./link.js";
import { repaint } from "./painting.js";
import { chartKeys, fitAll } from "./chart.js";
import { choose, showLink } from "./status.js";
import { abort, commands } from "./commands.js";
import { gains, listGains, parameterChanged } from "./gains.js";
import { listMissions, missions } from "./missions.js";
import { panels } from "./panels.js";

function hear(message) {
  if (message instanceof ArrayBuffer) { if (takeRows(message)) repaint(); return; }
  const before = flights.namespace, v = take(message);
  if (message.kind === "course" && v) fitAll();
  if (message.kind === "parameters_changed") parameterChanged(message);
  if (message.kind === "hello") { if (flights.namespace !== before) document.dispatchEvent(new Event("vehicle")); again(); }
  repaint();
}

const link = new Link(hear, state => { flights.link = state; showLink(); repaint(); });
const ask = asksOf(link.ask.bind(link));
for (const use of [commands, missions, gains, panels]) use(ask);

/* Tabs. */
const tabs = [...document.querySelectorAll("[role=tab]")];
function open(tab) {
  for (const one of tabs) {
    const chosen = one === tab;
    one.setAttribute("aria-selected", String(chosen)); one.tabIndex = chosen ? 0 : -1;
    $(one.getAttribute("aria-controls")).hidden = !chosen;
  }
  if (tab.id === "open-mission") listMissions();
  if (tab.id === "open-gains") listGains();
}
/* Fill the open tab, if it could not be filled before: nodes may come later than the page. */
function again() {
  if (document.hidden || flights.link !== "open" || !shown()) return;
  if (!$("tab-mission").hidden) listMissions();
  if (!$("tab-gains").hidden) listGains();
}
setInterval(again, 3000);
tabs.forEach((tab, k) => {
  tab.addEventListener("click", () => open(tab));
  tab.addEventListener("keydown", e => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
    if (step) { const next = tabs[(k + step + tabs.length) % tabs.length]; next.focus(); open(next); }
  });
});

/* A press counts for the button that it began on, wherever new lines move that button until the release. Drawn more than
   AWAY px away, it counts where it is released: on the button it makes a click, outside none. */
const AWAY = 30;
addEventListener("pointerdown", down => {
  const button = down.target.closest("button:not(#start)"), { pointerId } = down;
  if (!button || down.button !== 0) return;
  try { button.setPointerCapture(pointerId); } catch { return; /* a press that assistive technology makes has no pointer */ }
  const drawn = e => { if (Math.hypot(e.clientX - down.clientX, e.clientY - down.clientY) > AWAY && button.hasPointerCapture(pointerId)) button.releasePointerCapture(pointerId); };
  button.addEventListener("pointermove", drawn);
  button.addEventListener("lostpointercapture", () => button.removeEventListener("pointermove", drawn), { once: true });
});

/* Day and night: the system's setting, or one of them. */
const LIGHTS = ["", "day", "night"], WORDS = { "": "Auto", day: "Day", night: "Night" };
let light = LIGHTS.includes(kept.get("console-light")) ? kept.get("console-light") : "";
function lit() {
  if (light) document.documentElement.dataset.light = light; else delete document.documentElement.dataset.light;
  $("light").textContent = WORDS[light];
  forgetColours(); repaint();
}
function otherLight() { light = LIGHTS[(LIGHTS.indexOf(light) + 1) % LIGHTS.length]; kept.set("console-light", light); lit(); }
$("light").addEventListener("click", otherLight);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", lit);

const KEYS = { ...chartKeys, n: otherLight, s: () => $("mute").click() };
addEventListener("keydown", e => {
  if (e.key === "Escape" && e.shiftKey) { e.preventDefault(); abort(); return; }
  if (e.ctrlKey || e.metaKey || e.altKey || e.target.closest("input, textarea, select, [role=tab]")) return;
  const act = KEYS[e.key] || (/^[1-9]$/.test(e.key) ? () => choose(flights.vehicles[Number(e.key) - 1]?.namespace) : null);
  if (act) act();
});
addEventListener("resize", repaint);
new ResizeObserver(repaint).observe($("chart"));
lit();
showLink();
