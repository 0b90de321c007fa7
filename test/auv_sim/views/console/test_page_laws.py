"""The page's arithmetic under node: degrees, ticks, rows, tracks, the link's time-outs."""

from __future__ import annotations

import json
import math
import shutil
import subprocess
from importlib import resources
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from auv_path_following.missions import geodesy
from auv_path_following.missions.geodesy import Origin
from auv_sim.views.console.record.wire_messages import PROTOCOL

PAGE = resources.files("auv_sim.views.console").joinpath("page")
NODE = shutil.which("node")
_END = "console.log(JSON.stringify(out)); process.exit(0)"
pytestmark = pytest.mark.skipif(NODE is None, reason="not run: no node")


def evaluate(code: str) -> Any:
    """Return what `out` is after some code that may import modules of the page."""
    assert NODE is not None
    for name in ("geodesy", "rows", "drawing", "link", "map_drawing", "flights"):
        code = code.replace(f"'{name}'", f"'file://{PAGE.joinpath(f'{name}.js')}'")
    done = subprocess.run(
        [NODE, "--input-type=module", "-e", f"let out;\n{code}\n{_END}"],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("latitude", [63.4470, -33.9, 0.0])
def test_degrees_agree_with_pymap3d(latitude: float) -> None:
    places = [(0, 0), (330, -120), (-7000, 5000), (28000, 28000)]
    origin = {"latitude": latitude, "longitude": 10.3990}
    found = evaluate(
        f"import {{ toDegrees, toMetres }} from 'geodesy'; const o = {json.dumps(origin)};"
        f"const places = {json.dumps(places)};"
        "out = places.map(p => { const d = toDegrees(o, ...p); return [d, toMetres(o, ...d)]; })"
    )
    for (north, east), (degrees, metres) in zip(places, found, strict=True):
        at = geodesy.to_geodetic(Origin(latitude_deg=latitude, longitude_deg=10.3990), north, east)
        assert degrees == pytest.approx([float(angle) for angle in at], abs=2e-9)
        assert metres == pytest.approx([north, east], abs=2e-4)


def test_range_bearing_and_chart_angles() -> None:
    found = evaluate(
        "import { rangeAndBearing, chartAngle } from 'geodesy';"
        "out = [rangeAndBearing([0, 0], [0, 5]), rangeAndBearing([1, 1], [-2, -3]),"
        " chartAngle(63.447, 'N', 'S'), chartAngle(-0.0125, 'E', 'W')]"
    )
    assert found[0] == pytest.approx([5.0, 90.0])
    assert found[1] == pytest.approx([5.0, math.degrees(math.atan2(-4, -3)) % 360])
    assert found[2:] == ["63° 26.820' N", "0° 00.750' W"]


@pytest.mark.parametrize("covariance", [[4.0, 0.0, 1.0], [1.6, 0.4, 0.7], [1.0, -0.9, 2.0]])
def test_the_ellipse_holds_95_percent(covariance: list[float]) -> None:
    long, short, bearing = evaluate(f"import {{ ellipse }} from 'geodesy'; out = ellipse({covariance})")
    xx, xy, yy = covariance
    values, vectors = np.linalg.eigh([[xx, xy], [xy, yy]])
    assert [short, long] == pytest.approx(np.sqrt(-2 * math.log(0.05) * values))
    east, north = vectors[:, 1]
    assert abs(math.sin(bearing - math.atan2(east, north))) < 1e-9
    assert evaluate("import { ellipse } from 'geodesy'; out = ellipse([1, 5, 1])") is None


def test_geojson_is_read_or_refused_with_what_was_found() -> None:
    ring = [[10.0, 63.0], [10.1, 63.0], [10.0, 63.1], [10.0, 63.0]]
    good = {"type": "FeatureCollection", "features": [
        {"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[ring], [ring]]}},
        {"type": "Feature", "geometry": {"type": "GeometryCollection", "geometries": [
            {"type": "Point", "coordinates": [10.0, 63.0, 5.0]},
            {"type": "LineString", "coordinates": ring}]}},
        {"type": "Feature", "geometry": None}]}  # fmt: skip
    bad = [
        {"type": "Topology"},
        {"type": "Point", "coordinates": [500, 3]},
        {"type": "LineString", "coordinates": [5]},
    ]
    found = evaluate(
        "import { geojson } from 'geodesy';"
        "const said = o => { try { geojson(JSON.stringify(o)); } catch (e) { return e.message; } };"
        f"const g = geojson({json.dumps(json.dumps(good))});"
        f"out = [g.lines.length, g.points, {json.dumps(bad)}.map(said)]"
    )
    assert found[:2] == [3, [[10.0, 63.0]]]
    assert ["expected" in text for text in found[2]] == [True] * 3


def test_ticks_are_round_and_few() -> None:
    ranges = [[0, 1], [-0.3, 0.35], [0, 1199], [97.2, 97.9], [-4e5, 1e6]]
    found = evaluate(f"import {{ ticks }} from 'drawing'; out = {ranges}.map(r => ticks(...r, 4))")
    for (low, high), (values, digits) in zip(ranges, found, strict=True):
        assert 1 <= len(values) <= 6
        assert low - 1e-9 <= values[0] and values[-1] <= high + 1e-9
        step = values[1] - values[0] if len(values) > 1 else 1.0
        assert f"{step / 10 ** math.floor(math.log10(step) + 1e-9):.3f}" in (
            "1.000",
            "2.000",
            "5.000",
            "10.000",
        )
        assert all(abs(round(v, digits) - v) < 1e-9 for v in values)


def test_rows_grow_without_loss_and_ignore_what_they_have() -> None:
    found = evaluate("""
        import { Table } from 'rows';
        const t = new Table(['t', 'yaw', 'z']), row = k => [k, Math.PI / 2, -k];
        const range = (a, b) => Array.from({ length: b - a }, (_, k) => a + k);
        const rows = (a, b) => Float32Array.from(range(a, b).flatMap(row));
        t.append(rows(0, 2000), 2000);
        const again = t.append(rows(1990, 2010), 20);
        const kept = name => Array.from(t.columns[name].slice(0, t.n));
        out = [t.n, again, kept('t'), kept('depth'), t.last('heading')];
    """)
    assert found[:2] == [2010, 10]
    assert found[2] == found[3] == list(range(2010))
    assert math.remainder(found[4], 360.0) == pytest.approx(0.0, abs=1e-3)


def test_old_rows_are_thinned_and_new_ones_are_not() -> None:
    found = evaluate("""
        import { Table } from 'rows';
        const t = new Table(['t'], 1000);
        for (let k = 0; k < 5000; k++) t.append(Float32Array.of(k), 1);
        out = Array.from(t.columns.t.slice(0, t.n));
    """)
    assert len(found) <= 1000
    assert found[0] == 0
    assert found[-300:] == list(range(4700, 5000))
    assert all(b > a for a, b in pairwise(found))


def test_a_track_stays_small_and_near_what_was_flown() -> None:
    found = evaluate("""
        import { Track } from 'rows';
        const t = new Track(500, 0.25), at = k => [100 * Math.cos(k / 400), 100 * Math.sin(k / 400)];
        for (let k = 0; k < 9000; k++) t.add(...(k === 4500 ? [NaN, NaN] : at(k)), k);
        out = [t.north.map((v, k) => [v, t.east[k]]), t.spacing];
    """)
    places = np.array([[math.nan if v is None else v for v in place] for place in found[0]])
    assert 200 < len(places) <= 500
    assert np.isnan(places[:, 0]).sum() == 1
    known = places[np.isfinite(places[:, 0])]
    assert np.hypot(*known.T) == pytest.approx(100.0)
    flown = np.array([[100 * math.cos(k / 400), 100 * math.sin(k / 400)] for k in range(0, 9000, 40)])
    nearest = np.min(np.hypot(*(flown[:, None] - known[None]).transpose(2, 0, 1)), axis=1)
    assert nearest.max() <= 1.5 * found[1]


def test_a_vehicle_at_rest_adds_nothing_to_its_track() -> None:
    code = "const t = new Track(); for (let k = 0; k < 99; k++) t.add(3, 4, k); out = t.north"
    assert evaluate(f"import {{ Track }} from 'rows'; {code}") == [3]


#: A browser's socket and fetch: a handshake that is answered with 403 closes the socket.
_BROWSER = """
    globalThis.location = { protocol: 'http:', host: 'here' };
    globalThis.status = 200; globalThis.sockets = []; globalThis.sent = [];
    globalThis.WebSocket = class { static CONNECTING = 0; static OPEN = 1; static CLOSED = 3; readyState = 0;
      constructor() {
        sockets.push(this); globalThis.socket = this;
        if (status === 403) setTimeout(() => { this.readyState = 3; this.onclose(); });
      }
      send(text) { sent.push(JSON.parse(text)); } close() { this.readyState = 3; }
      says(message) { this.onmessage({ data: JSON.stringify(message) }); } };
    globalThis.fetch = async () => ({ status });
    const { Link } = await import('link'), states = [], heard = [];
    const link = new Link(message => heard.push(message.kind), state => states.push(state));
    const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));
"""


def test_every_request_has_an_end() -> None:
    found = evaluate(f"""{_BROWSER}
        socket.readyState = 1; socket.says({{ kind: 'hello', protocol: 1 }});
        const first = link.ask('hold'), late = link.ask('abort', {{}}, 0.05), gone = link.ask('start');
        socket.says({{ kind: 'answer', id: 1, ok: true, message: 'holding' }});
        out = [await first, await late];
        status = 403; socket.readyState = 3; socket.onclose();
        out.push(await gone, await link.ask('abort'));
        await pause(500);
        out.push(states, sockets.length);
    """)
    assert [answer["message"] for answer in found[:4]] == [
        "holding", "no answer within 0.05 s", "the link was lost before the answer",
        "no link: nothing was sent",
    ]  # fmt: skip
    assert [answer["ok"] for answer in found[:4]] == [True, False, False, False]
    # A page that is refused says so until it is let in.
    assert found[4:] == [["open", "lost", "refused"], 1]


def test_nothing_is_sent_before_the_hello_nor_to_another_protocol() -> None:
    found = evaluate(f"""{_BROWSER}
        socket.readyState = 1; socket.onopen?.();
        out = [(await link.ask('abort')).message];
        socket.says({{ kind: 'hello', protocol: 2 }}); socket.says({{ kind: 'tick' }});
        out.push((await link.ask('abort')).message, [...heard], [...states]);
        socket.says({{ kind: 'hello', protocol: PROTOCOL }}); link.ask('abort');
        out.push(heard, states, sent.map(one => one.do));
    """.replace("const { Link }", "const { Link, PROTOCOL }"))  # fmt: skip
    refused = "no link: nothing was sent"
    assert found == [refused, refused, [], ["outdated"], ["hello"], ["outdated", "open"], ["abort"]]
    assert evaluate("import { PROTOCOL } from 'link'; out = PROTOCOL") == PROTOCOL


def test_a_socket_that_never_opens_is_given_up() -> None:
    found = evaluate(f"""
        let now = 0; performance.now = () => now;
        {_BROWSER}
        now = 4900; link.watch(); out = [[...states]];
        now = 5100; link.watch(); await pause(400);
        out.push(states, sockets.map(one => one.readyState));
    """)
    assert found == [[], ["lost"], [3, 0]]


def test_a_turned_map_finds_its_places_again() -> None:
    found = evaluate(
        "import { placing, placeAt, zoomAt } from 'map_drawing';"
        "const v = { x: 30, y: -20, scale: 2.5, up: 1.1 };"
        "const at = placing(v, 400, 300), [x, y] = at(70, 15), again = placeAt(v, 400, 300, x, y);"
        "zoomAt(v, 400, 300, x, y, 3); out = [again, placing(v, 400, 300)(70, 15), [x, y], v.scale,"
        " placing({ x: 0, y: 0, scale: 1, up: Math.PI / 2 }, 0, 0)(0, 1)]"
    )
    assert found[0] == pytest.approx([70, 15])
    assert found[1] == pytest.approx(found[2])
    assert found[3] == 7.5
    # With east up, a place in the east is above the middle.
    assert found[4] == pytest.approx([0, -1], abs=1e-12)


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
