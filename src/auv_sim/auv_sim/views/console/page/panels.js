/* Health, events and alarms. An alarm sounds until it is acknowledged. */
import { $, clock, el, keep, kept, renew, write } from "./dom.js";
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
  /* The button for all is the last: the one below the pointer stays the same. */
  keep($("alarms"), [...all, ...(may && open.length > 2 ? [most] : [])], a => a.all ? "all" : `${a.namespace} ${a.id}`, alarmRow, (row, a) => {
    row.of = a;
    const [button, words, since] = ["button", "span", ".since"].map(name => row.querySelector(name));
    if (a.all) { write(words, `${open.length} alarms`); return; }
    row.classList.toggle("seen", a.acknowledged);
    write(words, `${several ? a.of + ": " : ""}${a.text}${a.active ? "" : " (over)"}`);
    write(since, Number.isFinite(a.since) ? `at ${clock(a.since)} of the mission` : "");
    button.hidden = a.acknowledged || !may;
    button.setAttribute("aria-label", `Acknowledge: ${a.text}`);
    row.querySelector(".done").hidden = !a.acknowledged;
  });
}

/* A row of the bar; its property `of` is what it shows. */
function alarmRow({ all }) {
  const button = (text, act) => el("button", { type: "button", text, onclick: e => act(e.currentTarget.parentElement.of) });
  if (all) return el("div", { class: "alarm all" }, el("span"), button("Acknowledge all", most => most.open.forEach(acknowledge)));
  return el("div", { class: "alarm" }, el("strong", { text: "Alarm" }), el("span"), el("small", { class: "since" }),
    button("Acknowledge", acknowledge), el("small", { class: "done", text: "acknowledged" }));
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
