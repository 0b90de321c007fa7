/* What the server has sent, for each vehicle. */
import { Table, Track, unpacked } from "./rows.js";

const SEVERAL = ["blue", "orange", "green", "brown", "red"];

/* namespace: of the vehicle that is shown. Its number is the server's and another one after a restart. */
export const flights = { hello: null, vehicles: [], namespace: null, link: "lost" };

const numberOf = namespace => flights.vehicles.findIndex(v => v.namespace === namespace);

/* The vehicle that is shown; null while it is not listed. */
export const shown = () => flights.vehicles[numberOf(flights.namespace)] || null;

/* From the link's `ask` the one for a vehicle: (what, namespace, fields, seconds) -> answer. */
export const asksOf = ask => (what, namespace, fields = {}, seconds = 5) => {
  const vehicle = numberOf(namespace);
  if (vehicle >= 0 || flights.link !== "open") return ask(what, { vehicle, namespace, ...fields }, seconds);
  return Promise.resolve({ ok: false, message: `${namespace || "no vehicle"} is not listed: nothing was sent` });
};

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
    v.track.add(y[row], x[row]);
    if (true_x && v.table.seen.has("true_x")) v.truth.add(true_y[row], true_x[row]);
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
    flights.namespace ??= flights.vehicles[0]?.namespace ?? null;
  },
  course(m, v) {
    const of = k => Float64Array.from(m.path, p => p[k] ?? NaN);
    v.course = { ...m, east: of(0), north: of(1), up: of(2) };
  },
  begin(m, v) { v.epoch = m.epoch; v.start = m.t0 || 0; v.table.clear(); v.track.clear(); v.truth.clear(); },
  tick(m, v) { v.tick = m; },
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

/* What identifies the mission that is shown; empty: none is. */
export const digestOf = v => v && v.course && v.course.mission && v.course.mission.digest || "";

const isFlying = v => ["running", "holding"].includes(v.tick.state);

/* Why Start is locked; empty: it is not. */
export function locked(v) {
  if (!v || !v.tick || flights.link !== "open") return "no data";
  if (isFlying(v)) return `the mission is ${v.tick.state}`;
  if (v.tick.preflight && !v.tick.preflight.ready) return "the pre-flight line is not ready";
  if (!digestOf(v)) return "no mission is shown";
  return v.tick.can.start ? "" : "a start is not possible in this state";
}

/* The state in a word or a few: one that is not heard any more is marked as such. */
export const stateOf = v => !v.tick ? "not heard" : guided(v) ? v.tick.state : `silent, last: ${v.tick.state}`;

/* What stands below the state. */
export function reasonOf(v) {
  if (!v.tick) return "not heard yet";
  if (guided(v)) return v.tick.reason || "";
  return `${flights.link === "open" ? "guidance is silent" : "no link"}: the last state that was heard`;
}

/* Whether the odometry is heard, as long as the mission needs it. */
export function isLocated(v) {
  const navigation = v.tick && isFlying(v) && v.tick.health.find(one => one.node === "navigation");
  return !(navigation && (navigation.level === 3 || navigation.age === null));
}

/* Whether guidance is heard: without it the state is not known. */
export function guided(v) {
  const guidance = v.tick && v.tick.health.find(one => one.node.endsWith("guidance"));
  return Boolean(v.tick && v.tick.fresh !== false && flights.link === "open" && !(guidance && (guidance.level === 3 || guidance.age === null)));
}
