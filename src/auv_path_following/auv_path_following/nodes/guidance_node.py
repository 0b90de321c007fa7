"""ailos_guidance: follows the mission's path with virtual point, subpath switching and a guidance law."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from auv_msgs_py import topics
from auv_msgs_py.runtime import SuiteNode, run_nodes
from auv_msgs_py.types import WaterVelocity
from auv_path_following import vehicle
from auv_path_following.guidance import limits, path_follower
from auv_path_following.guidance import mission_state as states
from auv_path_following.guidance.approach import ApproachWatch, agility_of, empty_approach
from auv_path_following.guidance.guide import (
    Guide,
    Measured,
    at_the_beginning,
    first_state,
    guide,
    prepare,
    reconfigured,
    start,
)
from auv_path_following.guidance.mission_state import Reason, State
from auv_path_following.nodes.guidance_output import GuidanceMessages, MissionReport, whole_path
from auv_path_following.nodes.navigation_input import Inputs, NavigationInput
from auv_path_following.parameters import GuidanceParameters
from auv_path_following.paths import mission_file

_UNKNOWN = WaterVelocity(0.0, 0.0)


class GuidanceNode(SuiteNode):
    """Answers every odometry with one set of references; keeps the mission's state."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.GUIDANCE, GuidanceParameters, **arguments)
        hull = vehicle.load(self.parameters.vehicle)
        self.mission = mission_file.load(self.parameters.mission, hull)
        self._path, self._rows = self.mission.path, self.mission.path.rows
        self._agility = agility_of(hull, self.mission.thrust)
        self.config = self._prepared()
        self.state = first_state(self.config, empty_approach())
        self._approach = ApproachWatch()
        self._last_usable: float | None = None
        self._clock_went_back = False
        self._messages = GuidanceMessages(self)
        self._report = MissionReport(self)
        path = self.advertise(topics.PATH)
        self.close_gate()
        self._input = NavigationInput(self, self._step, self._restart, with_current=True)
        self.create_service(Trigger, topics.START_SERVICE, self._on_start)
        self.create_service(Trigger, topics.ABORT_SERVICE, self._on_abort)
        if not self.parameters.lockstep:
            self.every(0.1, self._watch)
        path.publish(whole_path(self._path, self.get_clock().now().nanoseconds))
        for notice in self.mission.notices:
            self.get_logger().info(notice)
        self._take_mission_switching()
        self._report.tell(self.state.mission)

    def _prepared(self) -> Guide:
        p = self.parameters
        bounds = limits.prepare(p.limits.stricter(self.mission.limits), self.mission.geofence)
        hold_after = math.inf if p.lockstep else p.holding.hold_after
        return prepare(p.guidance, self._agility, self.mission.thrust, hold_after, bounds)

    def _take_mission_switching(self) -> None:
        """Make the mission's switching the parameters', where it can be seen and changed."""
        switching = self.parameters.with_wishes_of(self.mission).guidance.switching
        if switching != self.parameters.guidance.switching:
            self.set_parameters(
                [
                    Parameter("guidance.switching.mode", value=switching.mode),
                    Parameter("guidance.switching.radius", value=switching.radius),
                ]
            )

    def configure(self) -> None:
        self.config = self._prepared()
        self.state = reconfigured(self.config, self.state)
        self._input.odometry.configure()

    def waiting_for(self) -> str:
        return self.gate_waits_for() or ", ".join(self._input.missing)

    def report(self) -> dict[str, Any]:
        values = self._report.values()
        if (output := self._messages.output) is not None:
            values |= {"s": f"{output.s:.3f}", "ye [m]": f"{output.ye:.3f}", "phase": self._approach.phase}
        return values

    def _on_start(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        before, self.state = self.state, start(self.config, self.state)
        response.success = self.state is not before
        if response.success:
            self._begin()
            self._input.odometry.believe_anew()
        self._report.tell(self.state.mission)
        response.message = self._report.reason if response.success else f"already {self._report.word}"
        return response

    def _on_abort(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        aborted = states.aborted(self.state.mission, Reason(states.ABORT_CALLED))
        self.state = self.state._replace(mission=aborted)
        self._report.tell(aborted)
        response.success, response.message = self._report.word == State.ABORTED, self._report.reason
        return response

    def _begin(self) -> None:
        """At the beginning of the path: after a start, or when time itself began again."""
        self.state = at_the_beginning(self.config, self.state.mission, empty_approach())
        self._last_usable, self._clock_went_back, self._approach = None, False, ApproachWatch()

    def _restart(self) -> None:
        """The odometry's stamps went back. If the clock did not, only the vehicle's clock was set: go on."""
        if self.parameters.lockstep or self._clock_went_back or self.now() < (self._last_usable or 0.0):
            self._begin()
        self._clock_went_back = False

    def _watch(self) -> None:
        """Hold a mission that gets no usable navigation, and end one that holds for too long."""
        now, mission = self.now(), self.state.mission
        if self._last_usable is None or now < self._last_usable:
            self._clock_went_back = self._last_usable is not None
            self._last_usable = now
        if now - self._last_usable > self.config.hold_after:
            mission = states.navigation_lost(mission, self.config.hold_after, now)
        mission = states.waited(mission, self.parameters.holding.abort_after, now)
        self.state = self.state._replace(mission=mission)
        self._report.tell(mission)

    def _step(self, inputs: Inputs) -> None:
        p, has_water, now = self.parameters, inputs.water is not None, self.now()
        late = not has_water and inputs.water_age > p.water_velocity_timeout
        self.health.warn("water", f"no fresh {topics.WATER_VELOCITY.name}" if late else "")
        if has_water:
            self._last_usable = now
        water = inputs.water or _UNKNOWN
        measured = Measured(inputs.navigation, water, has_water, inputs.moved, self._to_go(), now)
        self.state, output, thrust, has_resumed = guide(
            self.config, self._rows, self.state, measured, inputs.current, inputs.dt
        )
        if has_resumed:
            self._report.resumed(self.config.hold_after)
        if thrust > 0.0:
            late = inputs.current_age > p.current_timeout
            self.health.warn("current", f"no fresh {topics.CURRENT_ESTIMATE.name}" if late else "")
            if news := self._approach.update(output.approach, inputs.dt):
                self.get_logger().info(news)
            self.health.warn("approach", self._approach.complaint(p.guidance.approach.overdue))
        self._messages.fill(output, thrust, self._to_go(), inputs.stamp)
        self.answer(self._publish)

    def _to_go(self) -> float:
        return path_follower.distance_to_go(self._path, self.state.follower)

    def _publish(self) -> None:
        self._messages.publish()
        self._report.tell(self.state.mission)
        self._report.answered(self.state.mission.state == states.RUNNING)


def main(args: Sequence[str] | None = None) -> int:
    """The executable `ailos_guidance`."""
    return run_nodes([GuidanceNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
