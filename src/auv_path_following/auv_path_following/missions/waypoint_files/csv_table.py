"""CSV: one point a row, under a header that names the columns; a depth is positive down."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import (
    Content,
    FileShape,
    bounded,
    decimal,
    heights_of,
    listed,
)

_HEADER = "a header with latitude, longitude (deg) or north, east (m)"
#: Words of a column's name -> what the column is.
_NAMES = {
    **dict.fromkeys(("latitude", "lat"), "latitude"),
    **dict.fromkeys(("longitude", "lon", "lng", "long"), "longitude"),
    "north": "north",
    "east": "east",
    "depth": "depth",
}
_PAIRS = ((True, "latitude", "longitude"), (False, "north", "east"))
#: Units that a column's name may carry: `latitude_deg`, `Latitude (DD)`, `north [m]`.
_UNITS = {
    **dict.fromkeys(("latitude", "longitude"), ("deg", "degree", "degrees", "°", "dd", "decimal", "wgs84")),
    **dict.fromkeys(("north", "east", "depth"), ("m", "metre", "metres", "meter", "meters")),
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
    in_degrees, *columns = _columns(head, lines[0])
    content = Content(in_degrees=in_degrees)
    for number, row in enumerate(rows, start=1):
        first, second, *depth = _numbers(row, columns, len(head), number)
        content.shapes.append(
            FileShape("point", "", ((first, second),), heights=heights_of(depth), is_down=True)
        )
    rest = [name.strip() for k, name in enumerate(head) if k not in columns and name.strip()]
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


def _columns(head: Sequence[str], line: str) -> tuple[bool, *tuple[int, ...]]:
    """Return whether points are in degrees, the two columns, and that of the depth if there is one."""
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
    for meaning in (first, second, "depth"):
        if len(at.get(meaning, ())) > 1:
            expected = f"one: delete the others of {listed(repr(head[k].strip()) for k in at[meaning])}"
            raise ConfigurationError("", f"{found} with {len(at[meaning])} columns of {meaning}", expected)
    return in_degrees, at[first][0], at[second][0], *at.get("depth", ())


def _meaning(name: str) -> str | None:
    """Return the meaning of a column, e.g. latitude for `Latitude (deg)`, `LAT`; None for others."""
    first, *units = _WORD.findall(name.lower()) or [""]
    meaning = _NAMES.get(first)
    return meaning if meaning and all(unit in _UNITS[meaning] for unit in units) else None


def _numbers(row: Sequence[str], columns: Sequence[int], width: int, number: int) -> list[float]:
    """Return the numbers of a row; NaN for a depth that is left empty."""
    if any(cell.strip() for cell in row[width:]):
        found = f"{len(row)} values under {width} headings"
        expected = "as many (decimal commas need semicolons between the columns)"
        raise ConfigurationError(f"point {number}", found, expected)
    try:
        place = [_number(row[column]) for column in columns[:2]]
        depths = [row[column].strip() if column < len(row) else "" for column in columns[2:]]
        return place + [_number(depth) if depth else math.nan for depth in depths]
    except (IndexError, ValueError):
        found = repr(", ".join(row)[:60])
        expected = f"{'two' if len(columns) == 2 else 'three'} numbers in decimal notation"
        raise ConfigurationError(f"point {number}", found, expected) from None


def _number(cell: str) -> float:
    """Return a number with a decimal point or a single decimal comma."""
    text = cell.strip()
    return decimal(text.replace(",", ".") if text.count(",") == 1 and "." not in text else text)
