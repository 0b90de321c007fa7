"""What is taken of a file with several shapes, and that nothing else goes without a line."""

from __future__ import annotations

import json

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import waypoint_files

LEG = [[10.0, 63.0], [10.1, 63.0]]
OTHER = [[10.0, 64.0], [10.1, 64.0]]
RING = [[10.0, 63.0], [10.1, 63.0], [10.1, 63.1], [10.0, 63.0]]
HOLE = [[10.05, 63.01], [10.06, 63.01], [10.06, 63.02], [10.05, 63.01]]


def _feature(kind: str, coordinates, name: str = "") -> dict:
    return {"properties": {"Name": name}, "geometry": {"type": kind, "coordinates": coordinates}}


@pytest.fixture
def taken(tmp_path):
    def take(use: str, *features: dict, feature: str | None = None):
        (tmp_path / "a.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        return waypoint_files.choose(waypoint_files.read(tmp_path / "a.geojson"), use, feature)

    return take


PINS = (_feature("Point", [10.0, 63.0], "start"), _feature("Point", [10.1, 63.1], "end"))


def test_a_multi_line_of_one_part_is_that_line_and_pins_beside_it_are_reported(taken):
    points, outline, notices, _ = taken("waypoints", *PINS, _feature("MultiLineString", [LEG]))
    assert points == [(63.0, 10.0), (63.0, 10.1)]
    assert not outline
    assert notices == ["2 points not taken: 'start', 'end'"]


def test_several_lines_are_refused_with_their_names(taken):
    with pytest.raises(ConfigurationError, match=r"2 lines \('a', 'b'\), expected one, or `feature: NAME`"):
        taken("waypoints", _feature("LineString", LEG, "a"), _feature("LineString", OTHER, "b"))
    with pytest.raises(ConfigurationError, match=r"2 lines \('a \(1\)', 'a \(2\)'\)"):
        taken("waypoints", _feature("MultiLineString", [LEG, OTHER], "a"), feature="a")


@pytest.mark.parametrize("feature", ["b", "a (2)"])
def test_one_of_several_lines_is_taken_by_its_name(taken, feature):
    features = [_feature("MultiLineString", [LEG, OTHER], "a")]
    if feature == "b":
        features = [_feature("LineString", LEG, "a"), _feature("LineString", OTHER, "b")]
    points, _, notices, _ = taken("waypoints", *features, feature=feature)
    assert points[0] == (64.0, 10.0)
    assert notices in (["1 line not taken: 'a'"], ["1 line not taken: 'a (1)'"])


def test_an_unknown_name_lists_those_that_are_there(taken):
    with pytest.raises(ConfigurationError, match="no feature 'x', expected one of 'a', 'b'"):
        taken("waypoints", _feature("LineString", LEG, "a"), _feature("Polygon", [RING], "b"), feature="x")


def test_a_line_goes_before_a_polygon_for_waypoints_and_behind_it_for_a_survey(taken):
    features = _feature("LineString", OTHER, "way"), _feature("Polygon", [RING], "area")
    assert taken("waypoints", *features).points[0] == (64.0, 10.0)
    survey = taken("survey", *features)
    assert survey.points == [(63.0, 10.0), (63.0, 10.1), (63.1, 10.1)]
    assert survey.notices == ["1 line not taken: 'way'"]


@pytest.mark.parametrize("use", ["survey", "geofence"])
def test_a_polygon_with_a_hole_is_refused_where_the_hole_would_be_crossed(taken, use):
    with pytest.raises(ConfigurationError, match=r"^'area': found a polygon with 1 hole.*split it"):
        taken(use, _feature("Polygon", [RING, HOLE], "area"))


def test_a_hole_does_not_matter_to_the_outline_but_is_reported(taken):
    outline = taken("waypoints", _feature("Polygon", [RING, HOLE], "area"))
    assert outline.outline
    assert len(outline.points) == 3
    assert outline.notices == ["the polygon's holes are not taken: only its outline is followed"]


def test_an_outline_drawn_as_a_line_is_taken_for_a_survey_with_a_line(taken):
    points, _, notices, _ = taken("survey", _feature("LineString", RING[:3], "shore"))
    assert len(points) == 3
    assert notices == ["the line 'shore' is taken as an outline and closed"]


def test_an_open_line_is_no_geofence(taken):
    with pytest.raises(ConfigurationError, match="no area"):
        taken("geofence", _feature("LineString", RING[:3]))
    assert len(taken("geofence", _feature("LineString", RING)).points) == 4


def test_altitudes_above_the_surface_are_reported(taken):
    high = [[10.0, 63.0, 5.0], [10.1, 63.0, 12.5]]
    found = taken("waypoints", _feature("LineString", high))
    assert found.notices == ["altitudes (5 to 12.5 m) not taken: only those below 0 are depths"]
    assert found.depths is None


def test_an_area_has_no_depth(taken):
    ring = [[*place, -5.0] for place in RING]
    found = taken("survey", _feature("Polygon", [ring]))
    assert found.notices == ["altitudes (-5 m) not taken: an area has no depth"]
    assert found.depths is None


def test_a_line_cut_at_the_antimeridian_is_one_line(taken):
    parts = [[[179.9, 10.0], [180.0, 10.05]], [[-180.0, 10.05], [-179.9, 10.1]]]
    points, _, notices, _ = taken("waypoints", _feature("MultiLineString", parts))
    assert points == [(10.0, 179.9), (10.05, 180.0), (10.1, -179.9)]
    assert notices == []


def test_every_part_of_a_kml_is_found_whatever_holds_it(tmp_path):
    body = (
        "<Folder><Placemark><name>both</name><MultiGeometry>"
        "<LineString><coordinates>10,63 10.1,63</coordinates></LineString>"
        "<Polygon><outerBoundaryIs><LinearRing><coordinates>10,63 11,63 11,64 10,63</coordinates>"
        "</LinearRing></outerBoundaryIs></Polygon></MultiGeometry></Placemark></Folder>"
        "<Placemark><name>ship</name><Model/></Placemark><NetworkLink><name>more</name></NetworkLink>"
    )
    (tmp_path / "a.kml").write_text(f"<kml><Document>{body}</Document></kml>")
    points, _, notices, _ = waypoint_files.choose(waypoint_files.read(tmp_path / "a.kml"), "waypoints")
    assert points == [(63.0, 10.0), (63.0, 10.1)]
    assert notices == [
        "1 3D model(s) not taken",
        "1 network link(s) not taken",
        "1 polygon not taken: 'both (2)'",
    ]
