/* Drawing that the console and the report share: colours, numbers, axes and lines over time. */

export const FONT = "11px system-ui, 'DejaVu Sans', sans-serif";
/* Margins of a panel, px. */
export const LEFT = 58, RIGHT = 10;
const NAMES = ["bg", "card", "ink", "muted", "grid", "line", "area", "path", "blue", "orange", "green", "red",
  "violet", "brown", "cursor"];
let shades = null;

/* The colours of colours.css as the page is lit now: name -> colour. */
export function colours() {
  if (shades) return shades;
  const style = getComputedStyle(document.documentElement), scheme = style.colorScheme;
  const one = scheme === "dark" || scheme === "light";
  const night = one ? scheme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  const found = {};
  for (const name of NAMES) {
    const text = style.getPropertyValue("--" + name), pair = text.match(/light-dark\(\s*([^,]+),\s*([^)]+)\)/);
    found[name] = (pair ? pair[night ? 2 : 1] : text).trim();
  }
  return shades = found;
}

/* Read the colours again at the next drawing. */
export function forgetColours() { shades = null; }

/* Fit a canvas to its place and the screen, clear it; return its context, width and height, CSS px. */
export function sized(canvas) {
  const r = canvas.getBoundingClientRect(), s = globalThis.devicePixelRatio || 1;
  const w = Math.round(r.width * s), h = Math.round(r.height * s);
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const g = canvas.getContext("2d");
  g.setTransform(s, 0, 0, s, 0, 0);
  g.clearRect(0, 0, r.width, r.height);
  return [g, r.width, r.height];
}

/* A number with d decimals, without a negative zero; a dash where it is not known. */
export const fmt = (v, d = 2) => Number.isFinite(v) ? v.toFixed(d).replace(/^-(0\.?0*)$/, "$1") : "–";

/* Round values between low and high, about `count` of them, and the decimals that they need. */
export function ticks(low, high, count) {
  const raw = (high - low) / count, p = 10 ** Math.floor(Math.log10(raw)), out = [];
  const step = [1, 2, 5, 10].map(k => k * p).find(k => k >= raw) || p;
  for (let v = Math.ceil(low / step) * step; v <= high + step * 1e-9; v += step) {
    out.push(Math.abs(v) < step * 1e-9 ? 0 : v);
  }
  return [out, Math.max(0, -Math.floor(Math.log10(step) + 1e-9))];
}

/* The last row, of the first n, whose value is not above `value`; the values ascend. */
export function rowOf(values, n, value) {
  let a = 0, b = n - 1;
  while (a < b) { const m = (a + b + 1) >> 1; if (values[m] <= value) a = m; else b = m - 1; }
  return a;
}

