/* The chart: path, track, vehicles, tools. It can be moved, zoomed, turned with the course, and measured on. */
import { colours, fmt, rowOf, sized } from "./drawing.js";
import { currentArrow, fitInto, hull, joint, mapGrid, mapLine, placeAt, placing, zoomAt } from "./map_drawing.js";
import { coast, fence, label, ruler, scaleBar, uncertainty, virtualPoint } from "./chart_parts.js";
import { chartAngle, geojson, rangeAndBearing, toDegrees } from "./geodesy.js";
import { flights, shown } from "./flights.js";
import { paints, repaint } from "./painting.js";
import { cursor } from "./strips.js";

export const view = { x: 0, y: 0, scale: 1, up: 0, fitted: false, moved: false, follow: false, courseUp: false, draft: null };
const canvas = document.getElementById("chart"), said = document.getElementById("pointer");
export const measure = { on: false, from: null, to: null };
let overlay = null, pointer = null, grip = null, fittedTo = "";

const button = name => document.getElementById(name);
const size = () => { const r = canvas.getBoundingClientRect(); return [r.width, r.height]; };
const place = e => placeAt(view, ...size(), e.offsetX, e.offsetY);

/* North, east and heading (rad from north) of a vehicle; null if it has not been heard. */
function pose(v) {
  const p = v.tick && v.tick.pose;
  return p && Number.isFinite(p[0]) ? { north: p[1], east: p[0], heading: Math.PI / 2 - p[3] } : null;
}

function fit(w, h) {
  const norths = [], easts = [];
  const add = (ns, es) => { for (let k = 0; k < ns.length; k++) if (Number.isFinite(ns[k])) { norths.push(ns[k]); easts.push(es[k]); } };
  for (const v of flights.vehicles) {
    if (v.course) { add(v.course.north, v.course.east); for (const [x, y] of v.course.fence || []) add([y], [x]); }
    add(v.track.north, v.track.east);
    const p = pose(v);
    if (p) add([p.north], [p.east]);
  }
  if (view.draft) add(view.draft.north, view.draft.east);
  if (norths.length) fitInto(view, norths, easts, w, h);
}

function orient(w, h) {
  const v = shown(), p = v && pose(v);
  view.up = view.courseUp && p ? p.heading : 0;
  if (!view.fitted || !view.moved && fittedTo !== `${w} ${h}`) { fit(w, h); view.moved = false; fittedTo = `${w} ${h}`; }
  if (view.follow && p) { view.x = p.north; view.y = p.east; }
}

function drawVehicle(g, at, v, main) {
  const c = colours(), p = pose(v), track = v.track;
  if (v.truth.north.length) mapLine(g, at, v.truth.north, v.truth.east, v.truth.north.length, c.green, 1);
  mapLine(g, at, track.north, track.east, track.north.length, c[v.colour], main ? 2.2 : 1.4);
  if (!p) return;
  const here = at(p.north, p.east), tail = track.north.length - 1;
  if (tail >= 0 && Number.isFinite(track.north[tail])) mapLine(g, at, [track.north[tail], p.north], [track.east[tail], p.east], 2, c[v.colour], main ? 2.2 : 1.4);
  uncertainty(g, here, v.tick.covariance, view.scale, view.up, c[v.colour]);
  const point = v.tick.virtual_point;
  if (main && point) virtualPoint(g, at(point[1], point[0]), here);
  hull(g, here, p.heading - view.up, main ? v.table.last("rudder") : NaN, main ? c.orange : c[v.colour]);
  if (flights.vehicles.length > 1) label(g, here[0], here[1] - 8, v.name || v.namespace);
}

function drawCourse(g, at, v, main) {
  const c = colours(), course = v.course;
  if (!course) return;
  g.globalAlpha = main ? 1 : 0.5;
  mapLine(g, at, course.north, course.east, course.north.length, c.path, main ? 7 : 4);
  g.globalAlpha = 1;
  if (!main) return;
  fence(g, at, course.fence);
  const few = course.joints.length <= 12 || view.scale > 2;
  for (const j of course.joints) {
    if (few) joint(g, at(j.y, j.x), j.kind || "", c.muted);
    else { g.fillStyle = c.card; g.strokeStyle = c.muted; g.lineWidth = 1; g.beginPath(); g.arc(...at(j.y, j.x), 2.5, 0, 7); g.fill(); g.stroke(); }
  }
}

function drawAtCursor(g, at, v) {
  if (cursor.at === null || !v.table.n) return;
  const { t, x, y, yaw } = v.table.columns, k = rowOf(t, v.table.n, cursor.at);
  if (Number.isFinite(x[k])) hull(g, at(y[k], x[k]), Math.PI / 2 - yaw[k] - view.up, NaN, colours().muted);
}

function draw() {
  const [g, w, h] = sized(canvas), main = shown();
  if (!w) return;
  orient(w, h);
  const at = placing(view, w, h), others = flights.vehicles.filter(v => v !== main);
  mapGrid(g, view, w, h);
  coast(g, at, overlay, main && main.course && main.course.origin);
  for (const v of others) drawCourse(g, at, v, false);
  if (main) drawCourse(g, at, main, true);
  if (view.draft) { g.setLineDash([8, 6]); mapLine(g, at, view.draft.north, view.draft.east, view.draft.north.length, colours().orange, 2); g.setLineDash([]); }
  for (const v of others) drawVehicle(g, at, v, false);
  if (main) {
    drawVehicle(g, at, main, true); drawAtCursor(g, at, main);
    const current = main.tick && main.tick.current;
    if (current) currentArrow(g, w - 62, 34, current[1], current[0], view.up, true);
  }
  ruler(g, at, measure.from, measure.to || (measure.on && pointer && placeAt(view, w, h, ...pointer)));
  scaleBar(g, w, h, view);
  say(w, h);
}

