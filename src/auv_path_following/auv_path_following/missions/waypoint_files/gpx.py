"""GPX: routes, tracks and waypoints."""

from __future__ import annotations

from xml.etree.ElementTree import Element

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import Content, bounded, decimal, shape, shown
from auv_path_following.missions.waypoint_files.xml_tree import local, parse, text_of


def read(data: bytes) -> Content:
    """Read every route and segment of a track as a line, every waypoint as a point.

    Raises:
        ConfigurationError: it is not GPX, or a position is wrong.
    """
    content = Content()
    for element in parse(data, "GPX", ("gpx",)):
        name = text_of(element, "name")
        match local(element):
            case "rte":
                places = [_place(point, name) for point in bounded(element.findall("{*}rtept"))]
                content.add([shape("line", name or "route", places)])
            case "trk":
                for segment in element.findall("{*}trkseg"):
                    places = [_place(point, name) for point in bounded(segment.findall("{*}trkpt"))]
                    content.add([shape("line", name or "track", places)])
            case "wpt":
                content.add([shape("point", name, [_place(element, name)])])
    return content


def _place(point: Element, name: str) -> list[float]:
    """[latitude, longitude, height]."""
    try:
        height = text_of(point, "ele")
        place = [decimal(point.get("lat", "")), decimal(point.get("lon", ""))]
        return [*place, decimal(height)] if height else place
    except ValueError as error:
        where = shown(name) if name else ""
        raise ConfigurationError(where, f"a position that is not a number ({error})", "lat and lon") from None
