"""Odometry and velocity through water (and, for guidance, the current estimate) as one input.

In lockstep the messages of one step are paired by stamp. Otherwise the odometry triggers, and the newest
other messages are used unless they are older than a bound: the vehicle never waits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import stamp_of
from auv_msgs_py.contract.frames import FrameTable
from auv_msgs_py.contract.pairing import Pairing
from auv_msgs_py.contract.spatial_conversions import altitude_from
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.contract.wire import Odometry, TwistWithCovarianceStamped, Vector3Stamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import MessageRefused
from auv_path_following import vehicle
from auv_path_following.nodes.newest_values import NewestValues
from auv_path_following.nodes.odometry_intake import OdometryIntake
from auv_path_following.nodes.readings import Inputs, readings_of

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
        beside = (topics.WATER_VELOCITY, *further)
        self._with_current, self._with_altitude = with_current, with_altitude
        self._pairing = Pairing((topics.ODOM.name, *(topic.name for topic in beside)), strict=True)
        self._newest = NewestValues(beside)
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
        if restarted:
            self._newest.reset()
            self._restart()
        if self._lockstep:
            if self._pairing.put(topics.ODOM.name, (navigation, dt, stamp), stamp):
                self._paired()
            return
        self._newest.begin(stamp)
        bound = self._node.parameters.water_velocity_timeout
        water, age = self._newest.at(topics.WATER_VELOCITY, stamp)
        water_age = abs(age)
        if water_age > bound:
            water = None
        if water is not None:
            self.odometry.under_way = water.ur > _UNDER_WAY
        current, age = self._newest.at(topics.CURRENT_ESTIMATE, stamp)
        altitude, late = self._newest.at(topics.ALTITUDE, stamp)
        self._step(
            Inputs(
                navigation, water, water_age, self._readings.no_current if current is None else current, age,
                dt, stamp, moved, math.nan if altitude is None or abs(late) > bound else altitude,
            )
        )  # fmt: skip

    def _take(self, topic: Topic, value: Any, stamp: int) -> None:
        """Pair a value, or keep it as the newest."""
        if not self._lockstep:
            self._newest.put(topic, value, stamp)
        elif self._pairing.put(topic.name, value, stamp):
            self._paired()

    def _check(self, velocity: tuple[float, ...], topic: Topic) -> None:
        """Refuse a velocity of which a component exceeds what vehicle and current can have."""
        if not all(abs(part) <= self._fastest for part in velocity):
            found = f"({', '.join(f'{part:.3g}' for part in velocity)}) m/s"
            raise MessageRefused(topic.name, found, f"at most {self._fastest:.3g} m/s")

    def _on_water(self, message: TwistWithCovarianceStamped) -> None:
        topic = topics.WATER_VELOCITY
        water = self._readings.water(message, self._frames, topic.name)
        self._check(water, topic)
        self._take(topic, water, stamp_of(message.header.stamp, topic.name))

    def _on_current(self, message: Vector3Stamped) -> None:
        topic = topics.CURRENT_ESTIMATE
        current = self._readings.current(message, topic.name)
        self._check(current, topic)
        self._take(topic, current, stamp_of(message.header.stamp, topic.name))

    def _on_altitude(self, message: Any) -> None:
        topic = topics.ALTITUDE
        altitude = altitude_from(message, topic.name)
        self._take(topic, altitude, stamp_of(message.header.stamp, topic.name))

    def _paired(self) -> None:
        (navigation, dt, stamp), water, *rest = self._pairing.take()
        current = rest[0] if self._with_current else self._readings.no_current
        altitude = rest[-1] if self._with_altitude else math.nan
        self._step(Inputs(navigation, water, 0.0, current, 0.0, dt, stamp, False, altitude))


def _leave_out(_: Any) -> None:
    """Take a message that the mission does not need."""
