"""Waypoints from other programs: GeoJSON, KML, CSV and QGroundControl's .plan."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

from auv_msgs_py import user_files
from auv_msgs_py.errors import ConfigurationError

Point = tuple[float, float]

#: MAVLink's commands for a point to pass: NAV_WAYPOINT and NAV_SPLINE_WAYPOINT.
_WAYPOINTS = (16, 82)
#: Commands up to this one move the vehicle; later ones do something on the way,
_LAST_NAVIGATION = 95
#: but for these: CONDITION_YAW, DO_JUMP, DO_RALLY_LAND, DO_GO_AROUND, DO_REPOSITION, DO_SET_REVERSE,
#: NAV_SET_YAW_SPEED, DO_SET_MISSION_CURRENT, OVERRIDE_GOTO, DO_JUMP_TAG.
_MOVING = (115, 177, 190, 191, 192, 194, 213, 224, 252, 601)
#: MAV_FRAMEs of positions in degrees; they differ in what a height is above.
_GLOBAL_FRAMES = (0, 3, 5, 6, 10, 11)
_COLUMNS = (
    (True, ("latitude", "lat"), ("longitude", "lon", "lng")),
    (False, ("north",), ("east",)),
)


class Waypoints(NamedTuple):
    """What a file holds: (latitude, longitude) in degrees, or (north, east) in metres."""

    points: list[Point]
    in_degrees: bool


def read(path: Path) -> Waypoints:
    """Read waypoints; the suffix tells the format. A polygon gives its outer ring without the repeated end.

    Raises:
        ConfigurationError: one line with the file, what was found and what was expected.
    """
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise ConfigurationError(str(path), f"the suffix '{path.suffix}'", f"one of {', '.join(_READERS)}")
    found = reader(path, user_files.read_text(path, "a file with waypoints"))
    for number, point in enumerate(found.points, start=1):
        if not all(map(math.isfinite, point)):
            raise ConfigurationError(str(path), f"point {number} is {point}", "finite numbers")
        if found.in_degrees and (abs(point[0]) > 90.0 or abs(point[1]) > 180.0):
            said = f"latitude {point[0]:g}, longitude {point[1]:g} at point {number}"
            raise ConfigurationError(str(path), said, "degrees, at most 90 and 180")
    if not found.points:
        raise ConfigurationError(str(path), "no waypoints", "a line, a polygon or points")
    return found


def _wrong(path: Path, found: str, expected: str) -> ConfigurationError:
    return ConfigurationError(str(path), found, expected)


def _json(path: Path, text: str, what: str) -> dict[str, Any]:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise _wrong(path, f"text that is not JSON ({error})", what) from None
    if not isinstance(data, dict):
        raise _wrong(path, f"a {type(data).__name__}", what)
    return data


def _geojson(path: Path, text: str) -> Waypoints:
    geometries = list(_geometries(_json(path, text, "GeoJSON")))
    try:
        for kind in ("LineString", "Polygon"):
            shapes = [shape["coordinates"] for shape in geometries if shape.get("type") == kind]
            if len(shapes) > 1:
                raise _wrong(path, f"{len(shapes)} of type {kind}", "one")
            if shapes:
                return _open_ring(
                    [_lat_lon(c) for c in (shapes[0][0] if kind == "Polygon" else shapes[0])], kind
                )
        return Waypoints([_lat_lon(s["coordinates"]) for s in geometries if s.get("type") == "Point"], True)
    except (KeyError, IndexError, TypeError, ValueError, OverflowError):
        raise _wrong(
            path, "coordinates that are not numbers", "[longitude, latitude] as GeoJSON has it"
        ) from None


def _geometries(item: Any) -> Iterator[dict[str, Any]]:
    if not isinstance(item, dict):
        return
    for key in ("features", "geometries"):
        inner = item.get(key)
        for part in inner if isinstance(inner, list) else ():
            yield from _geometries(part)
    if isinstance(item.get("geometry"), dict):
        yield from _geometries(item["geometry"])
    if "coordinates" in item:
        yield item


def _lat_lon(coordinates: Any) -> Point:
    return float(coordinates[1]), float(coordinates[0])


def _open_ring(points: list[Point], kind: str) -> Waypoints:
    closes = kind == "Polygon" and len(points) > 1 and points[0] == points[-1]
    return Waypoints(points[:-1] if closes else points, True)


def _kml(path: Path, text: str) -> Waypoints:
    if "<!DOCTYPE" in text:
        raise _wrong(path, "a document type", "plain KML")
    try:
        root = ElementTree.fromstring(text)  # noqa: S314 - without a document type there are no entities
    except ElementTree.ParseError as error:
        raise _wrong(path, f"text that is not XML ({error})", "KML") from None
    try:
        for kind, place in (("LineString", ""), ("Polygon", "{*}outerBoundaryIs/{*}LinearRing/")):
            found = root.findall(f".//{{*}}{kind}")
            if len(found) > 1:
                raise _wrong(path, f"{len(found)} of type {kind}", "one")
            if found:
                return _open_ring(_tuples(found[0].findtext(f"{place}{{*}}coordinates") or ""), kind)
        spots = [_tuples(spot.findtext("{*}coordinates") or "") for spot in root.findall(".//{*}Point")]
        return Waypoints([point for spot in spots for point in spot], True)
    except (IndexError, ValueError):
        raise _wrong(path, "coordinates that are not numbers", "longitude,latitude as KML has it") from None


def _tuples(text: str) -> list[Point]:
    return [_lat_lon(part.split(",")) for part in text.split()]


def _plan(path: Path, text: str) -> Waypoints:
    what = "a QGroundControl plan"
    mission = _json(path, text, what).get("mission")
    if not isinstance(mission, dict) or not isinstance(mission.get("items"), list):
        raise _wrong(path, "no mission.items", what)
    points = []
    for number, item in enumerate(_plan_items(mission["items"]), start=1):
        command = item.get("command")
        if command in _WAYPOINTS:
            frame = item.get("frame", _GLOBAL_FRAMES[0])
            if frame not in _GLOBAL_FRAMES:
                raise _wrong(
                    path, f"item {number} in frame {frame}", "latitude and longitude (MAV_FRAME_GLOBAL...)"
                )
            try:
                points.append((float(item["params"][4]), float(item["params"][5])))
            except (KeyError, IndexError, TypeError, ValueError, OverflowError):
                raise _wrong(path, f"item {number} without a position", "latitude and longitude") from None
        elif not isinstance(command, int) or command <= _LAST_NAVIGATION or command in _MOVING:
            raise _wrong(path, f"item {number} with command {command}", "waypoints only (commands 16 and 82)")
    return Waypoints(points, True)


def _plan_items(items: list[Any]) -> Iterator[dict[str, Any]]:
    """Simple items; a survey pattern holds its own list of them."""
    for item in items:
        if isinstance(item, dict) and "TransectStyleComplexItem" in item:
            inner = item["TransectStyleComplexItem"]
            held = inner.get("Items") if isinstance(inner, dict) else None
            yield from _plan_items(held if isinstance(held, list) else [])
        elif isinstance(item, dict):
            yield item


def _csv(path: Path, text: str) -> Waypoints:
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    expected = "a header with latitude, longitude (deg) or north, east (m)"
    if not lines:
        raise _wrong(path, "an empty file", expected)
    delimiter = next((mark for mark in ";\t" if mark in lines[0]), ",")
    try:
        head, *rows = csv.reader(lines, delimiter=delimiter)
    except csv.Error as error:
        raise _wrong(path, f"text that is not CSV ({error})", expected) from None
    names = [name.strip().lower().removesuffix("_deg").removesuffix("_m") for name in head]
    pairs = [
        (in_degrees, names.index(first), names.index(second))
        for in_degrees, firsts, seconds in _COLUMNS
        for first in firsts
        for second in seconds
        if first in names and second in names
    ]
    if len(pairs) != 1:
        raise _wrong(path, f"the header '{lines[0].strip()[:60]}'", expected)
    in_degrees, first, second = pairs[0]
    points = []
    for number, row in enumerate(rows, start=1):
        try:
            points.append((float(row[first]), float(row[second])))
        except (IndexError, ValueError):
            raise _wrong(path, f"'{delimiter.join(row)[:60]}' as point {number}", "two numbers") from None
    return Waypoints(points, in_degrees)


_READERS: dict[str, Callable[[Path, str], Waypoints]] = {
    ".geojson": _geojson,
    ".json": _geojson,
    ".kml": _kml,
    ".csv": _csv,
    ".plan": _plan,
}
