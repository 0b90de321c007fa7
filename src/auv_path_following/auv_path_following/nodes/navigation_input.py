"""Odometry and velocity through water (and, for guidance, the current estimate) as one input.

In lockstep the messages of one step are paired by stamp. Otherwise the odometry triggers, and the newest
other messages are used unless they are older than a bound: the vehicle never waits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import stamp_of
from auv_msgs_py.contract.frames import FrameTable
from auv_msgs_py.contract.pairing import Pairing
from auv_msgs_py.contract.spatial_conversions import altitude_from
from auv_msgs_py.contract.stamps import StampGuard, StampVerdict
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.contract.wire import Odometry, TwistWithCovarianceStamped, Vector3Stamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import MessageRefused
from auv_path_following import vehicle
from auv_path_following.nodes.odometry_intake import OdometryIntake
from auv_path_following.nodes.readings import readings_of


class Inputs(NamedTuple):
    """Input of one step. `water` is None where no fresh value is known; `dt` in s, `stamp` in ns.

    `water_age`, `current_age`: s; before the first message, time since the first odometry.
    `moved`: whether this navigation does not continue the last one.
    `altitude`: range to the bottom along body z, m; NaN where no fresh one is known.
    """

    navigation: Any
    water: Any | None
    water_age: float
    current: Any
    current_age: float
    dt: float
    stamp: int
    moved: bool
    altitude: float = math.nan


#: Speed through the water above which the vehicle is under way, m/s: at less it may rest over ground.
_UNDER_WAY = 0.3


class NavigationInput:
    """Subscribe, convert and pair.

    Args:
        node: the node; its parameters are `NavigationParameters` with `water_velocity_timeout`.
        step: called once per odometry.
        restart: called when time went back, before the step.
        with_current: whether to include the current estimate.
        with_altitude: whether to include the range to the bottom.
    """

    def __init__(
        self,
        node: SuiteNode,
        step: Callable[[Inputs], None],
        restart: Callable[[], None],
        with_current: bool = False,
        with_altitude: bool = False,
    ) -> None:
        self._node = node
        self._step = step
        self._restart = restart
        self._lockstep: bool = node.parameters.lockstep
        self._frames = FrameTable(node.parameters.frames)
        self.odometry = OdometryIntake(node)
        hull = vehicle.load(node.parameters.vehicle)
        self._readings = readings_of(hull)
        self._fastest = hull.top_speed + node.parameters.gate.current
        further = [topics.CURRENT_ESTIMATE] * with_current + [topics.ALTITUDE] * with_altitude
        self._order = {topic: StampGuard() for topic in (topics.WATER_VELOCITY, *further)}
        self._with_current, self._with_altitude = with_current, with_altitude
        self._pairing = Pairing((topics.ODOM.name, *(topic.name for topic in self._order)), strict=True)
        self._first: int | None = None
        self._water: tuple[Any, int] | None = None
        self._current: tuple[Any, int] | None = None
        self._altitude: tuple[float, int] | None = None
        node.listen(topics.ODOM, self._on_odometry)
        node.listen(topics.WATER_VELOCITY, self._on_water)
        if with_current:
            node.listen(topics.CURRENT_ESTIMATE, self._on_current)
        if with_altitude:
            node.listen(topics.ALTITUDE, self._on_altitude)
        elif with_current and self._lockstep and hull.dives:
            # A simulator with an altimeter waits for all readers of the table, whatever the mission needs.
            node.listen(topics.ALTITUDE, _leave_out)

    @property
    def missing(self) -> tuple[str, ...]:
        """Topics that the current step lacks, in lockstep."""
        return self._pairing.missing

    def _on_odometry(self, message: Odometry) -> None:
        navigation, dt, stamp, restarted, moved = self.odometry.take(message)
        if restarted or self._first is None:
            self._first = stamp
        if restarted:
            if not self._lockstep:
                self._water = self._current = self._altitude = None
                for guard in self._order.values():
                    guard.reset()
            self._restart()
        if self._lockstep:
            if self._pairing.put(topics.ODOM.name, (navigation, dt, stamp), stamp):
                self._paired()
            return
        water, current = None, self._readings.no_current
        # A message that has never come is as old as the first odometry, so at the start none is late.
        water_age = age = (stamp - self._first) * 1e-9
        if self._water is not None:
            water_age = abs(stamp - self._water[1]) * 1e-9
            if water_age <= self._node.parameters.water_velocity_timeout:
                water = self._water[0]
                self.odometry.under_way = water.ur > _UNDER_WAY
        if self._current is not None:
            current, age = self._current[0], (stamp - self._current[1]) * 1e-9
        altitude = math.nan
        if self._altitude is not None:
            late = abs(stamp - self._altitude[1]) * 1e-9 > self._node.parameters.water_velocity_timeout
            altitude = math.nan if late else self._altitude[0]
        self._step(Inputs(navigation, water, water_age, current, age, dt, stamp, moved, altitude))

    def _in_order(self, topic: Topic, stamp: int) -> None:
        """Refuse, free running, a message that a newer one has overtaken."""
        if not self._lockstep and self._order[topic].judge(stamp).verdict is StampVerdict.REFUSE:
            raise MessageRefused(topic.name, "a stamp that is not newer than the last", "rising stamps")

    def _is_plausible(self, velocity: tuple[float, ...]) -> bool:
        """Return whether no component of a velocity exceeds what vehicle and current can have."""
        return all(abs(part) <= self._fastest for part in velocity)

    def _on_water(self, message: TwistWithCovarianceStamped) -> None:
        topic = topics.WATER_VELOCITY.name
        water = self._readings.water(message, self._frames, topic)
        if not self._is_plausible(water):
            found = f"({', '.join(f'{part:.3g}' for part in water)}) m/s"
            raise MessageRefused(topic, found, f"at most {self._fastest:.3g} m/s")
        stamp = stamp_of(message.header.stamp, topic)
        self._in_order(topics.WATER_VELOCITY, stamp)
        self._water = water, stamp
        if self._lockstep and self._pairing.put(topic, water, stamp):
            self._paired()

    def _on_current(self, message: Vector3Stamped) -> None:
        topic = topics.CURRENT_ESTIMATE.name
        current = self._readings.current(message, topic)
        if not self._is_plausible(current):
            found = f"({', '.join(f'{part:.3g}' for part in current)}) m/s"
            raise MessageRefused(topic, found, f"at most {self._fastest:.3g} m/s")
        stamp = stamp_of(message.header.stamp, topic)
        self._in_order(topics.CURRENT_ESTIMATE, stamp)
        self._current = current, stamp
        if self._lockstep and self._pairing.put(topic, current, stamp):
            self._paired()

    def _on_altitude(self, message: Any) -> None:
        topic = topics.ALTITUDE.name
        altitude, stamp = altitude_from(message, topic), stamp_of(message.header.stamp, topic)
        self._in_order(topics.ALTITUDE, stamp)
        self._altitude = altitude, stamp
        if self._lockstep and self._pairing.put(topic, altitude, stamp):
            self._paired()

    def _paired(self) -> None:
        (navigation, dt, stamp), water, *rest = self._pairing.take()
        current = rest[0] if self._with_current else self._readings.no_current
        altitude = rest[-1] if self._with_altitude else math.nan
        self._step(Inputs(navigation, water, 0.0, current, 0.0, dt, stamp, False, altitude))


def _leave_out(_: Any) -> None:
    """Take a message that the mission does not need."""
