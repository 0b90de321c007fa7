"""The limits of a mission: where it may go, how far off, how long, how slowly. No ROS, no clock."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections import deque
from collections.abc import Sequence

from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import Navigation

Point = tuple[float, float]

#: Into so many chords the window of the lowest speed is divided: a circle is no standstill, noise no way.
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
        30.0, "over so much time the speed over ground is taken", unit="s", gt=0.0, le=3600.0, live=True
    )

    def stricter(self, other: LimitsConfig) -> LimitsConfig:
        """Both hold; the window comes with the higher speed."""
        faster = other if other.ground_speed > self.ground_speed else self
        return dataclasses.replace(
            self,
            path_distance=_stricter(self.path_distance, other.path_distance),
            duration=_stricter(self.duration, other.duration),
            ground_speed=faster.ground_speed,
            ground_speed_window=faster.ground_speed_window,
        )


def _stricter(one: float, other: float) -> float:
    return min(one, other) if one and other else one or other


class Limits:
    """Asked once per step of a running mission; constant in time.

    Args:
        config: the limits.
        geofence: corners (north, east), m, of the area that must not be left; empty for no geofence.
    """

    def __init__(self, config: LimitsConfig | None = None, geofence: Sequence[Point] = ()) -> None:
        self.config = config or LimitsConfig()
        self.geofence = tuple(geofence)
        self.reset()

    def reset(self) -> None:
        """A mission begins."""
        self.elapsed = 0.0
        self._been_near = False
        self.rest()

    def rest(self) -> None:
        """The vehicle was stopped: the speed over ground is measured anew."""
        self._marks: deque[Point] = deque(maxlen=_CHORDS + 1)
        self._mark_age = 0.0

    def broken(self, navigation: Navigation, xe: float, ye: float, dt: float) -> str:
        """The reason why the mission must end, or an empty text.

        Args:
            navigation: where the vehicle is, NED.
            xe, ye: its place as seen from the virtual point, m.
            dt: seconds since the last call.
        """
        c, x, y = self.config, navigation.x, navigation.y
        self.elapsed += dt
        if c.duration and self.elapsed > c.duration:
            return f"limit duration: {self.elapsed:.1f} s, at most {c.duration:g} s"
        if c.path_distance:
            off_path = math.hypot(xe, ye)
            if off_path <= c.path_distance:
                self._been_near = True
            elif self._been_near:
                return f"limit path_distance: {off_path:.1f} m from the path, at most {c.path_distance:g} m"
        if self.geofence and not inside(self.geofence, x, y):
            return f"limit geofence: left at north {x:.1f} m, east {y:.1f} m"
        return self._too_slow(x, y, dt) if c.ground_speed else ""

    def _too_slow(self, x: float, y: float, dt: float) -> str:
        c = self.config
        self._mark_age += dt
        if self._marks and self._mark_age < c.ground_speed_window / _CHORDS:
            return ""
        if self._marks and self._mark_age > c.ground_speed_window:  # nothing is known about this time
            self.rest()
        self._marks.append((x, y))
        self._mark_age = 0.0
        if len(self._marks) <= _CHORDS:
            return ""
        marks = list(self._marks)
        way = sum(math.dist(a, b) for a, b in itertools.pairwise(marks))
        speed = way / c.ground_speed_window
        if speed >= c.ground_speed:
            return ""
        return (
            f"limit ground_speed: {speed:.2f} m/s over {c.ground_speed_window:g} s,"
            f" at least {c.ground_speed:g} m/s"
        )


def inside(polygon: Sequence[Point], x: float, y: float) -> bool:
    """Whether a point is in a polygon (corners in order, closed by itself): even-odd rule."""
    result = False
    for (ax, ay), (bx, by) in zip(polygon, (*polygon[1:], polygon[0]), strict=True):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            result = not result
    return result
