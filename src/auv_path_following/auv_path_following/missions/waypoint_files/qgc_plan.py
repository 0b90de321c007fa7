"""QGroundControl's .plan: mission items, survey patterns, geofence, rally points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import (
    Content,
    FileShape,
    bounded,
    json_object,
    number,
    shape,
)
from auv_path_following.missions.waypoint_files.mavlink_items import Item, follow

_FORMAT = "a QGroundControl plan"
_PATTERN = "TransectStyleComplexItem"


def read(data: bytes) -> Content:
    """Read a plan.

    Raises:
        ConfigurationError: it is no plan, or its fence or a survey's polygon is wrong.
    """
    return content(json_object(data, _FORMAT))


def is_plan(document: dict[str, Any]) -> bool:
    """Return whether a JSON document is a plan."""
    return document.get("fileType") == "Plan" or _is_old(document)


def _is_old(document: dict[str, Any]) -> bool:
    """Return whether it is a .mission file, which QGroundControl wrote before plans."""
    return "mission" not in document and "plannedHomePosition" in document


def content(document: dict[str, Any]) -> Content:
    """Return the content of a plan.

    Raises:
        ConfigurationError: as `read`.
    """
    mission = document if _is_old(document) else document.get("mission")
    items = mission.get("items") if isinstance(mission, dict) else None
    if not isinstance(items, list):
        raise ConfigurationError("", "no mission.items", _FORMAT)
    bounded(items)
    found = Content()
    follow(_items(items), found)
    found.areas = list(_areas(items))
    _fence(document, found)
    rally = _list(document.get("rallyPoints"), "points")
    if rally:
        found.notices.append(f"{len(rally)} rally point(s) not taken")
    return found


def _list(holder: Any, key: str) -> list[Any]:
    value = holder.get(key) if isinstance(holder, dict) else None
    return value if isinstance(value, list) else []


def _items(items: list[Any]) -> Iterator[Item]:
    """Yield every simple item, those of survey and corridor patterns included.

    Raises:
        ConfigurationError: an item is malformed, or a pattern cannot be followed.
    """
    for position, item in enumerate(items, start=1):
        if not isinstance(item, dict):
            raise ConfigurationError(f"item {position}", f"a {type(item).__name__}", "a mission item")
        if item.get("type") != "ComplexItem" and _PATTERN not in item:
            yield _simple(str(position), item)
            continue
        kind = item.get("complexItemType")
        if isinstance(kind, str) and "landing" in kind.lower():
            yield Item(str(position), 21, 0, ())
            continue
        pattern = item.get(_PATTERN)
        inner = pattern.get("Items") if isinstance(pattern, dict) else None
        if not isinstance(inner, list):
            expected = "waypoints, or a survey or corridor with its items (save the plan again)"
            if kind == "survey":
                expected += ", or `survey: {file: ...}` for its polygon"
            raise ConfigurationError(
                f"item {position}", f"a pattern of type {kind!r:.40} without items", expected
            )
        for number_, part in enumerate(bounded(inner), start=1):
            label = f"{position}.{number_}"
            if not isinstance(part, dict):
                raise ConfigurationError(f"item {label}", f"a {type(part).__name__}", "a mission item")
            yield _simple(label, part)


def _simple(label: str, item: dict[str, Any]) -> Item:
    params = item.get("params")
    place = item.get("coordinate")
    if isinstance(place, list):  # plans before 2018 keep the position beside four parameters
        first = params if isinstance(params, list) else [item.get(f"param{k}") for k in range(1, 5)]
        params = [*first[:4], *place]
    goes_on = item.get("autoContinue", True) is not False
    return Item(label, item.get("command"), item.get("frame", 0), params, goes_on)


def _areas(items: list[Any]) -> Iterator[FileShape]:
    for position, item in enumerate(items, start=1):
        if isinstance(item, dict) and item.get("complexItemType") != "StructureScan" and "polygon" in item:
            yield _ring(f"item {position}", f"survey of item {position}", item["polygon"])


def _fence(document: dict[str, Any], found: Content) -> None:
    fence = document.get("geoFence")
    if corners := _list(fence, "polygon"):  # plans before 2018 have one polygon
        found.fences.append(_ring("geoFence", "fence", corners))
    excluded = 0
    for position, item in enumerate(_list(fence, "polygons"), start=1):
        where = f"geoFence polygon {position}"
        if not isinstance(item, dict):
            raise ConfigurationError(where, f"a {type(item).__name__}", "a polygon")
        if item.get("inclusion", True) is False:
            excluded += 1
        else:
            found.fences.append(_ring(where, f"fence {position}", item.get("polygon")))
    circles = len(_list(fence, "circles"))
    for count, what in ((excluded, "exclusion fence"), (circles, "circular fence")):
        if count:
            found.notices.append(f"{count} {what}(s) not taken: the geofence of a mission is one polygon")


def _ring(where: str, name: str, corners: Any) -> FileShape:
    try:
        return shape("polygon", name, [(number(corner[0]), number(corner[1])) for corner in corners])
    except (IndexError, KeyError, TypeError, ValueError):
        raise ConfigurationError(where, "corners that are not numbers", "[latitude, longitude]") from None
