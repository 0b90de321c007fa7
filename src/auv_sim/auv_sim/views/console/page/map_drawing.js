/* Drawing on a map that the console and the report share. North and east in m, angles in rad from north. */
import { FONT, colours, ticks } from "./drawing.js";

/* From a place to px. The view: centre x (north) and y (east), m; scale, px/m; up, the bearing that is up. */
export function placing(view, w, h) {
  const c = Math.cos(view.up || 0), s = Math.sin(view.up || 0);
  return (north, east) => {
    const n = north - view.x, e = east - view.y;
    return [w / 2 + (e * c - n * s) * view.scale, h / 2 - (n * c + e * s) * view.scale];
  };
}

/* From px to a place: [north, east]. */
export function placeAt(view, w, h, x, y) {
  const c = Math.cos(view.up || 0), s = Math.sin(view.up || 0);
  const right = (x - w / 2) / view.scale, ahead = (h / 2 - y) / view.scale;
  return [view.x + ahead * c - right * s, view.y + right * c + ahead * s];
}

/* Move the view so that these lists of places fill it. */
export function fitInto(view, norths, easts, w, h) {
  const span = v => v.reduce((m, u) => [Math.min(m[0], u), Math.max(m[1], u)], [Infinity, -Infinity]);
  const a = span(norths), b = span(easts);
  view.scale = Math.min((w - 60) / Math.max(b[1] - b[0], 1), (h - 60) / Math.max(a[1] - a[0], 1));
  view.x = (a[0] + a[1]) / 2; view.y = (b[0] + b[1]) / 2; view.fitted = true;
}

/* Zoom by f about a point, px. */
export function zoomAt(view, w, h, x, y, f) {
  const [north, east] = placeAt(view, w, h, x, y);
  view.x += (north - view.x) * (1 - 1 / f); view.y += (east - view.y) * (1 - 1 / f); view.scale *= f;
}

/* The grid with its figures; a turned map has no figures at its edges. */
export function mapGrid(g, view, w, h) {
  const c = colours(), at = placing(view, w, h), turned = Boolean(view.up);
  const far = turned ? Math.hypot(w, h) / 2 / view.scale : 0;
  const half = far || w / 2 / view.scale, tall = far || h / 2 / view.scale, step = Math.max(half, tall) / 3.5;
  const [es, ed] = ticks(view.y - half, view.y + half, 2 * half / step);
  const [ns, nd] = ticks(view.x - tall, view.x + tall, 2 * tall / step);
  const rule = (p, q) => { g.beginPath(); g.moveTo(...p); g.lineTo(...q); g.stroke(); };
  g.font = FONT; g.strokeStyle = c.grid; g.fillStyle = c.muted; g.lineWidth = 1;
  for (const v of es) rule(at(view.x + tall, v), at(view.x - tall, v));
  for (const v of ns) rule(at(v, view.y - half), at(v, view.y + half));
  if (turned) return;
  g.textAlign = "center"; g.textBaseline = "bottom";
  for (const v of es) g.fillText(v.toFixed(ed), at(0, v)[0], h - 2);
  g.textAlign = "left"; g.textBaseline = "middle";
  /* The name of the axis stands in the corner. */
  for (const v of ns) if (at(v, 0)[1] > 28) g.fillText(v.toFixed(nd), 3, at(v, 0)[1] - 7);
  g.textBaseline = "bottom"; g.textAlign = "right"; g.fillText("east y (m)", w - 4, h - 16);
  g.textAlign = "left"; g.textBaseline = "top"; g.fillText("north x (m)", 4, 4);
}

/* A line through the first n places, with gaps where one is not known. */
export function mapLine(g, at, norths, easts, n, colour, width) {
  let pen = false;
  g.strokeStyle = colour; g.lineWidth = width; g.lineJoin = g.lineCap = "round"; g.beginPath();
  for (let k = 0; k < n; k++) {
    if (!Number.isFinite(norths[k])) { pen = false; continue; }
    const [x, y] = at(norths[k], easts[k]);
    if (pen) g.lineTo(x, y); else g.moveTo(x, y);
    pen = true;
  }
  g.stroke();
}

/* A joint with its words. */
export function joint(g, [x, y], text, colour) {
  const c = colours();
  g.font = FONT; g.fillStyle = c.card; g.strokeStyle = c.ink; g.lineWidth = 1.3;
  g.beginPath(); g.arc(x, y, 4, 0, 7); g.fill(); g.stroke();
  g.fillStyle = colour; g.textAlign = "left"; g.textBaseline = "bottom"; g.fillText(text, x + 7, y - 5);
}

/* The arrow of the current (m/s) with its speed, about (x, y); `up` is the bearing that is up. A halo keeps it
   legible on a path. */
export function currentArrow(g, x, y, north, east, up = 0, halo = false) {
  const speed = Math.hypot(north, east), c = colours();
  if (!(speed > 5e-3)) return;
  g.save(); g.translate(x, y); g.font = FONT; g.fillStyle = g.strokeStyle = c.green;
  g.textAlign = "center"; g.textBaseline = "top";
  const text = `current ${speed.toFixed(2)} m/s`, turn = Math.atan2(east, north) - up;
  if (halo) {
    g.strokeStyle = c.card; g.globalAlpha = 0.5; g.lineWidth = 3; g.lineJoin = "round"; g.strokeText(text, 0, 30);
    g.save(); g.rotate(turn); g.lineWidth = 5; g.beginPath(); g.moveTo(0, 25); g.lineTo(0, -22); g.stroke(); g.restore();
    g.strokeStyle = c.green; g.globalAlpha = 1;
  }
  g.fillText(text, 0, 30); g.rotate(turn); g.lineWidth = 2.5;
  g.beginPath(); g.moveTo(0, 24); g.lineTo(0, -16); g.stroke();
  g.beginPath(); g.moveTo(0, -26); g.lineTo(7, -11); g.lineTo(-7, -11); g.fill();
  g.restore();
}

/* The vehicle at px (x, y), bow at `turn` clockwise from the top, its rudder (positive to port) if known. */
export function hull(g, [x, y], turn, rudder, colour) {
  const c = colours();
  g.save(); g.translate(x, y); g.rotate(turn); g.fillStyle = colour; g.strokeStyle = c.card; g.lineWidth = 1.5;
  g.beginPath(); g.moveTo(0, -13); g.quadraticCurveTo(7, -4, 5, 10); g.lineTo(-5, 10);
  g.quadraticCurveTo(-7, -4, 0, -13); g.fill(); g.stroke();
  if (Number.isFinite(rudder)) {
    g.translate(0, 10); g.rotate(rudder); g.strokeStyle = c.red; g.lineWidth = 2.5;
    g.beginPath(); g.moveTo(0, 0); g.lineTo(0, 9); g.stroke();
  }
  g.restore();
}
