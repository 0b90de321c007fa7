"""ailos_guidance: follow the mission's path with virtual point, subpath switching and a guidance law."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following import vehicle
from auv_path_following.guidance.approach import ApproachWatch
from auv_path_following.guidance.failsafe.descent import DescentWatch
from auv_path_following.guidance.path_follower import distance_to_go
from auv_path_following.missions import mission_file
from auv_path_following.nodes.mission_course import course_of
from auv_path_following.nodes.mission_keeper import MissionKeeper
from auv_path_following.nodes.navigation_input import Inputs, NavigationInput
from auv_path_following.parameters import GuidanceParameters


class GuidanceNode(SuiteNode):
    """Answer every odometry with one set of references; keep the mission's state."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.GUIDANCE, GuidanceParameters, **arguments)
        hull = vehicle.load(self.parameters.vehicle)
        self.mission = mission_file.load(self.parameters.mission, hull)
        self._course = course_of(self.mission, hull)
        self.keeper = MissionKeeper(self, self._course, self._begins)
        self._to_go = self._course.path.length
        self._approach, self._descent = ApproachWatch(), DescentWatch()
        self._messages = self._course.messages(self)
        path = self.advertise(topics.PATH)
        self.close_gate()
        self._input = NavigationInput(self, self._step, self.keeper.restart, True, self._course.with_altitude)
        self.keeper.offer()
        path.publish(self._course.message(self.get_clock().now().nanoseconds))
        for notice in self.mission.notices:
            self.get_logger().info(notice)
        self.keeper.take_switching()
        self.keeper.report.publish(self.keeper.state.mission)

    def configure(self) -> None:
        self.keeper.configure()
        self._input.odometry.configure()

    def waiting_for(self) -> str:
        return self.gate_waits_for() or ", ".join(self._input.missing)

    def report(self) -> dict[str, Any]:
        values = self.keeper.report.values()
        if (output := self._messages.output) is not None:
            values |= {"s": f"{output.s:.3f}", "ye [m]": f"{output.ye:.3f}", "phase": self._approach.phase}
        return values

    def _begins(self, by_request: bool) -> None:
        self._approach = ApproachWatch()
        if by_request:
            self._input.odometry.reset_gate()

    def _step(self, inputs: Inputs) -> None:
        p, has_water = self.parameters, inputs.water is not None
        late = not has_water and inputs.water_age > p.water_velocity_timeout
        self.health.warn("water", f"no fresh {topics.WATER_VELOCITY.name}" if late else "")
        measured = self._course.measured(inputs, self._to_go, self.now())
        dt = 0.0 if self.keeper.state.begins else inputs.dt
        output, thrust = self.keeper.step(measured, inputs.current, inputs.dt)
        late = thrust > 0.0 and inputs.current_age > p.current_timeout
        self.health.warn("current", f"no fresh {topics.CURRENT_ESTIMATE.name}" if late else "")
        self.health.warn("altitude", self._course.warning(self.keeper.state.follower))
        depth, _ = self._course.depth_and_heading(inputs.navigation)
        self.health.warn("sinking", self._descent.update(p.diving, depth, thrust))
        if thrust > 0.0 and has_water:
            if text := self._approach.update(output.approach, dt):
                self.get_logger().info(text)
            self.health.warn("approach", self._approach.complaint(p.guidance.approach.overdue))
        self._to_go = distance_to_go(self._course.path, self.keeper.state.follower)
        self._messages.fill(output, thrust, self._to_go, inputs.stamp)
        self.answer(self._publish)

    def _publish(self) -> None:
        self._messages.publish()
        self.keeper.report.publish(self.keeper.state.mission)
        self.keeper.report.answered(self.keeper.report.word is MissionState.RUNNING)


def main(args: Sequence[str] | None = None) -> int:
    """The executable `ailos_guidance`."""
    return run_nodes([GuidanceNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
