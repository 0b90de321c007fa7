"""Placing the points of a mission file: its axes, its origin and its folder."""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any, Literal, NamedTuple

from auv_msgs_py.values.errors import ConfigurationError, printable
from auv_path_following.missions import geodesy, waypoint_files
from auv_path_following.missions.geodesy import FARTHEST, Origin
from auv_path_following.missions.waypoint_files import Content, Use
from auv_path_following.missions.waypoint_files.content import MOST_POINTS

Point = tuple[float, float]
Frame = Literal["ned", "enu", "wgs84"]

#: Largest number in a mission, m, deg, s or N; a northing of UTM is smaller.
LARGEST = 1e7


class Given(NamedTuple):
    """Points of a mission file or of a waypoint file.

    Attributes:
        points: (north, east), m.
        outline: whether they are the outline of a polygon, which is closed.
        depths: of the points, m, positive down; None where they have none.
    """

    points: list[Point]
    outline: bool
    depths: list[float] | None = None


@dataclass(frozen=True)
class Site:
    """Axes, origin and folder of a mission file.

    Attributes:
        frame: `ned` [north, east] m, `enu` [east, north] m, or `wgs84` [latitude, longitude] deg.
        origin: of the plane; required for degrees.
        folder: of the mission file.
        files: waypoint files read so far, and their content.
        notices: parts of them that were not taken, one line each.
    """

    frame: Frame
    origin: Origin | None
    folder: Path
    files: dict[Path, Content] = field(default_factory=dict)
    notices: list[str] = field(default_factory=list)

    def points(self, pairs: Sequence[Point]) -> list[Point]:
        """Convert pairs of the file to (north, east), m.

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
        return self._placed(pairs, lambda k: f"[{k}]")

    def places(self, items: Sequence[Sequence[float]]) -> tuple[list[Point], list[float] | None]:
        """Convert points of the file to (north, east), m, and their third numbers to depths, m.

        Returns:
            The points, and their depths; None where no point has one.

        Raises:
            ConfigurationError: as `points`; a point without a depth beside others, or above the surface.
        """
        points = self.points([(item[0], item[1]) for item in items])
        if all(len(item) == 2 for item in items):
            return points, None
        depths = [item[2] if len(item) > 2 else math.nan for item in items]
        waypoint_files.check_depths(depths, lambda k: f"[{k}]")
        waypoint_files.kept(points, depths, lambda k: f"[{k}]")
        return points, depths

    def point(self, pair: Point) -> Point:
        """Convert one pair to (north, east), m."""
        try:
            return self.points([pair])[0]
        except ConfigurationError as error:
            raise ConfigurationError("", error.found, error.expected) from None

    def _placed(self, pairs: Sequence[Point], place: Callable[[int], str]) -> list[Point]:
        if self.origin is None:
            raise ConfigurationError(
                "origin", "nothing", "latitude_deg and longitude_deg, since points are in degrees"
            )
        if not pairs:
            return []
        north, east = geodesy.to_ned(self.origin, *zip(*pairs, strict=True))
        placed = list(zip(north.tolist(), east.tolist(), strict=True))
        for number, (x, y) in enumerate(placed):
            if math.hypot(x, y) > FARTHEST:
                latitude, longitude = pairs[number]
                found = f"[{latitude:g}, {longitude:g}], {math.hypot(x, y) / 1e3:.0f} km from the origin"
                expected = f"[latitude, longitude] within {FARTHEST / 1e3:g} km"
                raise ConfigurationError(place(number), found, expected)
        return placed

    def read(self, name: str, use: Use, feature: str | None = None, take_depths: bool = True) -> Given:
        """Place the points for `use` of a waypoint file in the mission file's folder.

        Args:
            name: of the file.
            use: purpose of the points; only waypoints have depths.
            feature: name of the shape to take.
            take_depths: whether depths of the file count.

        Raises:
            ConfigurationError: it is elsewhere, missing, not understood, or does not fit; names the feature.
        """
        relative = PurePosixPath(name)
        if relative.is_absolute() or ".." in relative.parts:
            expected = "one in the mission file's own folder, so that the two stay together"
            raise ConfigurationError("file", repr(name), expected)
        path = self.folder / relative
        if not Path(os.path.realpath(path)).is_relative_to(os.path.realpath(self.folder)):
            # Messages quote files: a link must not make them quote an arbitrary file of the machine.
            expected = "a file in the mission file's own folder, not a link that leads out of it"
            raise ConfigurationError("file", repr(name), expected)
        with within("file", joined=": "):
            if path not in self.files:
                self.files[path] = waypoint_files.read(path, name)
            content = self.files[path]
            with within(name, joined=": "):
                taken = waypoint_files.choose(content, use, feature, take_depths)
                points = taken.points
                if content.in_degrees:
                    points = self._placed(points, lambda k: f"point {k + 1}")
                else:
                    _check_metres(points)
                keep = waypoint_files.kept(points, taken.depths)
        if len(keep) < len(points):
            self.note(f"{name}: {len(points) - len(keep)} point(s) at the place of the one before left out")
        self.note(*(f"{name}: {notice}" for notice in taken.notices))
        depths = None if taken.depths is None else [taken.depths[k] for k in keep]
        return Given([points[k] for k in keep], taken.outline, depths)

    def note(self, *notices: str) -> None:
        """Add notices; each is kept once, as a line that is safe to print."""
        for notice in map(printable, notices):
            if notice not in self.notices:
                self.notices.append(notice)

    def given(
        self,
        items: Sequence[Sequence[float]] | None,
        file: str | None,
        feature: str | None,
        key: str,
        use: Use,
        take_depths: bool = True,
    ) -> Given:
        """Return the points of a key, or of the file given instead.

        Raises:
            ConfigurationError: both are given or neither is; a point is wrong.
        """
        if (items is None) == (file is None):
            found = f"neither {key} nor file" if file is None else f"both {key} and file"
            raise ConfigurationError("", found, "one of them")
        if file is not None:
            return self.read(file, use, feature, take_depths)
        if feature is not None:
            raise ConfigurationError("feature", f"{feature!r} without file", "both")
        listed = items or ()
        with within(key, joined=""):
            if len(listed) > MOST_POINTS:
                raise ConfigurationError("", f"{len(listed)} points", f"at most {MOST_POINTS}")
            points, depths = self.places(listed if take_depths else [item[:2] for item in listed])
            return Given(points, False, depths)


def check_size(item: Any, place: str = "") -> None:
    """Refuse a number above `LARGEST`, anywhere in the file."""
    if dataclasses.is_dataclass(item):
        for field in dataclasses.fields(item):
            check_size(getattr(item, field.name), f"{place}.{field.name}" if place else field.name)
    elif isinstance(item, tuple):
        for number, part in enumerate(item):
            check_size(part, f"{place}[{number}]")
    elif isinstance(item, (int, float)) and abs(item) > LARGEST:
        raise ConfigurationError(place, f"{item:g}", f"at most {LARGEST:g}")


def _check_metres(points: Sequence[Point]) -> None:
    for number, point in enumerate(points, start=1):
        if max(map(abs, point)) > LARGEST:
            found = f"north {point[0]:g}, east {point[1]:g}"
            raise ConfigurationError(f"point {number}", found, f"metres, at most {LARGEST:g}")


@contextmanager
def within(key: str, joined: str = ".") -> Iterator[None]:
    """Prefix the place of a `ConfigurationError` with `key`."""
    try:
        yield
    except ConfigurationError as error:
        if error.where == "origin":  # a place of its own
            raise
        parts = [key, error.where] if error.where not in ("", key) else [key]
        separator = "" if error.where.startswith("[") else joined
        raise ConfigurationError(separator.join(parts), error.found, error.expected) from None
