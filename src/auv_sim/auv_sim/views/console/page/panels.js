/* Health, events and alarms. An alarm sounds until it is acknowledged. */
import { $, clock, el, kept, renew, write } from "./dom.js";
import { flights, shown } from "./flights.js";
import { paints, repaint } from "./painting.js";

const LEVELS = ["ok", "warning", "error", "silent"];
let ask = null, context = null, muted = kept.get("console-muted") === "true";

/* ask: the link's. */
export function panels(asks) { ask = asks; }

function health(v) {
  const nodes = v.tick ? v.tick.health : [], silent = flights.link !== "open";
  renew($("health"), nodes.map(one => ({ ...one, age: one.age === null ? null : Math.round(one.age * 10) / 10, silent })), one => {
    const level = one.age === null ? "never" : silent ? "silent" : LEVELS[one.level] || "silent";
    const age = one.age === null ? "not heard" : one.age < 1 ? "now" : `${one.age < 10 ? one.age.toFixed(1) : clock(one.age)} s ago`;
    return el("tr", { class: level }, el("td", {}, el("i", { title: level }), one.node), el("td", {}, el("div", { class: "brief", title: one.message || level, text: one.message || level })),
      el("td", { text: one.age >= 10 ? `${clock(one.age)} ago` : age }));
  });
}

function events(v) {
  const list = $("events"), least = Number($("event-level").value), order = ["info", "warning", "error"];
  const some = v.events.filter(e => order.indexOf(e.level) >= least).slice(-200).reverse();
  renew(list, some, e => el("tr", { class: e.level, title: e.wall ? `${e.wall}` : null },
    el("td", { text: Number.isFinite(e.mission_time) ? clock(e.mission_time) : "" }), el("td", { text: e.source }), el("td", { text: e.text })));
  $("no-events").hidden = some.length > 0;
}

const acknowledge = a => ask("acknowledge", a.namespace, { alarm: a.id });

/* All alarms of all vehicles that are not yet acknowledged, or still active. */
const alarms = () => flights.vehicles.flatMap(v => v.alarms.map(a => ({ ...a, namespace: v.namespace, of: v.name || v.namespace })));

function alarmBar() {
  const all = alarms(), several = flights.vehicles.length > 1, may = Boolean(flights.hello && flights.hello.may_command);
  const open = all.filter(a => !a.acknowledged), most = { all: true, open };
  $("alarms").hidden = !all.length;
  renew($("alarms"), [...(may && open.length > 2 ? [most] : []), ...all.map(a => ({ ...a, may }))], a => {
    if (a.all) return el("div", { class: "alarm all" }, `${open.length} alarms`,
      el("button", { type: "button", text: "Acknowledge all", onclick: () => open.forEach(acknowledge) }));
    const state = a.active ? "" : " (over)";
    const row = el("div", { class: a.acknowledged ? "alarm seen" : "alarm" }, el("strong", { text: "Alarm" }),
      el("span", { text: `${several ? a.of + ": " : ""}${a.text}${state}` }),
      el("small", { text: Number.isFinite(a.since) ? `at ${clock(a.since)} of the mission` : "" }));
    if (!a.acknowledged && may) row.append(el("button", { type: "button", text: "Acknowledge", "aria-label": `Acknowledge: ${a.text}`,
      onclick: () => acknowledge(a) }));
    else if (a.acknowledged) row.append(el("small", { text: "acknowledged" }));
    return row;
  });
}

function sounds() {
  const button = $("mute");
  button.setAttribute("aria-pressed", String(muted));
  write(button, muted ? "Sound off" : context ? "Sound on" : "Sound waits");
  button.title = context || muted ? "Mute or unmute alarms" : "A browser makes no sound before the first click on the page";
}

function beep() {
  if (muted || !context || !alarms().some(a => !a.acknowledged)) return;
  for (const [after, hertz] of [[0, 880], [0.22, 660]]) {
    const tone = context.createOscillator(), volume = context.createGain(), at = context.currentTime + after;
    tone.frequency.value = hertz; volume.gain.setValueAtTime(0.15, at); volume.gain.exponentialRampToValueAtTime(0.001, at + 0.2);
    tone.connect(volume).connect(context.destination); tone.start(at); tone.stop(at + 0.2);
  }
}

$("mute").addEventListener("click", () => { muted = !muted; kept.set("console-muted", muted); repaint(); });
$("event-level").addEventListener("change", repaint);
const wake = () => { context ||= new AudioContext(); context.resume(); repaint(); };
addEventListener("pointerdown", wake, { once: true });
addEventListener("keydown", wake, { once: true });
setInterval(beep, 2000);

paints(() => {
  const v = shown() || { tick: null, events: [] };
  alarmBar(); sounds(); health(v); events(v);
});
