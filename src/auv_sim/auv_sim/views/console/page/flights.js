/* What the server has sent, for each vehicle. */
import { Table, Track, unpacked } from "./rows.js";

const SEVERAL = ["blue", "orange", "green", "brown", "red"];

export const flights = { hello: null, vehicles: [], chosen: 0, link: "lost" };

/* The vehicle that is shown. */
export const shown = () => flights.vehicles[flights.chosen] || null;

function vehicle(about, names, k) {
  return { ...about, colour: SEVERAL[k % SEVERAL.length], course: null, epoch: -1, start: 0, tick: null, events: [],
    alarms: [], table: new Table(names), track: new Track(), truth: new Track() };
}

/* Rows that arrived; return whether they are drawn. */
export function takeRows(buffer) {
  const { vehicle: k, epoch, count, values } = unpacked(buffer), v = flights.vehicles[k];
  if (!v || epoch !== v.epoch) return false;
  const before = v.table.n, added = v.table.append(values, count), { t, x, y, true_x, true_y } = v.table.columns;
  if (v.table.n !== before + added) { v.track.clear(); v.truth.clear(); }
  for (let row = v.table.n === before + added ? before : 0; row < v.table.n; row++) {
    v.track.add(y[row], x[row], t[row]);
    if (true_x && v.table.seen.has("true_x")) v.truth.add(true_y[row], true_x[row], t[row]);
  }
  return added > 0;
}

const TAKES = {
  hello(m) {
    const anew = !flights.hello || flights.hello.started !== m.started;
    flights.hello = m;
    const names = m.columns.map(column => column.name);
    /* Another vehicle may have been discovered: what is there of the others stays. */
    const there = anew ? [] : flights.vehicles;
    flights.vehicles = m.vehicles.map((about, k) => there.find(v => v.namespace === about.namespace) || vehicle(about, names, k));
    flights.chosen = Math.max(0, Math.min(flights.chosen, flights.vehicles.length - 1));
  },
  course(m, v) {
    const of = k => Float64Array.from(m.path, p => p[k] ?? NaN);
    v.course = { ...m, east: of(0), north: of(1), up: of(2) };
  },
  begin(m, v) { v.epoch = m.epoch; v.start = m.t0 || 0; v.table.clear(); v.track.clear(); v.truth.clear(); },
  tick(m, v) { v.tick = m; v.heard = performance.now(); },
  events(m, v) {
    const last = v.events.length ? v.events[v.events.length - 1].id : -Infinity;
    v.events.push(...m.events.filter(event => event.id > last));
    if (v.events.length > 2000) v.events.splice(0, v.events.length - 1500);
  },
  alarms(m, v) { v.alarms = m.alarms; },
};

/* Keep a message; return its vehicle, null if it concerns none. */
export function take(m) {
  const v = flights.vehicles[m.vehicle] || null;
  if (m.kind === "hello") TAKES.hello(m);
  else if (v && TAKES[m.kind]) TAKES[m.kind](m, v);
  return v;
}

/* Whether guidance is heard: without it the state is not known. */
export function guided(v) {
  const guidance = v.tick && v.tick.health.find(one => one.node.endsWith("guidance"));
  return Boolean(v.tick && v.tick.fresh !== false && flights.link === "open" && !(guidance && (guidance.level === 3 || guidance.age === null)));
}
