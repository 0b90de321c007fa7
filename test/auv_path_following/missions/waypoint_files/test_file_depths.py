"""Which third coordinates of each format are depths, and which files are refused for them."""

from __future__ import annotations

import json

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import waypoint_files

PLACES = [(63.0, 10.0), (63.01, 10.0), (63.01, 10.02)]


def _geojson(heights) -> str:
    line = [
        [lon, lat, *([z] if z is not None else [])] for (lat, lon), z in zip(PLACES, heights, strict=True)
    ]
    return json.dumps({"type": "LineString", "coordinates": line})


def _kml(heights, mode: str = "") -> str:
    text = " ".join(
        f"{lon},{lat}{'' if z is None else f',{z}'}" for (lat, lon), z in zip(PLACES, heights, strict=True)
    )
    mode = f"<altitudeMode>{mode}</altitudeMode>" if mode else ""
    return (
        f"<kml><Placemark><LineString>{mode}<coordinates>{text}</coordinates></LineString></Placemark></kml>"
    )


def _gpx(heights) -> str:
    points = "".join(
        f'<rtept lat="{lat}" lon="{lon}">{"" if z is None else f"<ele>{z}</ele>"}</rtept>'
        for (lat, lon), z in zip(PLACES, heights, strict=True)
    )
    return f"<gpx><rte>{points}</rte></gpx>"


def _plan(heights, frame: int = 3) -> str:
    items = [
        {"command": 16, "frame": frame, "params": [0, 0, 0, None, *place, z]}
        for place, z in zip(PLACES, heights, strict=True)
    ]
    return json.dumps({"fileType": "Plan", "mission": {"items": items}})


def _wpl(heights) -> str:
    rows = [
        f"{k + 1}\t0\t3\t16\t0\t0\t0\t0\t{lat}\t{lon}\t{z}\t1"
        for k, ((lat, lon), z) in enumerate(zip(PLACES, heights, strict=True))
    ]
    return "\n".join(["QGC WPL 110", *rows])


def _csv(heights) -> str:
    rows = [f"{lat},{lon},{'' if z is None else -z}" for (lat, lon), z in zip(PLACES, heights, strict=True)]
    return "\n".join(["lat,lon,depth_m", *rows])


FORMATS = {"geojson": _geojson, "kml": _kml, "gpx": _gpx, "plan": _plan, "waypoints": _wpl, "csv": _csv}


@pytest.fixture
def taken(tmp_path):
    def take(suffix: str, text: str, **options):
        (tmp_path / f"a.{suffix}").write_text(text)
        return waypoint_files.choose(waypoint_files.read(tmp_path / f"a.{suffix}"), "waypoints", **options)

    return take


@pytest.mark.parametrize("suffix", FORMATS)
def test_below_the_surface_is_a_positive_depth(taken, suffix):
    found = taken(suffix, FORMATS[suffix]((-5.0, 0.0, -12.5)))
    assert found.points == PLACES
    assert found.depths == [5.0, 0.0, 12.5]
    assert found.notices == []


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_file_at_the_surface_is_planar(taken, suffix):
    found = taken(suffix, FORMATS[suffix]((0.0, 0.0, 0.0)))
    assert (found.points, found.depths, found.notices) == (PLACES, None, [])


@pytest.mark.parametrize("suffix", sorted(set(FORMATS) - {"csv"}))
def test_a_file_in_the_air_is_planar_with_a_line(taken, suffix):
    found = taken(suffix, FORMATS[suffix]((5.0, 0.0, 7.0)))
    assert found.depths is None
    assert found.notices == ["altitudes (0 to 7 m) not taken: only those below 0 are depths"]


@pytest.mark.parametrize("suffix", FORMATS)
def test_depths_are_left_out_on_request_with_a_line(taken, suffix):
    found = taken(suffix, FORMATS[suffix]((-5.0, 1.0, -7.0)), take_depths=False)
    assert found.depths is None
    (notice,) = found.notices
    assert notice.endswith("not taken: the mission file ignores them (depths: ignore)")


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_point_above_the_surface_beside_depths_is_refused(taken, suffix):
    with pytest.raises(ConfigurationError, match="point 2: found a depth of -3 m, expected 0 to 12000 m"):
        taken(suffix, FORMATS[suffix]((-5.0, 3.0, -7.0)))


@pytest.mark.parametrize("suffix", sorted(set(FORMATS) - {"waypoints"}))
def test_a_point_without_a_depth_is_refused(taken, suffix):
    with pytest.raises(
        ConfigurationError, match="point 3: found no depth, expected one: point 1 has a depth"
    ):
        taken(suffix, FORMATS[suffix]((-5.0, -6.0, None)))


def test_altitudes_over_the_ground_are_refused_below_0(taken):
    with pytest.raises(ConfigurationError, match="altitudes below 0 in altitudeMode 'relativeToGround'"):
        taken("kml", _kml((-5.0, -5.0, -5.0), "relativeToGround"))
    assert taken("kml", _kml((-5.0, -5.0, -5.0), "absolute")).depths == [5.0, 5.0, 5.0]
    with pytest.raises(ConfigurationError, match=r"altitudes below 0 over the terrain \(item 1\)"):
        taken("plan", _plan((-5.0, -5.0, -5.0), frame=10))
    assert taken("plan", _plan((5.0, 5.0, 5.0), frame=10)).depths is None


def test_a_line_cut_at_the_antimeridian_keeps_its_depths(taken):
    parts = [[[179.9, 10.0, -1], [180.0, 10.05, -2]], [[-180.0, 10.05, -2], [-179.9, 10.1, -3]]]
    text = json.dumps({"type": "MultiLineString", "coordinates": parts})
    assert taken("geojson", text).depths == [1.0, 2.0, 3.0]


def test_the_outline_of_a_polygon_keeps_its_depths(taken):
    ring = [[10.0, 63.0, -1], [10.1, 63.0, -2], [10.1, 63.1, -3], [10.0, 63.0, -1]]
    text = json.dumps({"type": "Polygon", "coordinates": [ring]})
    assert taken("geojson", text).depths == [1.0, 2.0, 3.0]


def test_a_vertical_leg_is_refused_and_a_repeated_point_is_not():
    points = [(0.0, 0.0), (50.0, 0.0), (50.0, 0.0), (90.0, 0.0)]
    assert waypoint_files.kept(points, [1.0, 2.0, 2.0, 3.0]) == [0, 1, 3]
    with pytest.raises(ConfigurationError, match="point 3: found a vertical leg, from 2 to 9 m, expected"):
        waypoint_files.kept(points, [1.0, 2.0, 9.0, 3.0])
    assert waypoint_files.kept(points, None) == [0, 1, 3]
