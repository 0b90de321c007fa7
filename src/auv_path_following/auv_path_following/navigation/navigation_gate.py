"""Gate for odometry: refuse jumps, impossible rates and a frozen pose. ROS-free."""

from __future__ import annotations

import enum
import math
from collections import deque
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.types import Navigation


@settings
class NavigationGateConfig:
    """Bounds of plausible odometry. In lockstep the gate rests, as all watchdogs do."""

    enabled: bool = setting(True, "refuse odometry that no vehicle could have produced", live=True)
    current: float = setting(
        2.5, "largest current: the vehicle's top speed and this bound its speed over ground", unit="m/s",
        ge=0.0, le=10.0, live=True,
    )  # fmt: skip
    yaw_rate: float = setting(2.5, "largest plausible yaw rate", unit="rad/s", gt=0.0, live=True)
    position_margin: float = setting(
        5.0, "largest jump of a position: a fix corrects dead reckoning", unit="m", ge=0.0, live=True
    )  # fmt: skip
    heading_margin: float = setting(0.35, "largest jump of a heading", unit="rad", ge=0.0, live=True)
    accept_after: float = setting(
        3.0, "measurements at a new place that agree for this long are accepted", unit="s", ge=0.1, le=600.0,
        live=True,
    )  # fmt: skip
    frozen_after: float = setting(
        2.0, "an identical pose, to the last bit, for this long under way is refused", unit="s", ge=0.1,
        le=600.0, live=True,
    )  # fmt: skip


#: Largest lag of the motion indication behind the pose, s.
_LAG = 0.5


#: Time over which drift is bounded, s, and number of marks in it.
_WINDOW = 5.0
_MARKS = 10


class Passed(enum.Enum):
    """What to do with a measurement."""

    ACCEPTED = "accepted"
    REFUSED = "refused"
    MOVED = "moved"


class Judgement(NamedTuple):
    """Decision and, for a refusal or a move, what was found and what was expected."""

    passed: Passed
    found: str = ""
    expected: str = ""


_ACCEPTED = Judgement(Passed.ACCEPTED)


class _Mark(NamedTuple):
    """Position and heading turned so far at a time; s, m, rad."""

    time: float
    x: float
    y: float
    heading: float


class _Track:
    """Consecutive positions that one vehicle can have measured.

    Each measurement has a margin for noise and corrections, and the last `_WINDOW` s have twice this margin.
    So noise is always accepted, and a position that drifts away is refused even if each step is small.

    Args:
        top_speed: through the water, m/s.
        first: first measurement.
    """

    def __init__(self, top_speed: float, first: Navigation) -> None:
        self._top_speed = top_speed
        self.last = first
        self._since = 0.0
        self._turned = 0.0
        self._time = self._heading = 0.0
        self._marks: deque[_Mark] = deque([_Mark(0.0, first.x, first.y, 0.0)])

    def wait(self, dt: float) -> None:
        """Let `dt` s pass without an accepted position."""
        self._since += dt
        self._time += dt

    def turn_unseen(self, turn: float) -> None:
        """Add a turn (rad) by the measured yaw rate while positions are refused."""
        self._turned += turn

    def add(self, navigation: Navigation) -> None:
        """Append an accepted position."""
        self._heading += self._turned + self._turn_to(navigation)
        self.last = navigation
        self._since = self._turned = 0.0
        marks = self._marks
        if self._time - marks[-1].time >= _WINDOW / _MARKS:
            marks.append(_Mark(self._time, navigation.x, navigation.y, self._heading))
            while marks[1].time <= self._time - _WINDOW:
                marks.popleft()

    def wrong(self, navigation: Navigation, c: NavigationGateConfig, unseen: float) -> Judgement | None:
        """Return why the track cannot continue here, or None; it may have turned for `unseen` s."""
        if abs(navigation.r) > c.yaw_rate:
            found = f"a yaw rate of {navigation.r:.3g} rad/s"
            return Judgement(Passed.REFUSED, found, f"at most {c.yaw_rate:g} rad/s")
        speed = self._top_speed + c.current
        jump = math.hypot(navigation.x - self.last.x, navigation.y - self.last.y)
        allowed = c.position_margin + speed * self._since
        if jump > allowed:
            found = f"a position {jump:.1f} m from the last accepted one"
            return Judgement(Passed.REFUSED, found, f"at most {allowed:.1f} m after {self._since:.2f} s")
        turn = abs(self._turn_to(navigation))
        allowed = c.heading_margin + c.yaw_rate * unseen
        if turn > allowed:
            found = f"a heading {math.degrees(turn):.0f} deg from the last accepted one"
            return Judgement(Passed.REFUSED, found, f"at most {math.degrees(allowed):.0f} deg")
        return self._runs_away(navigation, c, speed)

    def _turn_to(self, navigation: Navigation) -> float:
        return wrap(navigation.psi - self.last.psi - self._turned)

    def _runs_away(self, navigation: Navigation, c: NavigationGateConfig, speed: float) -> Judgement | None:
        mark = self._marks[0]
        seconds = self._time - mark.time
        way = math.hypot(navigation.x - mark.x, navigation.y - mark.y)
        allowed = 2.0 * c.position_margin + speed * seconds
        if way > allowed:
            found = f"a position that moved {way:.1f} m in {seconds:.1f} s"
            return Judgement(Passed.REFUSED, found, f"at most {allowed:.1f} m")
        turn = abs(self._heading + self._turned + self._turn_to(navigation) - mark.heading)
        allowed = 2.0 * c.heading_margin + c.yaw_rate * seconds
        if turn > allowed:
            found = f"a heading that turned {math.degrees(turn):.0f} deg in {seconds:.1f} s"
            return Judgement(Passed.REFUSED, found, f"at most {math.degrees(allowed):.0f} deg")
        return None


