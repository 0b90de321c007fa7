/* Degrees and metres: the plane that touches the WGS 84 ellipsoid at the origin. Points lie on the ellipsoid. */

const A = 6378137.0, F = 1 / 298.257223563, E2 = F * (2 - F), RAD = Math.PI / 180;

function ecef(latitude, longitude, height) {
  const s = Math.sin(latitude * RAD), c = Math.cos(latitude * RAD), n = A / Math.sqrt(1 - E2 * s * s);
  const l = longitude * RAD;
  return [(n + height) * c * Math.cos(l), (n + height) * c * Math.sin(l), (n * (1 - E2) + height) * s];
}

/* Latitude and longitude, degrees, and height, m, of a point, by Bowring's formula. */
function geodetic([x, y, z]) {
  const p = Math.hypot(x, y), b = A * (1 - F), t = Math.atan2(z * A, p * b);
  const latitude = Math.atan2(z + E2 / (1 - E2) * b * Math.sin(t) ** 3, p - E2 * A * Math.cos(t) ** 3);
  const s = Math.sin(latitude), n = A / Math.sqrt(1 - E2 * s * s);
  return [latitude / RAD, Math.atan2(y, x) / RAD, p * Math.cos(latitude) + z * s - A * A / n];
}

/* The rows of the rotation from the earth's axes to east, north and up. */
function plane(origin) {
  const s = Math.sin(origin.latitude * RAD), c = Math.cos(origin.latitude * RAD);
  const t = Math.sin(origin.longitude * RAD), d = Math.cos(origin.longitude * RAD);
  return [[-t, d, 0], [-s * d, -s * t, c], [c * d, c * t, s]];
}

/* [latitude, longitude], degrees, of a place north and east of the origin, m. */
export function toDegrees(origin, north, east) {
  const [e, n, u] = plane(origin), at = ecef(origin.latitude, origin.longitude, 0);
  let up = 0, found = null;
  for (let k = 0; k < 3; k++) {
    found = geodetic(at.map((v, i) => v + east * e[i] + north * n[i] + up * u[i]));
    up -= found[2];
  }
  return found.slice(0, 2);
}

/* [north, east], m, of a place in degrees. */
export function toMetres(origin, latitude, longitude) {
  const [e, n] = plane(origin), from = ecef(origin.latitude, origin.longitude, 0);
  const d = ecef(latitude, longitude, 0).map((v, k) => v - from[k]), dot = r => r.reduce((m, v, k) => m + v * d[k], 0);
  return [dot(n), dot(e)];
}

/* Range, m, and bearing, degrees from north, from one [north, east] to another. */
export function rangeAndBearing(a, b) {
  const north = b[0] - a[0], east = b[1] - a[1];
  return [Math.hypot(north, east), (Math.atan2(east, north) / RAD + 360) % 360];
}

/* Degrees and decimal minutes, as on a chart: 63° 26.820' N. */
export function chartAngle(degrees, positive, negative) {
  const size = Math.abs(degrees), whole = Math.floor(size + 1e-9 / 6), minutes = Math.max(0, (size - whole) * 60);
  return `${whole}° ${minutes.toFixed(3).padStart(6, "0")}' ${degrees < 0 ? negative : positive}`;
}

/* The half axes, m, and the bearing of the longer one, rad, within which 95 % lie: covariance in ENU, m². */
export function ellipse([xx, xy, yy]) {
  const middle = (xx + yy) / 2, spread = Math.hypot((xx - yy) / 2, xy), K = 5.991464547;
  if (!(middle - spread >= -1e-9 * middle)) return null;
  const axis = 0.5 * Math.atan2(2 * xy, xx - yy);
  return [Math.sqrt(K * (middle + spread)), Math.sqrt(K * Math.max(0, middle - spread)), Math.PI / 2 - axis];
}

/* Lines, rings and points of a GeoJSON text, as lists of [longitude, latitude]; an Error names what is wrong. */
export function geojson(text) {
  const lines = [], points = [], MOST = 200000;
  let count = 0;
  const place = p => {
    if (!Array.isArray(p) || !(Math.abs(p[0]) <= 180) || !(Math.abs(p[1]) <= 90)) {
      throw new Error(`found ${JSON.stringify(p)}, expected [longitude, latitude] in degrees`);
    }
    if (++count > MOST) throw new Error(`found more than ${MOST} points`);
    return [p[0], p[1]];
  };
  const kinds = {
    Point: c => points.push(place(c)), MultiPoint: c => c.forEach(kinds_of("Point")),
    LineString: c => lines.push(c.map(place)), MultiLineString: c => c.forEach(kinds_of("LineString")),
    Polygon: c => c.forEach(kinds_of("LineString")), MultiPolygon: c => c.forEach(kinds_of("Polygon")),
  };
  function kinds_of(kind) { return c => kinds[kind](c); }
  const read = o => {
    if (o && o.type === "FeatureCollection") o.features.forEach(read);
    else if (o && o.type === "Feature") { if (o.geometry) read(o.geometry); }
    else if (o && o.type === "GeometryCollection") o.geometries.forEach(read);
    else if (o && kinds[o.type]) kinds[o.type](o.coordinates);
    else throw new Error(`found type ${JSON.stringify(o && o.type)}, expected a GeoJSON geometry`);
  };
  read(JSON.parse(text));
  return { lines, points };
}
