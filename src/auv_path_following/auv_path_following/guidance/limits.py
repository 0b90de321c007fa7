"""The limits of a mission: where it may go, how far off, how long, how slowly. No ROS, no clock."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections import deque
from collections.abc import Sequence
from typing import Generic, TypeVar

from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import Navigation

Point = tuple[float, float]
T = TypeVar("T")

#: Into so many chords a window is divided: a circle is no standstill, noise no way.
_CHORDS = 6


@settings
class LimitsConfig:
    """What ends a mission. 0 is no limit; of parameters and mission file the stricter counts."""

    path_distance: float = setting(
        0.0, "largest distance from the virtual point, once the vehicle was within it; 0: any", unit="m",
        ge=0.0, live=True,
    )  # fmt: skip
    duration: float = setting(0.0, "longest mission; 0: any", unit="s", ge=0.0, live=True)
    ground_speed: float = setting(
        0.0, "lowest speed over ground; 0: any. Below it the current is too strong to make way", unit="m/s",
        ge=0.0, live=True,
    )  # fmt: skip
    ground_speed_window: float = setting(
        30.0, "over so much time the speed over ground is taken", unit="s", ge=2.0, le=3600.0, live=True
    )
    path_speed: float = setting(
        0.0,
        "lowest speed of the virtual point along the path, once it has come as far as that in one window;"
        " 0: any. Below it the vehicle moves, but does not follow",
        unit="m/s",
        ge=0.0,
        live=True,
    )
    path_speed_window: float = setting(
        60.0, "over so much time the speed along the path is taken", unit="s", ge=2.0, le=3600.0, live=True
    )

    def stricter(self, other: LimitsConfig) -> LimitsConfig:
        """Both hold; a window comes with the higher speed."""
        ground = other if other.ground_speed > self.ground_speed else self
        along = other if other.path_speed > self.path_speed else self
        return dataclasses.replace(
            self,
            path_distance=_stricter(self.path_distance, other.path_distance),
            duration=_stricter(self.duration, other.duration),
            ground_speed=ground.ground_speed,
            ground_speed_window=ground.ground_speed_window,
            path_speed=along.path_speed,
            path_speed_window=along.path_speed_window,
        )


def _stricter(one: float, other: float) -> float:
    return min(one, other) if one and other else one or other


class _Marks(Generic[T]):
    """A quantity, and the time, at the corners of the chords into which the last seconds are divided."""

    def __init__(self) -> None:
        self.rest()

    def rest(self) -> None:
        """Nothing is known of the time before."""
        self._marks: deque[tuple[float, T]] = deque(maxlen=_CHORDS + 1)
        self._time = 0.0

    def take(self, value: T, dt: float, window: float) -> tuple[float, list[T]]:
        """The time between the first and the last corner, and all of them, the oldest first.

        Whenever a chord has ended and the window is full; else (0, none).
        """
        self._time += dt
        if self._marks and self._time - self._marks[-1][0] < window / _CHORDS:
            return 0.0, []
        if dt > window:  # nothing was heard for so long
            self.rest()
        self._marks.append((self._time, value))
        if len(self._marks) <= _CHORDS:
            return 0.0, []
        return self._time - self._marks[0][0], [value for _, value in self._marks]


class Limits:
    """Asked once per step of a running mission; constant in time.

    Args:
        config: the limits.
        geofence: corners (north, east), m, of the area that must not be left; empty for no geofence.
    """

    def __init__(self, config: LimitsConfig | None = None, geofence: Sequence[Point] = ()) -> None:
        self.config = config or LimitsConfig()
        self.geofence = tuple(geofence)
        self._places: _Marks[Point] = _Marks()
        self._to_go: _Marks[float] = _Marks()
        self.reset()

    def reset(self) -> None:
        """A mission begins."""
        self.elapsed = 0.0
        self._been_near = False
        self._most_to_go = -math.inf
        self._has_followed = False
        self.rest()

    def rest(self) -> None:
        """The vehicle was stopped: its speeds are measured anew."""
        self._places.rest()
        self._to_go.rest()

    def wait(self, dt: float) -> str:
        """Time passes in a mission that holds; the reason why it must end, or an empty text."""
        self.elapsed += dt
        longest = self.config.duration
        if not longest or self.elapsed <= longest:
            return ""
        return f"limit duration: {self.elapsed:.1f} s, at most {longest:g} s"

    def broken(self, navigation: Navigation, xe: float, ye: float, to_go: float, dt: float) -> str:
        """The reason why the mission must end, or an empty text.

        Args:
            navigation: where the vehicle is, NED.
            xe, ye: its place as seen from the virtual point, m.
            to_go: path from the virtual point to the end, m.
            dt: seconds since the last call.
        """
        c, x, y = self.config, navigation.x, navigation.y
        if too_long := self.wait(dt):
            return too_long
        if c.path_distance:
            off_path = math.hypot(xe, ye)
            if off_path <= c.path_distance:
                self._been_near = True
            elif self._been_near:
                return f"limit path_distance: {off_path:.1f} m from the path, at most {c.path_distance:g} m"
        if self.geofence and not inside(self.geofence, x, y):
            return f"limit geofence: left at north {x:.1f} m, east {y:.1f} m"
        return self._too_slow_over_ground(x, y, dt) or self._too_slow_along(to_go, dt)

    def _too_slow_over_ground(self, x: float, y: float, dt: float) -> str:
        least, window = self.config.ground_speed, self.config.ground_speed_window
        if not least:
            return ""
        time, marks = self._places.take((x, y), dt, window)
        way = sum(math.dist(a, b) for a, b in itertools.pairwise(marks))
        return _too_slow("ground_speed", way, time, least) if marks else ""

    def _too_slow_along(self, to_go: float, dt: float) -> str:
        least, window = self.config.path_speed, self.config.path_speed_window
        if not least:
            return ""
        self._most_to_go = max(self._most_to_go, to_go)
        if not self._has_followed:
            self._has_followed = self._most_to_go - to_go >= least * window
            return ""
        time, marks = self._to_go.take(to_go, dt, window)
        return _too_slow("path_speed", marks[0] - marks[-1], time, least) if marks else ""


def _too_slow(limit: str, way: float, time: float, least: float) -> str:
    speed = way / time
    return f"limit {limit}: {speed:.2f} m/s over {time:.1f} s, at least {least:g} m/s" * (speed < least)


def inside(polygon: Sequence[Point], x: float, y: float) -> bool:
    """Whether a point is in a polygon (corners in order, closed by itself): even-odd rule."""
    result = False
    for (ax, ay), (bx, by) in zip(polygon, (*polygon[1:], polygon[0]), strict=True):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            result = not result
    return result
