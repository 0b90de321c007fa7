"""Waypoints of other programs, and their mistakes."""

from __future__ import annotations

import json

import pytest

from auv_msgs_py.errors import ConfigurationError
from auv_path_following.paths import waypoint_files

PLACES = [(63.44, 10.39), (63.45, 10.40), (63.46, 10.38)]
LON_LAT = [[lon, lat] for lat, lon in PLACES]
RING = [*LON_LAT, LON_LAT[0]]


def _kml(body: str) -> str:
    return (
        f'<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>{body}</Document></kml>'
    )


def _tuples(places) -> str:
    return "\n".join(f"{lon},{lat},0" for lon, lat in places)


def _item(command: int, place=(0.0, 0.0), frame=3) -> dict:
    return {"type": "SimpleItem", "command": command, "frame": frame, "params": [0, 0, 0, None, *place, 0]}


SURVEY = {
    "type": "ComplexItem",
    "TransectStyleComplexItem": {"Items": [_item(16, place) for place in PLACES[1:]]},
}
GOOD = {
    "line.geojson": json.dumps({"type": "LineString", "coordinates": LON_LAT}),
    "feature.json": json.dumps(
        {"type": "Feature", "geometry": {"type": "LineString", "coordinates": LON_LAT}}
    ),
    "ring.geojson": json.dumps(
        {"type": "FeatureCollection", "features": [{"geometry": {"type": "Polygon", "coordinates": [RING]}}]}
    ),
    "points.geojson": json.dumps(
        {"features": [{"geometry": {"type": "Point", "coordinates": place}} for place in LON_LAT]}
    ),
    "line.kml": _kml(
        f"<Placemark><LineString><coordinates>{_tuples(LON_LAT)}</coordinates></LineString></Placemark>"
    ),
    "ring.kml": _kml(
        "<Placemark><Polygon><outerBoundaryIs><LinearRing><coordinates>"
        f"{_tuples(RING)}</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>"
    ),
    "points.kml": _kml(
        "".join(
            f"<Placemark><Point><coordinates>{_tuples([p])}</coordinates></Point></Placemark>"
            for p in LON_LAT
        )
    ),
    "places.csv": "# a comment\nname,Latitude_deg,Longitude_deg\n"
    + "".join(f"a,{a},{b}\n" for a, b in PLACES),
    "semicolons.csv": "lat;lon\n" + "".join(f"{a};{b}\n" for a, b in PLACES),
    "simple.plan": json.dumps({"mission": {"items": [_item(178), *(_item(16, place) for place in PLACES)]}}),
    "frames.plan": json.dumps(
        {"mission": {"items": [_item(16, p, f) for p, f in zip(PLACES, (0, 6, 11), strict=True)]}}
    ),
    "survey.plan": json.dumps({"mission": {"items": [_item(82, PLACES[0]), SURVEY]}}),
}


@pytest.mark.parametrize("name", GOOD)
def test_every_format_gives_the_same_places(tmp_path, name):
    (tmp_path / name).write_text(GOOD[name], encoding="utf-8")
    found = waypoint_files.read(tmp_path / name)
    assert found.in_degrees
    assert found.points == PLACES


def test_metres_are_told_from_degrees(tmp_path):
    (tmp_path / "a.csv").write_text("east,north\n1,2\n3,4\n", encoding="utf-8")
    assert waypoint_files.read(tmp_path / "a.csv") == ([(2.0, 1.0), (4.0, 3.0)], False)


WRONG = {
    "a.gpx": ("", "suffix '.gpx', expected one of .geojson"),
    "a.geojson": ("{", "not JSON"),
    "list.geojson": ("[]", "a list, expected GeoJSON"),
    "empty.geojson": ("{}", "no waypoints"),
    "two.geojson": (
        json.dumps({"geometries": [{"type": "LineString", "coordinates": LON_LAT}] * 2}),
        "2 of type",
    ),
    "text.geojson": (json.dumps({"type": "LineString", "coordinates": [["a", "b"]]}), "not numbers"),
    "swapped.geojson": (json.dumps({"type": "Point", "coordinates": [10.0, 163.0]}), "latitude 163"),
    "a.kml": ("<kml>", "not XML"),
    "entities.kml": ('<!DOCTYPE kml [<!ENTITY a "b">]><kml/>', "a document type"),
    "text.kml": (_kml("<Point><coordinates>here</coordinates></Point>"), "not numbers"),
    "empty.csv": ("", "an empty file"),
    "head.csv": ("x,y\n1,2\n", "the header 'x,y'"),
    "both.csv": ("north,east,lat,lon\n1,2,3,4\n", "the header"),
    "text.csv": ("north,east\n1,2\n3\n", "'3' as point 2"),
    "nan.csv": ("north,east\n1,nan\n", "point 1 is"),
    "a.plan": ("{}", "no mission.items"),
    **{
        f"jump_{command}.plan": (
            json.dumps({"mission": {"items": [_item(16, PLACES[0]), _item(command, frame=2)]}}),
            f"item 2 with command {command}",
        )
        for command in (177, 601, 192, 115)
    },
    **{
        f"frame_{frame}.plan": (
            json.dumps({"mission": {"items": [_item(16, PLACES[0]), _item(82, (40.0, 25.0), frame)]}}),
            f"item 2 in frame {frame}",
        )
        for frame in (1, 2, 4, 7, 8, True, "3")
    },
    "land.plan": (json.dumps({"mission": {"items": [_item(21)]}}), "item 1 with command 21"),
    "place.plan": (
        json.dumps({"mission": {"items": [{"command": 16, "params": []}]}}),
        "item 1 without a position",
    ),
    "missing.csv": (None, "no such file"),
    "digits.geojson": (
        json.dumps({"type": "LineString", "coordinates": [[10**400, 1], [1, 1]]}),
        "coordinates that are not numbers",
    ),
    "wide.csv": ("lat,lon\n1,2\n" + "1" * 200_000 + ",3\n", "not CSV (field larger than field limit"),
    "digits.plan": (
        json.dumps({"mission": {"items": [_item(16, (10**400, 1))]}}),
        "item 1 without a position",
    ),
    "null.plan": (
        json.dumps({"mission": {"items": [{"TransectStyleComplexItem": {"Items": None}}]}}),
        "no waypoints",
    ),
    "deep.json": ("[" * 100_000, "not JSON"),
    "pointer.csv": ("version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "a Git LFS pointer"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_file_gets_one_line(tmp_path, name):
    text, said = WRONG[name]
    if text is not None:
        (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError) as caught:
        waypoint_files.read(tmp_path / name)
    assert str(caught.value).startswith(str(tmp_path / name))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
