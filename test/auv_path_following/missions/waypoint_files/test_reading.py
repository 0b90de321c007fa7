"""Waypoints of other programs, and their mistakes."""

from __future__ import annotations

import json
import re
import zipfile

import pytest

from auv_msgs_py.settings import user_files
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import waypoint_files

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


def _gpx(body: str) -> str:
    return f'<?xml version="1.0"?><gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">{body}</gpx>'


def _gpx_points(kind: str) -> str:
    return "".join(f'<{kind} lat="{lat}" lon="{lon}"><name>a</name></{kind}>' for lat, lon in PLACES)


def _wpl(items) -> str:
    rows = (
        f"{index}\t0\t{frame}\t{command}\t0\t0\t0\t0\t{lat}\t{lon}\t0\t1\n"
        for index, (frame, command, (lat, lon)) in enumerate(items)
    )
    return "QGC WPL 110\n# of a ground station\n\n" + "".join(rows)


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
    "old.plan": json.dumps(
        {"mission": {"items": [{"command": 16, "coordinate": [*place, 5.0]} for place in PLACES]}}
    ),
    "plan.json": json.dumps(
        {"fileType": "Plan", "mission": {"items": [_item(16, place) for place in PLACES]}}
    ),
    "route.gpx": _gpx(f"<rte>{_gpx_points('rtept')}</rte>"),
    "track.gpx": _gpx(f"<trk><trkseg>{_gpx_points('trkpt')}</trkseg></trk>"),
    "points.gpx": _gpx(_gpx_points("wpt")),
    "home.waypoints": _wpl([(0, 16, (1.0, 2.0)), *((3, 16, place) for place in PLACES)]),
    "first.txt": _wpl([(3, 16, place) for place in PLACES]),
    "track.kml": _kml(
        '<Placemark><gx:Track xmlns:gx="http://www.google.com/kml/ext/2.2">'
        + "".join(f"<when>2026-01-01</when><gx:coord>{lon} {lat} 0</gx:coord>" for lat, lon in PLACES)
        + "</gx:Track></Placemark>"
    ),
    "survey.plan": json.dumps({"mission": {"items": [_item(82, PLACES[0]), SURVEY]}}),
}


@pytest.mark.parametrize("name", GOOD)
def test_every_format_gives_the_same_places(tmp_path, name):
    (tmp_path / name).write_text(GOOD[name], encoding="utf-8")
    content = waypoint_files.read(tmp_path / name)
    assert content.in_degrees
    assert waypoint_files.choose(content, "waypoints").points == PLACES


def test_a_kmz_gives_the_same_places(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.kmz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("images/pin.png", b"PNG")
        archive.writestr("doc.kml", GOOD["line.kml"])
    assert waypoint_files.choose(waypoint_files.read(tmp_path / "a.kmz"), "waypoints").points == PLACES


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (("a/b.kml", "c.kml"), "2 .kml files inside ('a/b.kml', 'c.kml'), expected a KMZ with one doc.kml"),
        (("a.png",), "no .kml file inside"),
    ],
)
def test_a_kmz_without_one_document_is_refused(tmp_path, names, said):
    with zipfile.ZipFile(tmp_path / "a.kmz", "w") as archive:
        for name in names:
            archive.writestr(name, GOOD["line.kml"])
    with pytest.raises(ConfigurationError, match=re.escape(said)):
        waypoint_files.read(tmp_path / "a.kmz")


def test_a_kmz_that_unpacks_to_more_than_a_file_may_have_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.kmz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("doc.kml", b" " * (user_files.MOST_BYTES + 1))
    with pytest.raises(ConfigurationError, match="a document of more than 16,000,000 bytes"):
        waypoint_files.read(tmp_path / "a.kmz")


def test_a_fragment_of_kml_is_read(tmp_path):
    (tmp_path / "a.kml").write_text(
        f"<Placemark><LineString><coordinates>{_tuples(LON_LAT)}</coordinates></LineString></Placemark>"
    )
    assert waypoint_files.choose(waypoint_files.read(tmp_path / "a.kml"), "waypoints").points == PLACES


def test_columns_of_metres_are_metres(tmp_path):
    (tmp_path / "a.csv").write_text("east,north\n1,2\n3,4\n", encoding="utf-8")
    content = waypoint_files.read(tmp_path / "a.csv")
    assert not content.in_degrees
    assert waypoint_files.choose(content, "waypoints").points == [(2.0, 1.0), (4.0, 3.0)]


