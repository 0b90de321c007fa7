"""Read a waypoint file with the reader of its suffix, and check its content."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable
from pathlib import Path

from auv_msgs_py.settings import user_files
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files import csv_table, geojson, gpx, kml, qgc_plan, wpl
from auv_path_following.missions.waypoint_files.content import Content, FileShape, Point, heights_of, shown

_READERS: dict[str, Callable[[bytes], Content]] = {
    ".geojson": geojson.read,
    ".json": geojson.read,
    ".kml": kml.read,
    ".kmz": kml.read_zipped,
    ".gpx": gpx.read,
    ".csv": csv_table.read,
    ".plan": qgc_plan.read,
    ".mission": qgc_plan.read,
    ".waypoints": wpl.read,
    ".txt": wpl.read,
}
SUFFIXES = tuple(_READERS)


def read(path: Path, called: str | None = None) -> Content:
    """Read a waypoint file; the suffix decides on the format.

    Args:
        path: the file.
        called: its name in messages; the path if None.

    Raises:
        ConfigurationError: one line with the file, what was found and what was expected.
    """
    name = called or str(path)
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise ConfigurationError(name, f"the suffix '{path.suffix}'", f"one of {', '.join(_READERS)}")
    try:
        content = reader(user_files.read_bytes(path, "a file with waypoints"))
        content.shapes = _joined(shape for shape in content.shapes if shape.points or shape.refusal)
        _check(content)
    except ConfigurationError as error:
        inner = error.where.removeprefix(str(path))
        where = f"{name}: {inner}" if inner else name
        raise ConfigurationError(where, error.found, error.expected) from None
    return content


def _joined(shapes: Iterable[FileShape]) -> list[FileShape]:
    """Join lines of one name that were cut at the antimeridian."""
    joined: list[FileShape] = []
    for shape in shapes:
        last = joined[-1] if joined else shape
        lines = joined and last.kind == shape.kind == "line" and last.name == shape.name
        if lines and last.points and shape.points and _meet(last.points[-1], shape.points[0]):
            heights = heights_of([*_heights(last), *_heights(shape)[1:]])
            points = last.points + shape.points[1:]
            joined[-1] = dataclasses.replace(last, points=points, heights=heights)
        else:
            joined.append(shape)
    return joined


def _heights(shape: FileShape) -> tuple[float, ...]:
    return shape.heights or (math.nan,) * len(shape.points)


def _meet(end: Point, start: Point) -> bool:
    return abs(end[0] - start[0]) < 1e-9 and abs(end[1]) == 180.0 and start[1] == -end[1]


def _check(content: Content) -> None:
    shapes = [*content.shapes, *content.areas, *content.fences]
    single = 0
    for shape in shapes:
        for number, point in enumerate(shape.points, start=1):
            single += shape.kind == "point"
            where = f"point {single if shape.kind == 'point' else number}"
            where += f" of {shown(shape.name)}" if shape.name else ""
            if not all(map(math.isfinite, point)):
                raise ConfigurationError(where, f"{point}", "finite numbers")
            if content.in_degrees and (abs(point[0]) > 90.0 or abs(point[1]) > 180.0):
                found = f"latitude {point[0]:g}, longitude {point[1]:g}"
                raise ConfigurationError(where, found, "degrees, at most 90 and 180")