class NavigationGate:
    """Compare each measurement with the accepted ones before it.

    A jump is refused, and so are the measurements after it, until they continue the accepted track again, or
    have agreed among themselves for `accept_after`. Then the vehicle is at the new place (`MOVED`), and
    everything derived from the old place must be discarded.

    A pose that repeats to the last bit while the vehicle is under way is refused until it changes or until a
    `reset`.

    Args:
        config: bounds.
        top_speed: of the vehicle through the water, m/s.
    """

    def __init__(self, config: NavigationGateConfig, top_speed: float) -> None:
        self.config = config
        self.top_speed = top_speed
        self.reset()

    def reset(self) -> None:
        """Forget all measurements; the next one is the first."""
        self._accepted: _Track | None = None
        self._other: _Track | None = None
        self._agreed = 0.0
        self._still = 0.0

    def judge(self, navigation: Navigation, dt: float, under_way: bool) -> Judgement:
        """Judge a measurement.

        Args:
            navigation: what was measured, NED.
            dt: time since the last measurement, accepted or not, s.
            under_way: whether another source says that the vehicle moves.
        """
        if not self.config.enabled:
            self.reset()
            return _ACCEPTED
        accepted = self._accepted
        if accepted is None:
            wrong = _Track(self.top_speed, navigation).wrong(navigation, self.config, 0.0)
        else:
            accepted.wait(dt)
            wrong = accepted.wrong(navigation, self.config, dt + self._still)
        if wrong is None:
            return self._moving_or_frozen(navigation, dt, under_way)
        if accepted is not None and abs(navigation.r) <= self.config.yaw_rate:
            accepted.turn_unseen(navigation.r * dt)
        if not self._agrees(navigation, dt):
            return wrong
        self._start_track(navigation)
        return Judgement(Passed.MOVED, wrong.found, wrong.expected)

    def _agrees(self, navigation: Navigation, dt: float) -> bool:
        """Return whether the refused measurements have agreed for `accept_after`."""
        other = self._other
        if other is not None:
            other.wait(dt)
            if other.wrong(navigation, self.config, dt) is None:
                other.add(navigation)
                self._agreed += dt
                return self._agreed >= self.config.accept_after
        self._other, self._agreed = _Track(self.top_speed, navigation), 0.0
        return False

    def _start_track(self, navigation: Navigation) -> None:
        """Begin the accepted track, at a first measurement or a new place."""
        self._accepted, self._other = _Track(self.top_speed, navigation), None
        self._agreed = self._still = 0.0

    def _moving_or_frozen(self, navigation: Navigation, dt: float, under_way: bool) -> Judgement:
        self._other, self._agreed = None, 0.0
        if self._accepted is None:
            self._start_track(navigation)
            return _ACCEPTED
        if navigation[:3] != self._accepted.last[:3]:
            self._accepted.add(navigation)
            self._still = 0.0
            return _ACCEPTED
        # A standstill that began under way counts until the pose changes, even if the vehicle stops.
        if under_way or self._still > _LAG:
            self._still += dt
        else:
            self._accepted.add(navigation)
            self._still = 0.0
        if self._still >= self.config.frozen_after:
            return Judgement(Passed.REFUSED, f"the same pose for {self._still:.1f} s under way", "a new one")
        return _ACCEPTED
