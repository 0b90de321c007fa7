"""What the page keeps of each vehicle, under node: rows, state, and the vehicle that a request is for."""

from __future__ import annotations

from node_page import evaluate, needs_node

pytestmark = needs_node


def test_another_vehicle_leaves_the_rows_of_the_first_and_a_restart_does_not() -> None:
    found = evaluate("""
        import { flights, guided, take, takeRows } from 'flights';
        const columns = ['t', 'x', 'y'].map(name => ({ name }));
        const vehicle = (namespace, index) => ({ index, namespace, name: namespace });
        const hello = (started, ...names) => take({ kind: 'hello', started, columns,
          vehicles: names.map(vehicle) });
        const rows = (epoch, ...values) => {
          const b = new ArrayBuffer(16 + 4 * values.length), d = new DataView(b);
          [0, epoch, 0, values.length / 3].forEach((v, k) => d.setUint32(4 * k, v, true));
          values.forEach((v, k) => d.setFloat32(16 + 4 * k, v, true));
          return takeRows(b);
        };
        const n = () => flights.vehicles.map(v => v.table.n);
        out = [];
        hello('one', '/auv1'); take({ kind: 'begin', vehicle: 0, epoch: 7, t0: 5 });
        out.push([rows(7, 0, 1, 2, 1, 2, 3), rows(6, 2, 2, 2), ...n()]);
        hello('one', '/auv1', '/auv2'); out.push(n());
        hello('two', '/auv1', '/auv2'); out.push(n());
        flights.link = 'open';
        const tick = (age, fresh) => {
          const health = [{ node: 'ailos_guidance', age, level: 0 }];
          take({ kind: 'tick', vehicle: 0, fresh, health });
          return guided(flights.vehicles[0]);
        };
        out.push([tick(0.1, true), tick(null, true), tick(0.1, false)]);
    """)
    assert found == [[True, False, 2], [2, 0], [0, 0], [True, False, False]]


_VEHICLES = """
    import { asksOf, flights, isLocated, locked, reasonOf, shown, stateOf, take } from 'flights';
    const hello = (started, ...names) => take({ kind: 'hello', started, columns: [{ name: 't' }],
      vehicles: names.map((namespace, index) => ({ namespace, index, name: namespace })) });
    const navigation = { node: 'navigation', age: 0.1, level: 0 };
    const tick = more => take({ kind: 'tick', vehicle: 0, fresh: true, state: 'idle', reason: 'waiting',
      health: [{ node: 'guidance', age: 0.1, level: 0 }, navigation], can: { start: true }, ...more });
    flights.link = 'open'; hello('one', '/a', '/b');
"""


def test_a_restart_that_finds_the_vehicles_in_another_order_does_not_exchange_them() -> None:
    found = evaluate(f"""{_VEHICLES}
        const sent = [], ask = asksOf(async (what, fields) => {{ sent.push(fields); return {{}}; }});
        const look = async () => {{
          const answer = await ask('abort', flights.namespace);
          return [flights.vehicles.indexOf(shown()), locked(shown()) !== '', answer.message || ''];
        }};
        out = [await look()];
        hello('two', '/b'); out.push(await look());
        hello('two', '/b', '/a'); out.push(await look(), flights.namespace, sent);
    """)
    assert found[:3] == [[0, True, ""], [-1, True, "/a is not listed: nothing was sent"], [1, True, ""]]
    assert found[3:] == ["/a", [{"vehicle": at, "namespace": "/a"} for at in (0, 1)]]


def test_start_is_locked_unless_the_mission_is_shown_and_can_start() -> None:
    found = evaluate(f"""{_VEHICLES}
        const why = more => {{ tick(more); return locked(shown()); }};
        out = [why({{}})];
        take({{ kind: 'course', vehicle: 0, path: [], mission: {{ digest: 'abc' }} }});
        out.push(why({{}}), why({{ state: 'holding' }}), why({{ preflight: {{ ready: false }} }}),
          why({{ can: {{ start: false }} }}));
        flights.link = 'lost'; out.push(why({{}}));
    """)
    assert found == [
        "no mission is shown", "", "the mission is holding", "the pre-flight line is not ready",
        "a start is not possible in this state", "no data",
    ]  # fmt: skip


def test_a_state_that_is_not_heard_any_more_is_marked_everywhere() -> None:
    found = evaluate(f"""{_VEHICLES}
        const words = () => [stateOf(shown()), reasonOf(shown())];
        out = [words()];
        tick({{ state: 'running' }}); out.push(words());
        tick({{ state: 'running', fresh: false }}); out.push(words());
        flights.link = 'lost'; out.push(words());
    """)
    assert found == [
        ["not heard", "not heard yet"],
        ["running", "waiting"],
        ["silent, last: running", "guidance is silent: the last state that was heard"],
        ["silent, last: running", "no link: the last state that was heard"],
    ]


def test_figures_of_an_odometry_that_has_stopped_are_not_shown() -> None:
    found = evaluate(f"""{_VEHICLES}
        const at = (state, age, level) => {{
          tick({{ state, health: [{{ node: 'navigation', age, level }}] }}); return isLocated(shown());
        }};
        out = [at('running', 0.1, 0), at('running', 9, 3), at('holding', null, 0), at('complete', 9, 3)];
    """)
    assert found == [True, False, False, True]
