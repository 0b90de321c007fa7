"""Which navigation is believed: jumps, impossible rates and a frozen pose are kept out. ROS-free."""

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
    """What is believed of an odometry. In lockstep the gate rests, as all watchdogs do."""

    enabled: bool = setting(True, "refuse odometry that no vehicle could have produced", live=True)
    current: float = setting(
        2.5, "largest current: the vehicle's top speed and this bound its speed over ground", unit="m/s",
        ge=0.0, le=10.0, live=True,
    )  # fmt: skip
    yaw_rate: float = setting(2.5, "largest yaw rate that is believed", unit="rad/s", gt=0.0, live=True)
    position_margin: float = setting(
        5.0, "a position may jump so far at once: a fix corrects dead reckoning", unit="m", ge=0.0, live=True
    )  # fmt: skip
    heading_margin: float = setting(0.35, "a heading may jump so far at once", unit="rad", ge=0.0, live=True)
    accept_after: float = setting(
        3.0, "a new place that agrees with itself for this long is believed", unit="s", ge=0.1, le=600.0,
        live=True,
    )  # fmt: skip
    frozen_after: float = setting(
        2.0, "the same pose to the last bit for this long under way is not believed", unit="s", ge=0.1,
        le=600.0, live=True,
    )  # fmt: skip


#: For so long what says that the vehicle moves may be older than the pose that says it does not, s.
_LAG = 0.5


#: Over so much time a place must not run away, s, with a mark every so often.
_WINDOW = 5.0
_MARKS = 10


class Passed(enum.Enum):
    """What to do with a measurement."""

    BELIEVED = "believed"
    REFUSED = "refused"
    MOVED = "moved"


class Judgement(NamedTuple):
    """The verdict and, for a refusal or a move, what was found and what was expected."""

    passed: Passed
    found: str = ""
    expected: str = ""


_BELIEVED = Judgement(Passed.BELIEVED)


class _Mark(NamedTuple):
    """Where the vehicle was, and how far it had turned by then; s, m, rad."""

    time: float
    x: float
    y: float
    heading: float


class _Track:
    """What one vehicle can have measured, one place after the other.

    A margin for noise and corrections is granted to each measurement, and twice over the last few seconds:
    so noise is borne for ever, and a place that runs away is found though each of its steps is small.

    Args:
        top_speed: through the water, m/s.
        first: where it begins.
    """

    def __init__(self, top_speed: float, first: Navigation) -> None:
        self._top_speed = top_speed
        self.last = first
        self._since = 0.0
        self._turned = 0.0
        self._time = self._heading = 0.0
        self._marks: deque[_Mark] = deque([_Mark(0.0, first.x, first.y, 0.0)])

    def wait(self, dt: float) -> None:
        """Time passes."""
        self._since += dt
        self._time += dt

    def turn_unseen(self, turn: float) -> None:
        """By its yaw rate the vehicle has turned so far (rad) while its place was not believed."""
        self._turned += turn

    def add(self, navigation: Navigation) -> None:
        """It went on to here."""
        self._heading += self._turned + self._turn_to(navigation)
        self.last = navigation
        self._since = self._turned = 0.0
        marks = self._marks
        if self._time - marks[-1].time >= _WINDOW / _MARKS:
            marks.append(_Mark(self._time, navigation.x, navigation.y, self._heading))
            while marks[1].time <= self._time - _WINDOW:
                marks.popleft()

    def wrong(self, navigation: Navigation, c: NavigationGateConfig, unseen: float) -> Judgement | None:
        """Why it cannot have gone on to here; None if it can. It may have turned unseen for `unseen` s."""
        if abs(navigation.r) > c.yaw_rate:
            found = f"a yaw rate of {navigation.r:.3g} rad/s"
            return Judgement(Passed.REFUSED, found, f"at most {c.yaw_rate:g} rad/s")
        speed = self._top_speed + c.current
        jump = math.hypot(navigation.x - self.last.x, navigation.y - self.last.y)
        allowed = c.position_margin + speed * self._since
        if jump > allowed:
            found = f"a position {jump:.1f} m from the last that was believed"
            return Judgement(Passed.REFUSED, found, f"at most {allowed:.1f} m after {self._since:.2f} s")
        turn = abs(self._turn_to(navigation))
        allowed = c.heading_margin + c.yaw_rate * unseen
        if turn > allowed:
            found = f"a heading {math.degrees(turn):.0f} deg from the last that was believed"
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
    """Compares each measurement with those that were believed before.

    A jump is refused, and so is all that follows it, until the measurements are back where they can be
    believed, or have agreed among themselves for `accept_after`: then the vehicle is where they say
    (`MOVED`), and what was derived from the old place has to be forgotten.

    A pose that repeats itself to the last bit while the vehicle is under way is refused until it changes, or
    until somebody vouches for it with a `reset`.

    Args:
        config: bounds.
        top_speed: of the vehicle through the water, m/s.
    """

    def __init__(self, config: NavigationGateConfig, top_speed: float) -> None:
        self.config = config
        self.top_speed = top_speed
        self.reset()

    def reset(self) -> None:
        """The next measurement is a first one."""
        self._believed: _Track | None = None
        self._other: _Track | None = None
        self._agreed = 0.0
        self._still = 0.0

    def judge(self, navigation: Navigation, dt: float, under_way: bool) -> Judgement:
        """Take in a measurement.

        Args:
            navigation: what was measured, NED.
            dt: seconds since the last measurement, believed or not.
            under_way: whether the vehicle is known to move.
        """
        if not self.config.enabled:
            self.reset()
            return _BELIEVED
        believed = self._believed
        if believed is None:
            wrong = _Track(self.top_speed, navigation).wrong(navigation, self.config, 0.0)
        else:
            believed.wait(dt)
            wrong = believed.wrong(navigation, self.config, dt + self._still)
        if wrong is None:
            return self._moving_or_frozen(navigation, dt, under_way)
        if believed is not None and abs(navigation.r) <= self.config.yaw_rate:
            believed.turn_unseen(navigation.r * dt)
        if not self._agrees(navigation, dt):
            return wrong
        self._believe(navigation)
        return Judgement(Passed.MOVED, wrong.found, wrong.expected)

    def _agrees(self, navigation: Navigation, dt: float) -> bool:
        """Whether what was refused has agreed with itself for long enough."""
        other = self._other
        if other is not None:
            other.wait(dt)
            if other.wrong(navigation, self.config, dt) is None:
                other.add(navigation)
                self._agreed += dt
                return self._agreed >= self.config.accept_after
        self._other, self._agreed = _Track(self.top_speed, navigation), 0.0
        return False

    def _believe(self, navigation: Navigation) -> None:
        """A first measurement, or a new place."""
        self._believed, self._other = _Track(self.top_speed, navigation), None
        self._agreed = self._still = 0.0

    def _moving_or_frozen(self, navigation: Navigation, dt: float, under_way: bool) -> Judgement:
        self._other, self._agreed = None, 0.0
        if self._believed is None:
            self._believe(navigation)
            return _BELIEVED
        if navigation[:3] != self._believed.last[:3]:
            self._believed.add(navigation)
            self._still = 0.0
            return _BELIEVED
        # What went on under way goes on until the pose changes: somebody else may have stopped the vehicle.
        if under_way or self._still > _LAG:
            self._still += dt
        else:
            self._believed.add(navigation)
            self._still = 0.0
        if self._still >= self.config.frozen_after:
            return Judgement(Passed.REFUSED, f"the same pose for {self._still:.1f} s under way", "a new one")
        return _BELIEVED
