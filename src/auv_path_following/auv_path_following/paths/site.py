"""Where a mission file's points are: its axes, its origin and its folder."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Literal

from auv_msgs_py.errors import ConfigurationError
from auv_path_following.paths import geodesy, waypoint_files
from auv_path_following.paths.geodesy import FARTHEST, Origin

Point = tuple[float, float]
Frame = Literal["ned", "enu", "wgs84"]


@dataclass(frozen=True)
class Site:
    """What is needed to place a point.

    Attributes:
        frame: `ned` [north, east] m, `enu` [east, north] m, or `wgs84` [latitude, longitude] deg.
        origin: of the plane; required for degrees.
        folder: of the mission file.
        files: waypoint files that were read so far.
    """

    frame: Frame
    origin: Origin | None
    folder: Path
    files: list[Path] = field(default_factory=list)

    def points(self, pairs: Sequence[Point]) -> list[Point]:
        """Pairs as they stand in the file -> (north, east), m.

        Raises:
            ConfigurationError: degrees out of range, or too far from the origin; names the item.
        """
        if self.frame == "ned":
            return list(pairs)
        if self.frame == "enu":
            return [(north, east) for east, north in pairs]
        for number, (latitude, longitude) in enumerate(pairs):
            if abs(latitude) > 90.0 or abs(longitude) > 180.0:
                found = f"[{latitude:g}, {longitude:g}]"
                raise ConfigurationError(f"[{number}]", found, "[latitude, longitude] in degrees")
        return self._placed(pairs)

    def point(self, pair: Point) -> Point:
        """One pair -> (north, east), m."""
        try:
            return self.points([pair])[0]
        except ConfigurationError as error:
            raise ConfigurationError("", error.found, error.expected) from None

    def _placed(self, pairs: Sequence[Point]) -> list[Point]:
        if self.origin is None:
            raise ConfigurationError(
                "origin", "nothing", "latitude_deg and longitude_deg, since points are in degrees"
            )
        if not pairs:
            return []
        latitude, longitude = zip(*pairs, strict=True)
        north, east = geodesy.to_ned(self.origin, latitude, longitude)
        placed = list(zip(north.tolist(), east.tolist(), strict=True))
        for number, (x, y) in enumerate(placed):
            if math.hypot(x, y) > FARTHEST:
                place = f"[{pairs[number][0]:g}, {pairs[number][1]:g}]"
                found = f"{place}, {math.hypot(x, y) / 1e3:.0f} km from the origin"
                expected = f"[latitude, longitude] within {FARTHEST / 1e3:g} km"
                raise ConfigurationError(f"[{number}]", found, expected)
        return placed

    def read(self, name: str) -> list[Point]:
        """The points of a waypoint file in the mission file's folder -> (north, east), m.

        Raises:
            ConfigurationError: it is elsewhere, missing, or not understood.
        """
        relative = PurePosixPath(name)
        if relative.is_absolute() or ".." in relative.parts:
            expected = "one in the mission file's own folder, so that the two stay together"
            raise ConfigurationError("file", repr(name), expected)
        path = self.folder / relative
        found = waypoint_files.read(path)
        if path not in self.files:
            self.files.append(path)
        if not found.in_degrees:
            return found.points
        try:
            return self._placed(found.points)
        except ConfigurationError as error:
            where = error.where if error.where == "origin" else f"{path.name}: point {error.where}"
            raise ConfigurationError(where, error.found, error.expected) from None

    def given(self, pairs: Sequence[Point] | None, file: str | None, key: str) -> list[Point]:
        """The points of a key or of the file that stands in its place.

        Raises:
            ConfigurationError: both are given or neither is; a point is wrong.
        """
        if (pairs is None) == (file is None):
            found = f"neither {key} nor file" if file is None else f"both {key} and file"
            raise ConfigurationError("", found, "one of them")
        if file is not None:
            return self.read(file)
        with within(key, joined=""):
            return self.points(pairs or ())


@contextmanager
def within(key: str, joined: str = ".") -> Iterator[None]:
    """Put `key` in front of the place of a `ConfigurationError`."""
    try:
        yield
    except ConfigurationError as error:
        if error.where == "origin" or ": " in error.where:  # a place of its own
            raise
        parts = [key, error.where] if error.where not in ("", key) else [key]
        separator = "" if error.where.startswith("[") else joined
        raise ConfigurationError(separator.join(parts), error.found, error.expected) from None
