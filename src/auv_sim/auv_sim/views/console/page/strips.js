/* The strips: signals over one time axis with one cursor. */
import { across, back, colours, extent, fmt, levels, overlay, roomy, rowOf, seriesLine, sized, timeAxis, valueAxis, LEFT, RIGHT } from "./drawing.js";
import { shown } from "./flights.js";
import { paints, repaint } from "./painting.js";

/* The time that is pointed at, s on the axis; null: now. */
export const cursor = { at: null };
/* The last `span` seconds, or the range that was chosen. */
export const range = { span: Infinity, chosen: null };
const one = (name, label, colour, width = 1.5, wraps = false) => ({ name, label, colour, width, wraps });
const STRIPS = [
  { title: "Depth", unit: "m", least: 1, digits: 2, down: true, if: ["depth"], series: [
    one("depth_ref", "requested", "path", 4), one("bottom", "bottom", "brown"), one("depth", "depth", "blue")] },
  { title: "Cross-track ye", unit: "m", least: 0.5, digits: 2, marks: [0], if: ["ye"], series: [one("ye", "starboard +", "blue")] },
  { title: "Vertical ze", unit: "m", least: 0.5, digits: 2, marks: [0], down: true, if: ["ze"], series: [one("ze", "below +", "blue")] },
  { title: "Along-track xe", unit: "m", least: 0.5, digits: 2, marks: [0], if: ["xe"], series: [one("xe", "ahead +", "blue")] },
  { title: "Heading", unit: "°", least: 5, digits: 1, if: ["heading"], series: [
    one("heading_ref", "reference", "path", 4, true), one("heading", "heading", "blue", 1.5, true)] },
  { title: "Speed", unit: "m/s", least: 0.2, digits: 2, if: ["u", "over_ground"], series: [
    one("over_ground", "over ground", "orange"), one("u", "through water", "blue")] },
  { title: "Rudder", unit: "°", least: 2, digits: 1, marks: [0], if: ["rudder_deg"], series: [one("rudder_deg", "port +", "blue")] },
  { title: "Planes", unit: "°", least: 2, digits: 1, marks: [0], if: ["planes_deg"], series: [one("planes_deg", "bow down +", "blue")] },
  { title: "Thrust", unit: "N", least: 1, digits: 1, marks: [0], if: ["thrust"], series: [one("thrust", "thrust", "blue")] },
  { title: "Current", unit: "m/s", least: 0.1, digits: 2, marks: [0], if: ["current_north"], series: [
    one("current_north", "north", "blue"), one("current_east", "east", "orange")] },
];
const place = document.getElementById("strips"), AXIS = 20;
let drag = null;

function make(strip) {
  const box = document.createElement("div"), head = document.createElement("div"), canvas = document.createElement("canvas");
  box.className = "strip"; head.className = "head"; box.hidden = true;
  const title = document.createElement("strong");
  title.textContent = `${strip.title} (${strip.unit})`;
  head.append(title);
  strip.values = strip.series.map(s => {
    const key = document.createElement("span"), dash = document.createElement("i"), value = document.createElement("b");
    key.className = "key"; dash.style.background = `var(--${s.colour})`;
    key.append(dash, `${s.label} `, value); head.append(key);
    return { key, value };
  });
  canvas.setAttribute("role", "img"); canvas.setAttribute("aria-label", `${strip.title} over time`);
  box.append(head, canvas); place.append(box);
  Object.assign(strip, { box, canvas });
  canvas.addEventListener("pointermove", e => point(e, canvas));
  canvas.addEventListener("pointerdown", e => { drag = [timeAt(e, canvas), null]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", () => { drag = null; });
  canvas.addEventListener("pointerleave", () => { cursor.at = null; repaint(); });
  canvas.addEventListener("dblclick", () => choose(null));
}

/* The range of time in sight. */
export function seen() {
  const v = shown(), last = v && v.table.n ? Math.max(v.table.last("t"), v.tick ? v.tick.now - v.start : 0) : 1;
  if (range.chosen) return range.chosen;
  return [Number.isFinite(range.span) ? last - range.span : 0, Math.max(last, 1)];
}

const timeAt = (e, canvas) => back(seen(), canvas.getBoundingClientRect().width)(e.offsetX);

function point(e, canvas) {
  const [low, high] = seen(), t = Math.min(high, Math.max(low, timeAt(e, canvas)));
  cursor.at = t;
  if (drag) drag[1] = t;
  repaint();
}

function release() {
  if (drag && drag[1] !== null) {
    const [a, b] = drag.sort((u, v) => u - v), [low, high] = seen();
    if (b - a > (high - low) * 0.01) choose([Math.max(0, a), b]);
  }
  drag = null; repaint();
}

function choose(chosen) { range.chosen = chosen; mark(); repaint(); }

const buttons = [...document.querySelectorAll("#spans button")];
function mark() { for (const b of buttons) b.setAttribute("aria-pressed", !range.chosen && Number(b.dataset.span || Infinity) === range.span); }
for (const b of buttons) b.addEventListener("click", () => { range.span = Number(b.dataset.span || Infinity); choose(null); });

function drawStrip(strip, v, last) {
  const { canvas } = strip, bottom = last ? AXIS : 0, table = v.table, C = table.columns, n = table.n, view = seen();
  const [g, w, h] = sized(canvas);
  if (!w) return;
  const X = across(view, w), a = Math.max(0, rowOf(C.t, n, view[0]) - 1), b = Math.min(n - 1, rowOf(C.t, n, view[1]) + 1);
  const there = strip.series.filter(s => table.seen.has(s.name)), c = colours();
  const bounds = roomy(extent(there.map(s => C[s.name]), a, b, strip.marks), strip.least);
  const Y = valueAxis(g, w, h, bounds, bottom, strip.down, Math.max(3, Math.round((h - bottom) / 20)));
  timeAxis(g, w, h, view, bottom, " s", [], w < 420 ? 5 : 8);
  g.save(); g.beginPath(); g.rect(LEFT, 2, w - LEFT - RIGHT, h - bottom - 4); g.clip();
  levels(g, w, Y, strip.marks || [], c.line);
  for (const s of there) seriesLine(g, w, X, Y, C.t, C[s.name], a, b, c[s.colour], s.width, s.wraps);
  g.restore();
  overlay(g, w, h, bottom, X, drag && drag[1] !== null ? drag : null, cursor.at, view);
  const k = cursor.at === null ? n - 1 : rowOf(C.t, n, cursor.at);
  strip.series.forEach((s, i) => {
    const { key, value } = strip.values[i], text = fmt(C[s.name] ? C[s.name][k] : NaN, strip.digits);
    key.hidden = !table.seen.has(s.name);
    if (value.textContent !== text) value.textContent = text;
  });
}

function draw() {
  const v = shown(), there = v && v.table.n ? STRIPS.filter(s => s.if.some(name => v.table.seen.has(name))) : [];
  for (const s of STRIPS) {
    s.box.hidden = !there.includes(s);
    s.box.classList.toggle("last", s === there[there.length - 1]);
  }
  document.getElementById("no-strips").hidden = there.length > 0;
  const clock = document.getElementById("cursor-time"), text = cursor.at === null ? "now" : `at ${fmt(cursor.at, 1)} s`;
  if (clock.textContent !== text) clock.textContent = text;
  for (const s of there) drawStrip(s, v, s === there[there.length - 1]);
}

STRIPS.forEach(make);
mark();
paints(draw);
