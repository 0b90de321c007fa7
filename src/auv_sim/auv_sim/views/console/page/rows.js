/* The rows of a flight in the page's memory: columns that grow and thin, and the track for drawing. No document. */

const DEG = 180 / Math.PI;
/* An angle on the wire (rad, 0 at east, counter-clockwise) as a heading, degrees from north, 0 to 360. */
export const heading = yaw => ((90 - yaw * DEG) % 360 + 360) % 360;

/* What the page draws beside the columns that arrive: name -> (columns it needs, their function). */
const DERIVED = {
  heading: [["yaw"], heading],
  heading_ref: [["yaw_ref"], heading],
  depth: [["z"], z => -z],
  bottom: [["z", "altitude"], (z, altitude) => altitude - z],
  over_ground: [["ve", "vn"], Math.hypot],
  rudder_deg: [["rudder"], v => v * DEG],
  planes_deg: [["planes"], v => v * DEG],
};

/* Columns of float32 that grow by doubling. Above `most` rows the older half keeps every second one: the server thins the
   whole table, but here the strips of the last minutes are in sight, and they would change before the reader's eyes. */
export class Table {
  constructor(names, most = 200000) {
    this.names = names; this.most = most; this.size = 1024;
    this.derived = Object.entries(DERIVED).filter(([, [needs]]) => needs.every(name => names.includes(name)));
    this.clear();
  }

  clear() {
    this.n = 0; this.columns = {}; this.seen = new Set();
    for (const name of [...this.names, ...this.derived.map(([name]) => name)]) {
      this.columns[name] = new Float32Array(this.size);
    }
  }

  /* Append rows (row-major, count x names) that are later than the last one; return how many. */
  append(values, count) {
    const width = this.names.length, time = this.names.indexOf("t");
    let added = 0;
    for (let row = 0; row < count; row++) {
      const t = values[row * width + time];
      if (!(t >= 0) || this.n && t <= this.columns.t[this.n - 1]) continue;
      if (this.n === this.size) this.grow();
      const at = this.n++;
      for (let k = 0; k < width; k++) this.put(this.names[k], at, values[row * width + k]);
      for (const [name, [needs, law]] of this.derived) {
        this.put(name, at, law(...needs.map(need => this.columns[need][at])));
      }
      added++;
      if (this.n > this.most) this.thin();
    }
    return added;
  }

  put(name, at, value) {
    this.columns[name][at] = value;
    /* A vehicle that cannot dive reports a depth of 0 throughout. */
    if (Number.isFinite(value) && (name !== "depth" || Math.abs(value) > 0.02)) this.seen.add(name);
  }

  grow() {
    this.size *= 2;
    for (const name in this.columns) {
      const larger = new Float32Array(this.size);
      larger.set(this.columns[name]);
      this.columns[name] = larger;
    }
  }

  thin() {
    const half = this.n >> 1, kept = (half + 1) >> 1;
    for (const name in this.columns) {
      const v = this.columns[name];
      for (let k = 0; k < kept; k++) v[k] = v[2 * k];
      v.copyWithin(kept, half, this.n);
    }
    this.n = kept + this.n - half;
  }

  last(name) { return this.n && this.columns[name] ? this.columns[name][this.n - 1] : NaN; }
}

/* The track as at most `most` points: one each `spacing` m, which doubles when they are too many. */
export class Track {
  constructor(most = 4000, spacing = 0.25) { this.most = most; this.first = spacing; this.clear(); }

  clear() { this.spacing = this.first; this.north = []; this.east = []; this.open = false; }

  /* Append a place; NaN interrupts the line. */
  add(north, east) {
    const n = this.north.length, gap = !Number.isFinite(north) || !Number.isFinite(east);
    if (gap ? !this.open : this.open && this.near(n - 1, north, east)) return;
    this.push(gap ? NaN : north, gap ? NaN : east);
    this.open = !gap;
    if (this.north.length > this.most) this.thin();
  }

  near(k, north, east) { return Math.hypot(north - this.north[k], east - this.east[k]) < this.spacing; }

  push(north, east) { this.north.push(north); this.east.push(east); }

  thin() {
    const { north, east } = this;
    this.spacing *= 2; this.north = []; this.east = []; this.open = false;
    for (let k = 0; k < north.length; k++) {
      const gap = Number.isNaN(north[k]), n = this.north.length;
      if (gap ? this.open : !this.open || !this.near(n - 1, north[k], east[k])) this.push(north[k], east[k]);
      this.open = !gap;
    }
  }
}

/* A binary message: vehicle, epoch, first row (which jumps where the server has thinned), count, then the rows. */
export function unpacked(buffer) {
  const head = new DataView(buffer);
  const [vehicle, epoch, count] = [0, 4, 12].map(at => head.getUint32(at, true));
  return { vehicle, epoch, count, values: new Float32Array(buffer, 16) };
}
