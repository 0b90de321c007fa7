"""Writes the path for a chart: GeoJSON and KML, in degrees; depths are altitudes below 0."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.outline import polygon
from auv_path_following.missions.geodesy import to_geodetic
from auv_path_following.missions.mission_file import Mission

#: Largest distance of the drawn line from the path, m.
_ERROR = 0.05
#: Largest distance of places on a ramp, m.
_SPACING = 5.0
#: 1e-8 degrees are a millimetre.
_DIGITS = 8
_KML = "http://www.opengis.net/kml/2.2"

Place = list[float]


def export(mission: Mission, target: Path) -> None:
    """Write the path as a line, and its waypoints and joints as points.

    Args:
        mission: with an origin.
        target: the file to write; its suffix says which format.

    Raises:
        ConfigurationError: the mission has no origin, the suffix is unknown, or the file cannot be written.
    """
    writer = {".geojson": _geojson, ".kml": _kml}.get(target.suffix.lower())
    if writer is None:
        raise ConfigurationError("--export", f"{target}", "a file that ends with .geojson or .kml")
    if mission.origin is None:
        expected = "origin: {latitude_deg: ..., longitude_deg: ...}, to place the path on a chart"
        raise ConfigurationError(f"{mission.source}: origin", "nothing", expected)
    try:
        write_text(target, writer(mission))
    except OSError as error:
        raise ConfigurationError(
            "--export", f"{target} ({error.strerror})", "a file that can be written"
        ) from None


def _places(mission: Mission, north: Any, east: Any, depth: Any = None) -> list[Place]:
    """Return [longitude, latitude] (deg), with a depth [..., altitude] (m), of points (m)."""
    if mission.origin is None or not len(north):
        return []
    latitude, longitude = to_geodetic(mission.origin, north, east)
    places: list[Place] = np.column_stack((longitude, latitude)).round(_DIGITS).tolist()
    if depth is None:
        return places
    heights = (0.0 - np.asarray(depth, float)).round(3).tolist()
    return [[*place, height] for place, height in zip(places, heights, strict=True)]


def _pieces(mission: Mission) -> list[tuple[Any, ...]]:
    """Return north, east and, of a path in three dimensions, depth of one lap, subpath by subpath."""
    if mission.spatial is None:
        return [polygon(segment, _ERROR) for segment in mission.path.segments[: mission.once]]
    pieces = []
    for i in range(mission.once):
        subpath = mission.spatial.subpaths[i]
        shape = len(polygon(subpath.plan, _ERROR)[0])
        is_straight = subpath.knots[0].depth == subpath.knots[-1].depth and len(subpath.knots) == 2
        count = shape if is_straight else max(shape, 1 + math.ceil(subpath.length / _SPACING))
        pieces.append(tuple(mission.spatial.sampled(i, np.linspace(0.0, 1.0, count))[:3]))
    return pieces


def _line(mission: Mission) -> list[list[Place]]:
    """Return the path in parts that end at the antimeridian (RFC 7946, section 3.1.9)."""
    pieces = _pieces(mission)
    kept = [*(tuple(axis[:-1] for axis in piece) for piece in pieces[:-1]), pieces[-1]]
    north, east, *depth = (np.concatenate(axis) for axis in zip(*kept, strict=True))
    places = _places(mission, north, east, *depth)
    parts = [places[:1]]
    for k in range(1, len(places)):
        before, after = places[k - 1][0], places[k][0]
        if abs(after - before) > 180.0:
            edge = math.copysign(180.0, before)
            latitude = _crossing(mission, north[k - 1 : k + 1], east[k - 1 : k + 1])
            parts[-1].append([edge, latitude, *places[k][2:]])
            parts.append([[-edge, latitude, *places[k][2:]]])
        parts[-1].append(places[k])
    # A point on the antimeridian itself is there twice, and alone in its part at an end of the path.
    distinct = [[place for place, _ in itertools.groupby(part)] for part in parts]
    return [part for part in distinct if len(part) > 1] or distinct


def _crossing(mission: Mission, north: Any, east: Any) -> float:
    """Return the latitude (deg) at which a straight piece of the path meets the antimeridian."""
    begins_east = _places(mission, north[:1], east[:1])[0][0] > 0.0
    low, high = 0.0, 1.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        x, y = (axis[:1] + middle * (axis[1:] - axis[:1]) for axis in (north, east))
        longitude, latitude, *_ = _places(mission, x, y)[0]
        low, high = (middle, high) if (longitude > 0.0) == begins_east else (low, middle)
    return latitude


def _points(mission: Mission) -> list[tuple[str, Place]]:
    """Return names and places of waypoints and joints."""
    joints = mission.path.joints[: max(mission.once - 1, 0)]
    named = [(f"waypoint {k}", *point) for k, point in enumerate(mission.waypoints, start=1)]
    named += [(f"joint {joint.index} {joint.geometric}", joint.x, joint.y) for joint in joints]
    places = _places(mission, [item[1] for item in named], [item[2] for item in named])
    return [(item[0], place) for item, place in zip(named, places, strict=True)]


def _geojson(mission: Mission) -> str:
    def feature(kind: str, coordinates: Any, **properties: Any) -> dict[str, Any]:
        geometry = {"type": kind, "coordinates": coordinates}
        return {"type": "Feature", "properties": properties, "geometry": geometry}

    parts = _line(mission)
    line = feature(
        "LineString" if len(parts) == 1 else "MultiLineString",
        parts[0] if len(parts) == 1 else parts,
        name=mission.name,
        length_m=round(mission.path.length, 3),
    )
    points = [feature("Point", place, name=name) for name, place in _points(mission)]
    return json.dumps({"type": "FeatureCollection", "features": [line, *points]}, indent=1) + "\n"


def _kml(mission: Mission) -> str:
    ElementTree.register_namespace("", _KML)
    root = ElementTree.Element(f"{{{_KML}}}kml")
    document = ElementTree.SubElement(root, f"{{{_KML}}}Document")

    def placemark(parent: ElementTree.Element, name: str, kind: str, parts: list[list[Place]]) -> None:
        mark = ElementTree.SubElement(parent, f"{{{_KML}}}Placemark")
        ElementTree.SubElement(mark, f"{{{_KML}}}name").text = name
        holder = mark if len(parts) == 1 else ElementTree.SubElement(mark, f"{{{_KML}}}MultiGeometry")
        for places in parts:
            shape = ElementTree.SubElement(holder, f"{{{_KML}}}{kind}")
            if len(places[0]) > 2:
                ElementTree.SubElement(shape, f"{{{_KML}}}altitudeMode").text = "absolute"
            text = " ".join(",".join(map(str, place)) for place in places)
            ElementTree.SubElement(shape, f"{{{_KML}}}coordinates").text = text

    ElementTree.SubElement(document, f"{{{_KML}}}name").text = mission.name
    placemark(document, mission.name, "LineString", _line(mission))
    folder = ElementTree.SubElement(document, f"{{{_KML}}}Folder")
    ElementTree.SubElement(folder, f"{{{_KML}}}name").text = "waypoints and joints"
    for name, place in _points(mission):
        placemark(folder, name, "Point", [[place]])
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"
