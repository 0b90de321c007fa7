"""CSV: one point a row, under a header that names the columns."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import (
    Content,
    FileShape,
    Point,
    bounded,
    decimal,
    listed,
)

_HEADER = "a header with latitude, longitude (deg) or north, east (m)"
#: Words of a column's name -> what the column is.
_NAMES = {
    **dict.fromkeys(("latitude", "lat"), "latitude"),
    **dict.fromkeys(("longitude", "lon", "lng", "long"), "longitude"),
    "north": "north",
    "east": "east",
}
_PAIRS = ((True, "latitude", "longitude"), (False, "north", "east"))
#: Units that a column's name may carry: `latitude_deg`, `Latitude (DD)`, `north [m]`.
_UNITS = {
    **dict.fromkeys(("latitude", "longitude"), ("deg", "degree", "degrees", "°", "dd", "decimal", "wgs84")),
    **dict.fromkeys(("north", "east"), ("m", "metre", "metres", "meter", "meters")),
}
_MOST_COLUMNS = 1000
_WORD = re.compile(r"[^\W_]+|°")


def read(data: bytes) -> Content:
    """Read a CSV file: commas, semicolons or tabs between columns, `#` before comments.

    Raises:
        ConfigurationError: the header or a row is not understood.
    """
    lines = [line for line in _text(data).splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        raise ConfigurationError("", "an empty file", _HEADER)
    bounded(lines)
    delimiter = next((mark for mark in ";\t" if mark in lines[0]), ",")
    if lines[0].count(delimiter) > _MOST_COLUMNS:
        raise ConfigurationError("line 1", f"more than {_MOST_COLUMNS} columns", _HEADER)
    try:
        head, *rows = csv.reader(lines, delimiter=delimiter, skipinitialspace=True)
    except csv.Error as error:
        raise ConfigurationError("", f"text that is not CSV ({error})", _HEADER) from None
    in_degrees, first, second = _columns(head, lines[0])
    points = [_point(row, (first, second), len(head), number) for number, row in enumerate(rows, start=1)]
    content = Content([FileShape("point", "", (point,)) for point in points], in_degrees)
    rest = [name.strip() for k, name in enumerate(head) if k not in (first, second) and name.strip()]
    if rest:
        content.notices.append(f"columns not taken: {listed(map(repr, rest))}")
    return content


def _text(data: bytes) -> str:
    """Return the text: Unicode, else the Windows code page of western Europe."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def _columns(head: Sequence[str], line: str) -> tuple[bool, int, int]:
    """Return whether points are in degrees, and the two columns."""
    at: dict[str, list[int]] = {}
    for k, name in enumerate(head):
        if meaning := _meaning(name):
            at.setdefault(meaning, []).append(k)
    pairs = [pair for pair in _PAIRS if at.get(pair[1]) and at.get(pair[2])]
    found = f"the header {line.strip()[:60]!r}"
    if len(pairs) > 1:
        raise ConfigurationError("", f"{found} with both pairs of columns", f"{_HEADER}: delete one pair")
    if not pairs:
        raise ConfigurationError("", found, _HEADER)
    (in_degrees, first, second) = pairs[0]
    for meaning in (first, second):
        if len(at[meaning]) > 1:
            expected = f"one: delete the others of {listed(repr(head[k].strip()) for k in at[meaning])}"
            raise ConfigurationError("", f"{found} with {len(at[meaning])} columns of {meaning}", expected)
    return in_degrees, at[first][0], at[second][0]


def _meaning(name: str) -> str | None:
    """Return the meaning of a column, e.g. latitude for `Latitude (deg)`, `LAT`; None for others."""
    first, *units = _WORD.findall(name.lower()) or [""]
    meaning = _NAMES.get(first)
    return meaning if meaning and all(unit in _UNITS[meaning] for unit in units) else None


def _point(row: Sequence[str], columns: tuple[int, int], width: int, number: int) -> Point:
    if any(cell.strip() for cell in row[width:]):
        found = f"{len(row)} values under {width} headings"
        expected = "as many (decimal commas need semicolons between the columns)"
        raise ConfigurationError(f"point {number}", found, expected)
    try:
        first, second = (_number(row[column]) for column in columns)
    except (IndexError, ValueError):
        found = repr(", ".join(row)[:60])
        raise ConfigurationError(f"point {number}", found, "two numbers in decimal notation") from None
    return first, second


def _number(cell: str) -> float:
    """Return a number with a decimal point or a single decimal comma."""
    text = cell.strip()
    return decimal(text.replace(",", ".") if text.count(",") == 1 and "." not in text else text)
