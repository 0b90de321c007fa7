"""Gives the commands of the small test, and ends it where it becomes dangerous."""

from __future__ import annotations

import math
from typing import Any

from std_msgs.msg import Float64

from auv_msgs_py.contract import qos
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.types import SPATIAL_STOP, STOP
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.live.listener import VehicleListener
from auv_sim.checks.vehicle_check.samples import OdometrySample, Value
from auv_sim.checks.vehicle_check.wiggle import END, FAREWELL, Wiggle
from auv_sim.checks.vehicle_check.wiggle_dive import END as END_OF_DIVE
from auv_sim.checks.vehicle_check.wiggle_dive import DivingWiggle, danger

#: Longest silence of the odometry, s, and largest distance from the place of the start, m.
_SILENCE, _FAR = 1.0, 100.0
#: Period of the commands while no odometry comes, s.
_PERIOD = 0.1


class SmallTest:
    """The commands of `Wiggle` or `DivingWiggle` to one vehicle, kept in the listener's recording.

    Args:
        listener: of the same vehicle; it does not hear commands itself.
        vehicle: whose limits are kept.

    Attributes:
        cut_short: why the test ended early; empty if it did not.
    """

    def __init__(self, listener: VehicleListener, vehicle: Vehicle) -> None:
        self.cut_short = ""
        self._listener = listener
        self._recording = listener.recording
        self._recording.wiggled = True
        self._vehicle = vehicle
        self._wiggle = Wiggle.of(vehicle)
        self._dive = DivingWiggle(vehicle) if vehicle.dives else None
        self._end = END if self._dive is None else END_OF_DIVE
        self._answered = 0
        self._begin: float | None = None
        self._origin: OdometrySample | None = None
        self._stop: Any = STOP if self._dive is None else SPATIAL_STOP
        self._kept = listener.commands()
        self._publishers = [self._advertise(topic) for topic, _ in self._kept]

    def _advertise(self, topic: Topic) -> Any:
        kind, name = qos.message_class(topic.type), self._listener.name(topic)
        return self._listener.node.create_publisher(kind, name, qos.offered(topic))

    def tick(self) -> bool:
        """Give the next command; return False when the test is over."""
        self._answered = len(self._recording.odom)
        now, odom = self._listener.now(), self._recording.odom
        if self._begin is None:
            self._begin, self._origin = now, odom[-1] if odom else None
        seconds = now - self._begin
        command = self._stop if self.cut_short else self._command(seconds)
        if command != self._stop:
            self.cut_short = self._danger(now)
            command = self._stop if self.cut_short else command
        for publisher, value, (_, values) in zip(self._publishers, command, self._kept, strict=True):
            values.append(Value(now, value))
            publisher.publish(Float64(data=value))
        return seconds < self._end + FAREWELL

    def _command(self, seconds: float) -> Any:
        if self._dive is not None:
            return self._dive.at(seconds, self._recording)
        return self._wiggle.at(seconds)

    def is_due(self) -> bool:
        """Whether the next command is due: an odometry has come, or none for a period."""
        last = self._recording.thrust_cmd[-1].received
        odometry_came = len(self._recording.odom) > self._answered
        return odometry_came or not last <= self._listener.now() < last + _PERIOD

    def _danger(self, now: float) -> str:
        odom = self._recording.odom
        if not odom or now - odom[-1].received > _SILENCE:
            return f"no odometry for {_SILENCE:g} s"
        if self._origin is not None:
            far = math.hypot(odom[-1].x - self._origin.x, odom[-1].y - self._origin.y)
            if far > _FAR:
                return f"{far:.0f} m away from where it began"
            if self._dive is not None:
                return danger(self._recording, self._origin, self._vehicle)
        return ""

    def stop(self) -> None:
        """Send zero commands."""
        for publisher in self._publishers:
            publisher.publish(Float64(data=0.0))