MANY = 50_001
LARGE = {
    "rows.csv": "lat,lon\n" + "1,1\n" * MANY,
    "points.geojson": '{"type": "MultiPoint", "coordinates": [' + "[1,1]," * MANY + "[1,1]]}",
    "lists.geojson": '{"type": "MultiPoint", "coordinates": [' + "[]," * 1_000_001 + "[]]}",
    "line.kml": _kml(f"<LineString><coordinates>{'1,1 ' * MANY}</coordinates></LineString>"),
    "elements.kml": f"<kml>{'<a/>' * 400_001}</kml>",
    "points.gpx": _gpx('<wpt lat="1" lon="1"/>' * MANY),
    "items.waypoints": "QGC WPL 110\n" + "0\t0\t3\t16\t0\t0\t0\t0\t1\t1\t0\t1\n" * MANY,
    "items.plan": '{"mission": {"items": [' + "{}," * MANY + "{}]}}",
}


@pytest.mark.parametrize("name", LARGE)
def test_a_file_with_more_than_a_mission_may_have_is_refused_before_it_is_built(tmp_path, name):
    (tmp_path / name).write_text(LARGE[name], encoding="utf-8")
    with pytest.raises(ConfigurationError, match=r"(more than|a list of) [\d]{5,7} "):
        waypoint_files.read(tmp_path / name)


WRONG = {
    "a.shp": ("", "suffix '.shp', expected one of .geojson"),
    "a.gpx": ("<gpx><wpt lat='1'/></gpx>", "a position that is not a number"),
    "kml.gpx": ("<kml/>", "XML with the root <kml>, expected GPX"),
    "bomb.gpx": (
        '<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "aaaa">]><gpx/>',
        "a document type",
    ),
    "a.kmz": ("PK no archive", "an archive that cannot be read"),
    "a.waypoints": ("1\t2\n", "expected QGC WPL 110"),
    "short.waypoints": ("QGC WPL 110\n0\t1\t0\t16\n", "line 2: found"),
    "a.geojson": ("{", "not JSON"),
    "list.geojson": ("[]", "a list, expected GeoJSON"),
    "empty.geojson": ("{}", "an empty geometry"),
    "esri.json": (json.dumps({"features": [{"geometry": {"paths": [LON_LAT]}}]}), "a geometry of type None"),
    "utm.geojson": (
        json.dumps({"type": "Point", "coordinates": [1, 2], "crs": {"properties": {"name": "EPSG:25832"}}}),
        "EPSG:4326 new.geojson",
    ),
    "digits.geojson": ('{"type": "Point", "coordinates": [1' + 400 * "0" + ", 1]}", "hundreds of digits"),
    "text.geojson": (json.dumps({"type": "LineString", "coordinates": [["a", "b"]]}), "not numbers"),
    "swapped.geojson": (json.dumps({"type": "Point", "coordinates": [10.0, 163.0]}), "latitude 163"),
    "a.kml": ("<kml>", "not XML"),
    "entities.kml": ('<!DOCTYPE kml [<!ENTITY a "b">]><kml/>', "a document type"),
    "text.kml": (_kml("<Point><coordinates>here</coordinates></Point>"), "1 numbers in 'here'"),
    "spaces.kml": (_kml("<Point><coordinates>10, 63, 0</coordinates></Point>"), "'' is not a number"),
    "glued.kml": (
        _kml("<LineString><coordinates>10,63,0,10.1,63,0,10.2,63,0</coordinates></LineString>"),
        "9 numbers in '10,63,0,10.1",
    ),
    "empty.csv": ("", "an empty file"),
    "head.csv": ("x,y\n1,2\n", "the header 'x,y'"),
    "both.csv": ("north,east,lat,lon\n1,2,3,4\n", "with both pairs of columns"),
    "text.csv": ("north,east\n1,2\n3\n", "point 2: found '3'"),
    "nan.csv": ("north,east\n1,nan\n", "point 1: found (1.0, nan)"),
    "a.plan": ("{}", "no mission.items"),
    "missing.csv": (None, "no such file"),
    "wide.csv": ("lat,lon\n1,2\n" + "1" * 200_000 + ",3\n", "not CSV (field larger than field limit"),
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
