/* Paint at most ten times a second, only when something has changed, never while the page is hidden. */

/* How often the page was painted, the least time between two paints, ms, and whether a change is not painted yet. */
export const painting = { count: 0, least: 100, stale: false };
const parts = [];
let last = -Infinity, asked = false;

/* Add a function that paints a part of the page. */
export function paints(part) { parts.push(part); }

/* Paint all parts soon. */
export function repaint() {
  painting.stale = true;
  if (asked || document.hidden) return;
  asked = true;
  setTimeout(() => requestAnimationFrame(paint), Math.max(0, last + painting.least - performance.now()));
}

function paint() {
  asked = false;
  if (document.hidden || !painting.stale) return;
  painting.stale = false; last = performance.now(); painting.count++;
  for (const part of parts) part();
}

document.addEventListener("visibilitychange", () => { if (!document.hidden) repaint(); });