/* What is under the pointer: metres, degrees, range and bearing from the vehicle. */
function say(w, h) {
  const v = shown(), metres = [], degrees = [];
  if (pointer) {
    const [north, east] = placeAt(view, w, h, ...pointer), p = v && pose(v), origin = v && v.course && v.course.origin;
    metres.push(`N ${fmt(north, 1)}  E ${fmt(east, 1)} m`);
    if (p) {
      const [range, bearing] = rangeAndBearing([p.north, p.east], [north, east]);
      metres.push(`from vehicle ${fmt(range, 1)} m  ${String(Math.round(bearing) % 360).padStart(3, "0")}°`);
    }
    if (origin) {
      const [latitude, longitude] = toDegrees(origin, north, east);
      degrees.push(`${chartAngle(latitude, "N", "S")}  ${chartAngle(longitude, "E", "W")}`,
        `${latitude.toFixed(6)}, ${longitude.toFixed(6)}`);
    }
  }
  const text = pointer ? `${metres.join("  ·  ")}\n${degrees.join("  ·  ")}`
    : "Wheel: zoom, drag: move, double click: all.\nPoint at a place for its position, range and bearing.";
  if (said.textContent !== text) said.textContent = text;
}

function toggle(name, key, after) {
  const b = button(name);
  const flip = () => { key.of[key.name] = !key.of[key.name]; b.setAttribute("aria-pressed", key.of[key.name]); after?.(); repaint(); };
  b.addEventListener("click", flip);
  return flip;
}
const follow = toggle("follow", { of: view, name: "follow" });
const courseUp = toggle("course-up", { of: view, name: "courseUp" });
const measuring = toggle("ruler", { of: measure, name: "on" }, () => { measure.from = measure.to = null; canvas.classList.toggle("measuring", measure.on); });

export function fitAll() { view.fitted = false; if (view.follow) follow(); repaint(); }

/* Show a course before it is sent; null: no more. */
export function showDraft(course) {
  if (!course && !view.draft) return;
  view.draft = course && { north: course.path.map(p => p[1]), east: course.path.map(p => p[0]) };
  fitAll();
}

function zoom(x, y, f) {
  const [w, h] = size();
  view.moved = true;
  zoomAt(view, w, h, ...(view.follow ? [w / 2, h / 2] : [x, y]), Math.max(1e-4 / view.scale, Math.min(1e4 / view.scale, f)));
  repaint();
}

canvas.addEventListener("wheel", e => { e.preventDefault(); zoom(e.offsetX, e.offsetY, Math.exp(-e.deltaY * 0.0012)); }, { passive: false });
canvas.addEventListener("pointerdown", e => { grip = { x: e.offsetX, y: e.offsetY, moved: false }; canvas.setPointerCapture(e.pointerId); });
canvas.addEventListener("pointermove", e => {
  pointer = [e.offsetX, e.offsetY]; repaint();
  if (!grip) return;
  const dx = e.offsetX - grip.x, dy = e.offsetY - grip.y;
  if (!grip.moved && Math.abs(dx) + Math.abs(dy) < 3) return;
  const a = placeAt(view, ...size(), grip.x, grip.y), b = place(e);
  if (view.follow) follow();
  view.moved = true;
  view.x -= b[0] - a[0]; view.y -= b[1] - a[1];
  grip = { x: e.offsetX, y: e.offsetY, moved: true };
});
canvas.addEventListener("pointerup", e => {
  if (grip && !grip.moved && measure.on) {
    if (!measure.from || measure.to) { measure.from = place(e); measure.to = null; } else measure.to = place(e);
  }
  grip = null; repaint();
});
canvas.addEventListener("pointercancel", () => { grip = null; });
canvas.addEventListener("pointerleave", () => { pointer = null; repaint(); });
canvas.addEventListener("dblclick", () => { if (!measure.on) fitAll(); });
const STEP = 60, move = (right, up) => { view.moved = true; const [w, h] = size(), [n, e] = placeAt(view, w, h, w / 2 + right * STEP, h / 2 - up * STEP); view.x = n; view.y = e; repaint(); };
const KEYS = {
  ArrowLeft: () => move(-1, 0), ArrowRight: () => move(1, 0), ArrowUp: () => move(0, 1), ArrowDown: () => move(0, -1),
  "+": () => zoom(size()[0] / 2, size()[1] / 2, 1.25), "=": () => KEYS["+"](), "-": () => zoom(size()[0] / 2, size()[1] / 2, 0.8),
};
canvas.addEventListener("keydown", e => { if (KEYS[e.key]) { e.preventDefault(); KEYS[e.key](); } });
button("fit").addEventListener("click", fitAll);

/* Keys of the whole page. */
export const chartKeys = { f: follow, c: courseUp, r: measuring, a: fitAll, Escape: () => { if (measure.on) measuring(); } };

button("overlay").addEventListener("change", async e => {
  const file = e.target.files[0], words = button("overlay-words");
  if (!file) return;
  try {
    overlay = geojson(await file.text());
    const origin = shown() && shown().course && shown().course.origin;
    words.textContent = origin ? `${file.name}: ${overlay.lines.length} lines, ${overlay.points.length} points`
      : `${file.name}: not drawn, the mission has no origin to place degrees`;
  } catch (error) { overlay = null; words.textContent = `${file.name}: ${error.message}`; }
  e.target.value = ""; repaint();
});
paints(draw);