/* Smallest and largest of the rows a to b of each list, of `marks`, and of those `limits` that are near. */
export function extent(lists, a, b, marks = [], limits = []) {
  let low = Infinity, high = -Infinity;
  for (const v of lists) {
    for (let k = a; k <= b; k++) { if (v[k] < low) low = v[k]; if (v[k] > high) high = v[k]; }
  }
  for (const v of marks) { low = Math.min(low, v); high = Math.max(high, v); }
  for (const v of limits) {
    if (Math.max(high, -low) > 0.6 * Math.abs(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  }
  return low <= high ? [low, high] : [-1, 1];
}

/* A range with room above and below, at least `least` high. */
export function roomy([low, high], least) {
  const lack = Math.max(0, least - (high - low)) / 2, pad = 0.07 * Math.max(high - low, least);
  return [low - lack - pad, high + lack + pad];
}

/* From a value on the axis across, view[0] to view[1], to px, and back. */
export const across = (view, w) => v => LEFT + (v - view[0]) / (view[1] - view[0]) * (w - LEFT - RIGHT);
export const back = (view, w) => x => view[0] + (x - LEFT) / (w - LEFT - RIGHT) * (view[1] - view[0]);

/* Draw the axis of values with its grid; return the function from a value to px. */
export function valueAxis(g, w, h, [low, high], bottom, down, count = 4) {
  const c = colours(), Y = v => 6 + (down ? v - low : high - v) / (high - low) * (h - 12 - bottom);
  const [ys, digits] = ticks(low, high, count);
  g.font = FONT; g.lineWidth = 1; g.strokeStyle = c.grid; g.fillStyle = c.muted;
  g.textAlign = "right"; g.textBaseline = "middle";
  for (const v of ys) {
    g.beginPath(); g.moveTo(LEFT, Y(v)); g.lineTo(w - RIGHT, Y(v)); g.stroke();
    g.fillText(v.toFixed(digits), LEFT - 7, Y(v));
  }
  return Y;
}

/* Draw the axis across with its grid, its labels where the panel has a bottom, and dashed marks. */
export function timeAxis(g, w, h, view, bottom, unit, marks, count = 9) {
  const c = colours(), X = across(view, w), [xs, digits] = ticks(view[0], view[1], count);
  const upright = v => { g.beginPath(); g.moveTo(X(v), 4); g.lineTo(X(v), h - bottom - 4); g.stroke(); };
  g.strokeStyle = c.grid; g.fillStyle = c.muted; g.textAlign = "center"; g.textBaseline = "top";
  for (const v of xs) {
    upright(v);
    if (bottom) g.fillText(v.toFixed(digits) + unit, Math.min(w - 22, X(v)), h - bottom + 2);
  }
  g.strokeStyle = c.line; g.setLineDash([2, 3]);
  for (const v of marks) if (v > view[0] && v < view[1]) upright(v);
  g.setLineDash([]);
}

/* Draw dashed lines across at these values. */
export function levels(g, w, Y, values, colour) {
  g.strokeStyle = colour; g.setLineDash([5, 4]);
  for (const v of values) { g.beginPath(); g.moveTo(LEFT, Y(v)); g.lineTo(w, Y(v)); g.stroke(); }
  g.setLineDash([]);
}

/* Draw rows a to b of `v` over `axis`; more than three a pixel as their range. An angle may wrap at 180. */
export function seriesLine(g, w, X, Y, axis, v, a, b, colour, width, wraps) {
  const dense = (b - a) > 3 * (w - LEFT);
  let pen = false, last = NaN, before = NaN, column = null, low = 0, high = 0, at = 0;
  const flush = () => { if (column !== null) { g.moveTo(at, Y(low)); g.lineTo(at, Y(high)); } };
  g.strokeStyle = colour; g.lineWidth = width; g.lineJoin = "round"; g.beginPath();
  for (let k = a; k <= b; k++) {
    const y = v[k];
    if (!Number.isFinite(y)) { pen = false; continue; }
    if (wraps && Math.abs(y - last) > 180) { if (dense) { flush(); column = null; } pen = false; }
    before = last; last = y;
    const x = X(axis[k]);
    if (!dense) { if (pen) g.lineTo(x, Y(y)); else g.moveTo(x, Y(y)); pen = true; continue; }
    const place = Math.round(x);
    if (place !== column) {
      flush();
      if (pen && column !== null) { g.moveTo(at, Y(before)); g.lineTo(x, Y(y)); }
      column = place; low = high = y; at = x;
    } else { low = Math.min(low, y); high = Math.max(high, y); }
    pen = true;
  }
  if (dense) flush();
  g.stroke();
}

/* Draw the range that is being chosen, px, and the cursor, if it is in sight. */
export function overlay(g, w, h, bottom, X, chosen, cursor, view) {
  const c = colours();
  if (chosen) {
    const [a, b] = chosen.map(X);
    g.fillStyle = c.blue; g.globalAlpha = 0.15;
    g.fillRect(Math.min(a, b), 4, Math.abs(b - a), h - bottom - 8); g.globalAlpha = 1;
  }
  if (cursor === null || !(cursor >= view[0] && cursor <= view[1])) return;
  g.strokeStyle = c.cursor; g.lineWidth = 1;
  g.beginPath(); g.moveTo(X(cursor), 2); g.lineTo(X(cursor), h - bottom - 2); g.stroke();
}
