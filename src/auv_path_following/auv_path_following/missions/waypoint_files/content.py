"""Content of a waypoint file of any format."""

from __future__ import annotations

import contextlib
import json
import math
from collections import Counter
from collections.abc import Iterable, Sequence, Sized
from dataclasses import dataclass, field
from typing import Any, Literal, TypeVar

from auv_msgs_py.values.errors import ConfigurationError

Point = tuple[float, float]
Kind = Literal["line", "polygon", "point"]

#: Most points, or items of a mission, of one file; a path through so many is checked in a few seconds.
MOST_POINTS = 50_000
#: Most lists and objects of a JSON file: each takes about 100 bytes of memory.
_MOST_LISTS = 1_000_000
#: A longer list of names or numbers is cut in messages.
_LISTED = 12


@dataclass(frozen=True)
class FileShape:
    """One geometry.

    Attributes:
        kind: line, polygon or point.
        name: of the feature it belongs to; empty without one.
        points: (latitude, longitude), deg, or (north, east), m; a polygon's outer ring, not closed.
        holes: inner rings of a polygon.
        heights: of the points, m; NaN where a point has none; empty where none has one.
        is_down: whether heights are depths, positive down; else they are altitudes.
        reference: of altitudes that are not above the sea, for messages (`in altitudeMode ...`); else empty.
        notices: what is not taken with this shape, one line each.
        refusal: why the shape must not be flown; None if it can be.
    """

    kind: Kind
    name: str
    points: tuple[Point, ...]
    holes: int = 0
    heights: tuple[float, ...] = ()
    is_down: bool = False
    reference: str = ""
    notices: tuple[str, ...] = ()
    refusal: ConfigurationError | None = None


@dataclass
class Content:
    """Content of a file.

    Attributes:
        shapes: in the order of the file.
        in_degrees: whether points are (latitude, longitude) in degrees, else (north, east) in metres.
        areas: polygons of survey patterns, whose transects are part of a shape.
        fences: inclusion fences.
        speed: the one speed of the whole route, m/s; None without one.
        notices: parts that are never taken, one line each.
    """

    shapes: list[FileShape] = field(default_factory=list)
    in_degrees: bool = True
    areas: list[FileShape] = field(default_factory=list)
    fences: list[FileShape] = field(default_factory=list)
    speed: float | None = None
    notices: list[str] = field(default_factory=list)
    _points: int = 0

    def add(self, shapes: Iterable[FileShape]) -> None:
        """Add shapes.

        Raises:
            ConfigurationError: the file holds too many points.
        """
        for added in shapes:
            self._points += len(added.points)
            if self._points > MOST_POINTS:
                raise ConfigurationError("", f"more than {MOST_POINTS} points", "a smaller file")
            self.shapes.append(added)


S = TypeVar("S", bound=Sized)


def bounded(parts: S) -> S:
    """Return a list that will become points, if it is short enough.

    Raises:
        ConfigurationError: it is too long, which is refused before it takes more memory.
    """
    if len(parts) > MOST_POINTS:
        raise ConfigurationError("", f"a list of {len(parts)} items", f"at most {MOST_POINTS}")
    return parts


def shape(
    kind: Kind, name: str, places: Sequence[Sequence[float]], holes: int = 0, reference: str = ""
) -> FileShape:
    """Make a shape from (latitude, longitude[, altitude]); leave out a ring's repeated end."""
    points = [(place[0], place[1]) for place in places]
    heights = heights_of(place[2] if len(place) > 2 else math.nan for place in places)
    if kind == "polygon" and len(points) > 1 and points[0] == points[-1]:
        points.pop()
        heights = heights[:-1]
    return FileShape(kind, name, tuple(points), holes, heights, reference=reference)


def heights_of(values: Iterable[float]) -> tuple[float, ...]:
    """Return the heights of a shape's points, m; empty where none has one."""
    heights = tuple(values)
    return heights if any(map(math.isfinite, heights)) else ()


def extent(heights: Iterable[float]) -> tuple[float, float] | None:
    """Return the smallest and the largest height, m; None where all are 0 or not finite."""
    known = [height for height in heights if math.isfinite(height)]
    return (min(known), max(known)) if any(known) else None


def json_object(data: bytes, what: str) -> dict[str, Any]:
    """Parse a JSON object.

    Raises:
        ConfigurationError: it is something else.
    """
    if data.count(b"[") + data.count(b"{") > _MOST_LISTS:
        raise ConfigurationError("", f"more than {_MOST_LISTS} lists and objects", "a smaller file")
    try:
        document = json.loads(data.removeprefix(b"\xef\xbb\xbf"))
    except (ValueError, RecursionError) as error:
        raise ConfigurationError("", f"text that is not JSON ({error})", what) from None
    if not isinstance(document, dict):
        raise ConfigurationError("", f"a {type(document).__name__}", what)
    return document


def number(value: Any) -> float:
    """Convert a number of a JSON file.

    Raises:
        ValueError: it is something else, or larger than a float.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{value!r:.40} is not a number")
    try:
        return float(value)
    except OverflowError:
        raise ValueError("a number of hundreds of digits") from None


def decimal(text: str) -> float:
    """Convert a number of a text file.

    Raises:
        ValueError: it is something else.
    """
    with contextlib.suppress(ValueError):
        if "_" not in text:  # 1_000 is Python's own way to write a number
            return float(text)
    raise ValueError(f"{text!r:.40} is not a number")


def labels(shapes: Sequence[FileShape]) -> list[str]:
    """Label each shape with its name, or else its kind; number labels that several shapes share."""
    plain = [shape.name or shape.kind for shape in shapes]
    alike, seen = Counter(plain), Counter[str]()
    found = []
    for label in plain:
        seen[label] += 1
        found.append(f"{label} ({seen[label]})" if alike[label] > 1 else label)
    return found


def listed(words: Iterable[Any]) -> str:
    """Join words with commas; cut a long list and count the rest."""
    items = [str(word) for word in words]
    more = f" and {len(items) - _LISTED} more" if len(items) > _LISTED else ""
    return ", ".join(items[:_LISTED]) + more


def shown(name: str) -> str:
    """Quote a name from a file: escape control characters, cut it at 60 characters."""
    return repr(name if len(name) <= 60 else name[:57] + "...")
