"""manoeuvres: fly a program of manoeuvres within bounds, in place of guidance and autopilot."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from typing import Any

from rclpy.clock import Clock, ClockType

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.contract.spatial_conversions import altitude_from
from auv_msgs_py.contract.wire import Odometry
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SPATIAL_STOP
from auv_path_following import vehicle
from auv_path_following.nodes.odometry_intake import OdometryIntake
from auv_sim.nodes.manoeuvres.manoeuvre_outputs import ManoeuvreOutputs
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_parameters import ManoeuvresParameters
from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import ManoeuvreRun

#: Why a program is over when the node is to stop.
INTERRUPTED = "interrupted"
#: Age of the odometry that ends the program, and period of zeros without odometry, s of wall time.
_SILENCE, _PERIOD = 3.0, 0.1
#: Age of the last altitude up to which it counts, s.
_ALTITUDE_AGE = 2.0
_CONSEQUENCE = "rudder and thrust are 0"


class ManoeuvresNode(SuiteNode):
    """Answers each odometry with commands until the program or a bound ends it; then sends zeros and ends.

    It publishes nothing before it has looked for other publishers, and nothing at all when there is one.
    """

    #: Time for which zeros are sent after the end, s of wall time.
    farewell = 1.5

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.MANOEUVRES, ManoeuvresParameters, **arguments)
        p: ManoeuvresParameters = self.parameters
        if not p.consent:
            raise ConfigurationError(f"{self.get_name()}: consent", "false", "true: the vehicle will move")
        hull = vehicle.load(p.vehicle)
        depth = p.depth if hull.dives else 0.0
        self.run = ManoeuvreRun(hull, program_file.load(p.program), p.bounds, depth)
        self._intake = OdometryIntake(self, _CONSEQUENCE)
        self._outputs = ManoeuvreOutputs(self, hull)
        self._altitude: tuple[float, float] | None = None
        self._heard_at: float | None = None
        self._ended_at: float | None = None
        self._looking_since: float | None = None
        self.listen(topics.ODOM, self._on_odometry)
        if hull.dives:
            self.listen(topics.ALTITUDE, self._on_altitude)
        # By a steady clock: a /clock that stands still must not keep the vehicle under thrust.
        self.create_timer(_PERIOD, self._watch, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def report(self) -> dict[str, Any]:
        return {"program": f"{self.run.progress:.0%}", "ended": self.run.over or "no"}

    def _on_altitude(self, message: Any) -> None:
        altitude = altitude_from(message, topics.ALTITUDE.name)
        if not math.isnan(altitude):
            self._altitude, self.run.sounded = (altitude, self.now()), True

    def _on_odometry(self, message: Odometry) -> None:
        navigation, dt, _, _, moved = self._intake.take(message)
        self._heard_at = time.monotonic()
        if self._ended_at is not None:
            self._outputs.send(SPATIAL_STOP)
            return
        begins = not self.run.begun
        if begins and not self._may_begin():
            return
        if moved and not begins:
            self.run.stop("an odometry that does not continue the last one")
        altitude, heard = self._altitude or (math.nan, 0.0)
        fresh = self.now() - heard < _ALTITUDE_AGE
        command = self.run.step(navigation, dt, altitude if fresh else math.nan)
        self._intake.under_way = command.thrust > 0.0
        if begins and not self.run.over:
            self._outputs.say(MissionState.RUNNING)
        self._outputs.send(command)
        self._end_if_over()

    def _may_begin(self) -> bool:
        """Return whether `look_around` has passed since the first odometry; another publisher ends this node.

        The odometry shows that the discovery of nodes works.
        """
        others = self._outputs.others()
        if others and not self.run.over:
            self.run.stop(others)
            self.fail(f"not begun, nothing was sent: {others}")
        if self.run.over or self._heard_at is None:
            return False
        self._looking_since = self._looking_since or self._heard_at
        return bool(time.monotonic() - self._looking_since >= self.parameters.look_around)

    def _watch(self) -> None:
        """Look for what no odometry shows, repeat the state, and end after the farewell."""
        now = time.monotonic()
        if self._ended_at is not None:
            over = now - self._ended_at > self.farewell
            self._end() if over else self._outputs.send(SPATIAL_STOP)
            return
        if not self.run.begun:
            self._may_begin()
            return
        if self._intake.silent or (self._heard_at is not None and now - self._heard_at > _SILENCE):
            self.run.stop("no usable odometry")
        self.run.stop(self._outputs.others())
        self._end_if_over()
        self._outputs.repeat()

    def _end_if_over(self) -> None:
        if self.run.over and self._ended_at is None:
            self._ended_at = time.monotonic()
            self._outputs.send(SPATIAL_STOP)
            self._outputs.say(MissionState.COMPLETE if self.run.complete else MissionState.ABORTED)
            self.get_logger().info(f"ended: {self.run.over}")

    def _end(self) -> None:
        if self.run.complete or self.run.over == INTERRUPTED:
            self.finished = True
            self.interrupt_spinning()
        elif not self.fault:
            self.fail(f"ended early: {self.run.over}")

    def busy(self) -> bool:
        """End the program, because the node is to stop; return whether zeros are still to be sent."""
        self.run.stop(INTERRUPTED)
        if not self.run.begun:
            return False
        self._end_if_over()
        assert self._ended_at is not None
        return time.monotonic() - self._ended_at <= self.farewell

    def close(self) -> None:
        """Stop the vehicle, whatever ends the node, and send zeros until the farewell is over."""
        while self.busy():
            self._outputs.send(SPATIAL_STOP)
            time.sleep(_PERIOD)


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `manoeuvres`."""
    return run_nodes([ManoeuvresNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
