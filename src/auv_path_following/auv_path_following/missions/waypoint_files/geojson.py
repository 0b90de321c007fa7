"""GeoJSON: RFC 7946, with the coordinate system that older files name."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files import qgc_plan
from auv_path_following.missions.waypoint_files.content import (
    Content,
    FileShape,
    Kind,
    bounded,
    json_object,
    number,
    shape,
    shown,
)

#: Geometry -> the shape of its parts, and how deep their coordinates are nested in it.
_KINDS: dict[str, tuple[Kind, int]] = {
    "Point": ("point", 0),
    "MultiPoint": ("point", 1),
    "LineString": ("line", 0),
    "MultiLineString": ("line", 1),
    "Polygon": ("polygon", 0),
    "MultiPolygon": ("polygon", 1),
}
_TO_WGS84 = "longitude and latitude, WGS 84 (convert: ogr2ogr -t_srs EPSG:4326 new.geojson old.geojson)"
_WGS84 = ("crs84", "4326")


def read(data: bytes) -> Content:
    """Read every geometry of a file; a plan of QGroundControl in a .json file is read as such.

    Raises:
        ConfigurationError: it is not GeoJSON, or a geometry cannot be used.
    """
    document = json_object(data, "GeoJSON")
    if qgc_plan.is_plan(document):
        return qgc_plan.content(document)
    crs = document.get("crs")
    if crs is not None and not any(code in json.dumps(crs).lower() for code in _WGS84):
        raise ConfigurationError("crs", f"{json.dumps(crs):.80}", _TO_WGS84)
    content = Content()
    for name, geometry in _geometries(document):
        content.add(_shapes(name, geometry))
    return content


def _geometries(document: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield every geometry with the name of its feature, in the order of the file."""
    waiting: list[tuple[str, Any]] = [("", document)]
    while waiting:
        name, item = waiting.pop()
        if not isinstance(item, dict):
            if item is not None:
                raise ConfigurationError(_where(name), f"{json.dumps(item):.40}", "a feature or geometry")
            continue
        inner = item.get("features", item.get("geometries"))
        if isinstance(inner, list):
            waiting.extend((name, part) for part in reversed(inner))
        elif "geometry" in item:
            waiting.append((_name(item), item["geometry"]))
        elif "coordinates" in item or item.get("type") != "FeatureCollection":
            yield name, item


def _name(feature: dict[str, Any]) -> str:
    properties = feature.get("properties")
    known = {str(k).lower(): v for k, v in properties.items()} if isinstance(properties, dict) else {}
    for value in (known.get("name"), known.get("title"), known.get("label"), feature.get("id")):
        if isinstance(value, str | int) and str(value).strip():
            return str(value).strip()
    return ""


def _where(name: str) -> str:
    return f"feature {shown(name)}" if name else ""


def _shapes(name: str, geometry: dict[str, Any]) -> Iterator[FileShape]:
    kind, depth = _KINDS.get(str(geometry.get("type")), (None, 0))
    if kind is None:
        found = f"a geometry of type {geometry.get('type')!r:.40}" if geometry else "an empty geometry"
        raise ConfigurationError(_where(name), found, f"one of {', '.join(_KINDS)} or GeometryCollection")
    parts: Any = geometry.get("coordinates")
    if parts == []:  # the empty geometry of RFC 7946, section 3.1
        return
    try:
        listed = bounded(parts) if depth else [parts]
        if kind == "line":
            yield from (shape("line", name, [_place(at) for at in bounded(part)]) for part in listed)
        elif kind == "polygon":
            for rings in listed:
                yield shape("polygon", name, [_place(at) for at in bounded(rings[0])], len(rings) - 1)
        else:
            yield from (shape("point", name, [_place(part)]) for part in listed)
    except (KeyError, IndexError, TypeError, ValueError) as error:
        detail = f" ({error})" if isinstance(error, ValueError) else ""
        found = f"coordinates that are not numbers{detail}"
        raise ConfigurationError(_where(name), found, "[longitude, latitude] as GeoJSON has it") from None


def _place(coordinates: Any) -> list[float]:
    """[longitude, latitude, height] -> [latitude, longitude, height]."""
    longitude, latitude, *height = map(number, coordinates[:3])
    return [latitude, longitude, *height]
