/* The parts of the console's chart. `at` turns north and east, m, into px. */
import { FONT, colours } from "./drawing.js";
import { mapLine } from "./map_drawing.js";
import { ellipse, rangeAndBearing, toMetres } from "./geodesy.js";

/* The area that a mission must not leave: dashed red, hatched outside would hide the chart. */
export function fence(g, at, corners) {
  if (!corners || corners.length < 3) return;
  g.strokeStyle = colours().red; g.lineWidth = 1.3; g.setLineDash([7, 5]); g.beginPath();
  corners.forEach(([x, y], k) => { const p = at(y, x); if (k) g.lineTo(...p); else g.moveTo(...p); });
  g.closePath(); g.stroke(); g.setLineDash([]);
}

/* Where the position is with 95 %: an ellipse about the vehicle. */
export function uncertainty(g, [x, y], covariance, scale, up, colour) {
  const found = covariance && ellipse(covariance);
  if (!found || !(found[0] * scale > 3)) return;
  const [long, short, bearing] = found;
  g.save(); g.translate(x, y); g.rotate(bearing - up - Math.PI / 2);
  g.beginPath(); g.ellipse(0, 0, long * scale, Math.max(short * scale, 0.5), 0, 0, 7);
  g.fillStyle = g.strokeStyle = colour; g.globalAlpha = 0.12; g.fill(); g.globalAlpha = 0.7; g.lineWidth = 1; g.stroke();
  g.restore();
}

/* The virtual point, with a thin line to the vehicle. */
export function virtualPoint(g, p, vehicle) {
  const c = colours();
  g.strokeStyle = c.muted; g.lineWidth = 1; g.setLineDash([3, 3]);
  g.beginPath(); g.moveTo(...vehicle); g.lineTo(...p); g.stroke(); g.setLineDash([]);
  g.strokeStyle = c.green; g.lineWidth = 2;
  g.beginPath(); g.arc(...p, 5, 0, 7); g.moveTo(p[0] - 8, p[1]); g.lineTo(p[0] + 8, p[1]);
  g.moveTo(p[0], p[1] - 8); g.lineTo(p[0], p[1] + 8); g.stroke();
}

/* A file of coast or hazards, in degrees: it needs the origin. */
export function coast(g, at, overlay, origin) {
  if (!overlay || !origin) return;
  if (overlay.origin !== origin) place(overlay, origin);
  for (const line of overlay.placed) mapLine(g, at, line.norths, line.easts, line.norths.length, colours().brown, 1.6);
  g.fillStyle = colours().brown;
  for (const [north, east] of overlay.spots) { g.beginPath(); g.arc(...at(north, east), 3.5, 0, 7); g.fill(); }
}

function place(overlay, origin) {
  const metres = p => toMetres(origin, p[1], p[0]);
  overlay.origin = origin; overlay.spots = overlay.points.map(metres);
  overlay.placed = overlay.lines.map(line => {
    const places = line.map(metres);
    return { norths: places.map(p => p[0]), easts: places.map(p => p[1]) };
  });
}

/* The ruler: from one place to another, with range and bearing. */
export function ruler(g, at, from, to) {
  if (!from || !to) return;
  const c = colours(), a = at(...from), b = at(...to), [range, bearing] = rangeAndBearing(from, to);
  g.strokeStyle = c.ink; g.lineWidth = 1.4; g.beginPath(); g.moveTo(...a); g.lineTo(...b); g.stroke();
  for (const [x, y] of [a, b]) { g.fillStyle = c.card; g.beginPath(); g.arc(x, y, 3.5, 0, 7); g.fill(); g.stroke(); }
  label(g, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, `${range.toFixed(1)} m  ${bearing.toFixed(1).padStart(5, "0")}°`);
}

/* Words on a card of their own, so that they stay legible over lines. */
export function label(g, x, y, text) {
  const c = colours();
  g.font = "12px system-ui, 'DejaVu Sans', sans-serif";
  const w = g.measureText(text).width + 12;
  g.fillStyle = c.card; g.globalAlpha = 0.9; g.beginPath(); g.roundRect(x - w / 2, y - 25, w, 19, 4); g.fill(); g.globalAlpha = 1;
  g.fillStyle = c.ink; g.textAlign = "center"; g.textBaseline = "middle"; g.fillText(text, x, y - 15);
}

/* A bar of a round length and, where the map is turned, an arrow to the north. */
export function scaleBar(g, w, h, view) {
  const c = colours(), p = 10 ** Math.floor(Math.log10(120 / view.scale));
  const metres = [5, 2, 1].map(k => k * p).find(v => v * view.scale <= 120), x = w - 14, y = h - 38, long = metres * view.scale;
  g.strokeStyle = g.fillStyle = c.ink; g.lineWidth = 1.5; g.font = FONT;
  g.beginPath(); g.moveTo(x - long, y - 5); g.lineTo(x - long, y); g.lineTo(x, y); g.lineTo(x, y - 5); g.stroke();
  g.textAlign = "center"; g.textBaseline = "bottom";
  g.fillText(metres >= 1000 ? `${metres / 1000} km` : `${Number(metres.toPrecision(3))} m`, x - long / 2, y - 3);
  if (!view.up) return;
  g.save(); g.translate(26, 34); g.rotate(-view.up); g.beginPath(); g.moveTo(0, -18); g.lineTo(6, 4); g.lineTo(0, 0);
  g.lineTo(-6, 4); g.fill(); g.rotate(view.up); g.textBaseline = "top"; g.fillText("N", 0, 10); g.restore();
}
