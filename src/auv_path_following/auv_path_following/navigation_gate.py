"""Which navigation is believed: jumps, impossible rates and a frozen pose are kept out. ROS-free."""

from __future__ import annotations

import enum
import math
from typing import NamedTuple

from auv_msgs_py.angles import wrap
from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import Navigation


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
        3.0, "a new place that agrees with itself for this long is believed", unit="s", gt=0.0, le=600.0,
        live=True,
    )  # fmt: skip
    frozen_after: float = setting(
        2.0, "the same pose to the last bit for this long under way is not believed", unit="s", gt=0.0,
        le=600.0, live=True,
    )  # fmt: skip


#: For so long what says that the vehicle moves may be older than the pose that says it does not, s.
_LAG = 0.5


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


class NavigationGate:
    """Compares each measurement with the last that was believed.

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
        self._last: Navigation | None = None
        self._since = 0.0
        self._other: Navigation | None = None
        self._agreed = 0.0
        self._still = 0.0

    def judge(self, navigation: Navigation, dt: float, under_way: bool) -> Judgement:
        """Take in a measurement.

        Args:
            navigation: what was measured, NED.
            dt: seconds since the last measurement, believed or not.
            under_way: whether the vehicle is known to move.
        """
        self._since += dt
        last = self._last
        if not self.config.enabled:
            self._believe(navigation)
            return _BELIEVED
        if last is None:
            wrong = self._impossible(navigation, navigation, dt, dt)
        else:
            wrong = self._impossible(navigation, last, self._since, dt + self._still)
        if wrong is None:
            return self._moving_or_frozen(navigation, dt, under_way)
        other, self._other = self._other, navigation
        agrees = other is not None and self._impossible(navigation, other, dt, dt) is None
        self._agreed = self._agreed + dt if agrees else 0.0
        if self._agreed < self.config.accept_after:
            return wrong
        self._believe(navigation)
        return Judgement(Passed.MOVED, wrong.found, wrong.expected)

    def _believe(self, navigation: Navigation) -> None:
        self._last, self._other = navigation, None
        self._since = self._agreed = self._still = 0.0

    def _impossible(
        self, navigation: Navigation, before: Navigation, since: float, turning: float
    ) -> Judgement | None:
        """What is wrong if `before` was so long ago; of turning only the time without news counts."""
        c = self.config
        speed = self.top_speed + c.current
        if abs(navigation.r) > c.yaw_rate:
            found = f"a yaw rate of {navigation.r:.3g} rad/s"
            return Judgement(Passed.REFUSED, found, f"at most {c.yaw_rate:g} rad/s")
        jump = math.hypot(navigation.x - before.x, navigation.y - before.y)
        allowed = c.position_margin + speed * since
        if jump > allowed:
            found = f"a position {jump:.1f} m from the last that was believed"
            return Judgement(Passed.REFUSED, found, f"at most {allowed:.1f} m after {since:.2f} s")
        turn = abs(wrap(navigation.psi - before.psi))
        allowed = c.heading_margin + c.yaw_rate * turning
        if turn > allowed:
            found = f"a heading {math.degrees(turn):.0f} deg from the last that was believed"
            return Judgement(Passed.REFUSED, found, f"at most {math.degrees(allowed):.0f} deg")
        return None

    def _moving_or_frozen(self, navigation: Navigation, dt: float, under_way: bool) -> Judgement:
        bound = self.config.frozen_after
        if self._last is None or navigation[:3] != self._last[:3]:
            self._believe(navigation)
            return _BELIEVED
        # What went on under way goes on until the pose changes: somebody else may have stopped the vehicle.
        if under_way or self._still > _LAG:
            self._still += dt
        else:
            self._since = self._still = 0.0
        if self._still >= bound:
            return Judgement(Passed.REFUSED, f"the same pose for {self._still:.1f} s under way", "a new one")
        return _BELIEVED
