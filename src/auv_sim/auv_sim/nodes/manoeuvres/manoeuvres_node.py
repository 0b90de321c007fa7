"""manoeuvres: fly a program of manoeuvres within bounds, in place of guidance and autopilot."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from typing import Any

from rclpy.clock import Clock, ClockType
from std_msgs.msg import String

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import PERIOD, TIMES, MissionState
from auv_msgs_py.contract.spatial_conversions import altitude_from
from auv_msgs_py.contract.wire import Float64, Odometry
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.node.watch import second_publishers
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SPATIAL_STOP, SpatialCommand
from auv_path_following import vehicle
from auv_path_following.nodes.odometry_intake import OdometryIntake
from auv_path_following.nodes.readings import readings_of
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_parameters import ManoeuvresParameters
from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import ManoeuvreRun

#: Time for which zeros are sent after the end, and age of the odometry that ends the program, s of wall time.
_FAREWELL, _SILENCE = 1.5, 3.0
#: Age of the last altitude up to which it counts, s.
_ALTITUDE_AGE = 2.0
_CONSEQUENCE = "rudder and thrust are 0"


class ManoeuvresNode(SuiteNode):
    """Answers each odometry with commands until the program or a bound ends it; then sends zeros and ends."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.MANOEUVRES, ManoeuvresParameters, **arguments)
        p: ManoeuvresParameters = self.parameters
        if not p.consent:
            raise ConfigurationError(f"{self.get_name()}: consent", "false", "true: the vehicle will move")
        hull = vehicle.load(p.vehicle)
        self._dives = hull.dives
        depth = p.depth if hull.dives else 0.0
        self.run = ManoeuvreRun(hull, program_file.load(p.program), p.bounds, depth)
        self._intake = OdometryIntake(self, _CONSEQUENCE)
        commands = readings_of(hull).commands
        self._outputs = [(self.advertise(topic), Float64()) for topic in commands]
        self._state = self.advertise(topics.MISSION_STATE)
        self._names = [topic.name for topic in (*commands, topics.MISSION_STATE)]
        self._word, self._repeated = MissionState.IDLE, -math.inf
        self._altitude: tuple[float, float] | None = None
        self._heard_at: float | None = None
        self._ended_at: float | None = None
        self.listen(topics.ODOM, self._on_odometry)
        if hull.dives:
            self.listen(topics.ALTITUDE, self._on_altitude)
        # By a steady clock: a /clock that stands still must not keep the vehicle under thrust.
        self.create_timer(0.1, self._watch, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def report(self) -> dict[str, Any]:
        return {"program": f"{self.run.progress:.0%}", "ended": self.run.over or "no"}

    def _on_altitude(self, message: Any) -> None:
        self._altitude = altitude_from(message, topics.ALTITUDE.name), time.monotonic()

    def _on_odometry(self, message: Odometry) -> None:
        navigation, dt, _, _, moved = self._intake.take(message)
        self._heard_at = time.monotonic()
        if self._ended_at is not None:
            self._send(SPATIAL_STOP)
            return
        if not self.run.begun and (others := self._others()):
            self.run.stop(others)
        elif moved and self.run.begun:
            self.run.stop("an odometry that does not continue the last one")
        altitude, heard = self._altitude or (math.nan, 0.0)
        fresh = time.monotonic() - heard < _ALTITUDE_AGE
        command = self.run.step(navigation, dt, altitude if fresh else math.nan)
        self._intake.under_way = command.thrust > 0.0
        self._send(command)
        self._end_if_over()

    def _watch(self) -> None:
        """Look for what no odometry shows, repeat the state, and end after the farewell."""
        now = time.monotonic()
        if self._ended_at is not None:
            self._send(SPATIAL_STOP)
            if now - self._ended_at > _FAREWELL:
                self._end()
            return
        if self.run.begun:
            if self._intake.silent or (self._heard_at is not None and now - self._heard_at > _SILENCE):
                self.run.stop("no usable odometry")
            self.run.stop(self._others())
        if self.run.over:
            self._send(SPATIAL_STOP)
        self._end_if_over()
        if self.run.begun and now - self._repeated > PERIOD:
            self._say(self._word)

    def _others(self) -> str:
        """Return which commands another node publishes as well, as a text; empty: none."""
        return second_publishers(self, self._names)

    def _send(self, command: SpatialCommand) -> None:
        if self.run.begun and not self.run.over and self._word is MissionState.IDLE:
            self._say(MissionState.RUNNING)
        rudder, planes, thrust = command
        values = (rudder, planes, thrust) if self._dives else (rudder, thrust)
        for (publisher, message), value in zip(self._outputs, values, strict=True):
            message.data = value
            publisher.publish(message)

    def _say(self, word: MissionState) -> None:
        """Publish the state, a new one `TIMES` times: drivers obey no command of a mission that is over."""
        count = TIMES if word is not self._word else 1
        self._word, self._repeated = word, time.monotonic()
        for _ in range(count):
            self._state.publish(String(data=word.value))

    def _end_if_over(self) -> None:
        if self.run.over and self._ended_at is None:
            self._ended_at = time.monotonic()
            self._say(MissionState.COMPLETE if self.run.complete else MissionState.ABORTED)
            self.get_logger().info(f"ended: {self.run.over}")

    def _end(self) -> None:
        if self.run.complete:
            self.finished = True
            self.interrupt_spinning()
        elif not self.fault:
            self.fail(f"ended early: {self.run.over}")

    def close(self) -> None:
        """Stop the vehicle when the node ends, whatever ends it."""
        if self.run.begun:
            self.run.stop("interrupted")
            self._send(SPATIAL_STOP)
            self._end_if_over()


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `manoeuvres`."""
    return run_nodes([ManoeuvresNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
