"use strict";
/* Geometry of the view in three dimensions: no document, so that it can be run alone. */

/* A place (m: north, east, depth) as the view shows it: [to the right, up, away from the viewer].
   view: heading, the direction of sight (rad, clockwise from north); tilt, from above (rad, 90 degrees is a
   map); stretch, how much larger depths are drawn than horizontal distances. The projection is parallel. */
function project(view, north, east, depth) {
  const c = Math.cos(view.heading), s = Math.sin(view.heading), ct = Math.cos(view.tilt), st = Math.sin(view.tilt);
  const ahead = north * c + east * s, up = -depth * view.stretch;
  return [east * c - north * s, ahead * st + up * ct, ahead * ct - up * st];
}

/* The stretch of depths, of 1, 2, 5, 10, 20, with which they take about a third of the horizontal extent. */
function stretchFor(extent, depths) {
  const wanted = 0.35 * extent / Math.max(depths, 1e-9);
  return [20, 10, 5, 2].find(k => k <= wanted) || 1;
}

/* The range of colours for values: 0 (or symmetric, where signed) to what all but 2 % of them are within. */
function colourRange(values, signed) {
  const sizes = Array.from(values).filter(Number.isFinite).map(Math.abs).sort((a, b) => a - b);
  if (!sizes.length) return null;
  const high = Math.max(sizes[Math.floor(0.98 * (sizes.length - 1))], 1e-6);
  return { low: signed ? -high : 0, high, largest: sizes[sizes.length - 1] };
}

/* The number of the colour, from 0 to count - 1, of a value in a range; -1 for a value that is not known. */
function colourOf(value, range, count) {
  if (!Number.isFinite(value)) return -1;
  const share = (value - range.low) / (range.high - range.low);
  return Math.max(0, Math.min(count - 1, Math.floor(share * count)));
}
