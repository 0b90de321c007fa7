"""The page's arithmetic under node: degrees, ticks, rows, tracks, values of parameters."""

from __future__ import annotations

import json
import math
import re
from importlib import resources
from itertools import pairwise

import numpy as np
import pytest

from auv_path_following.missions import geodesy
from auv_path_following.missions.geodesy import Origin
from node_page import evaluate, needs_node

pytestmark = needs_node


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
        for (let k = 0; k < 9000; k++) t.add(...(k === 4500 ? [NaN, NaN] : at(k)));
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
    code = "const t = new Track(); for (let k = 0; k < 99; k++) t.add(3, 4); out = t.north"
    assert evaluate(f"import {{ Track }} from 'rows'; {code}") == [3]


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


def test_every_type_of_parameter_of_the_server_is_read() -> None:
    source = (
        resources.files("auv_sim.nodes.console").joinpath("parameter_desk.py").read_text(encoding="utf-8")
    )
    types = re.findall(r'ParameterType\.\w+: \("(\w+)"', source)
    found = evaluate("""
        import { TYPES, shows, typed } from 'typed';
        const cases = [['double', ' 0.5 '], ['int', '3'], ['bool', 'true'], ['string', ' a '],
          ['strings', 'a, b'], ['strings', '']];
        out = [Object.keys(TYPES), cases.map(one => typed(...one)), cases.map(one => shows(typed(...one))),
          ['', 'many'].map(text => Number.isNaN(typed('int', text)) && Number.isNaN(typed('double', text)))];
    """)
    assert sorted(found[0]) == sorted(types)
    assert found[1] == [0.5, 3, True, "a", ["a", "b"], []]
    assert found[2:] == [["0.5", "3", "true", "a", "a, b", ""], [True, True]]
