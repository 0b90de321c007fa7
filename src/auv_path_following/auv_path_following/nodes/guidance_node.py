"""ailos_guidance: follow the mission's path with virtual point, subpath switching and a guidance law."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.parameter import Parameter

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.types import NO_CURRENT
from auv_path_following.guidance.approach import ApproachWatch
from auv_path_following.guidance.failsafe.descent import DescentWatch
from auv_path_following.nodes.mission.goal_input import GoalInput
from auv_path_following.nodes.mission.mission_board import MissionBoard
from auv_path_following.nodes.mission.mission_choice import MissionChoice
from auv_path_following.nodes.mission.mission_keeper import MissionKeeper
from auv_path_following.nodes.mission.switching_parameters import SwitchingParameters
from auv_path_following.nodes.navigation_input import NavigationInput
from auv_path_following.nodes.readings import Inputs
from auv_path_following.parameters import GuidanceParameters


class GuidanceNode(SuiteNode):
    """Answer every odometry with one set of references; keep the mission's state."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.GUIDANCE, GuidanceParameters, **arguments)
        self._choice = MissionChoice(self.parameters)
        self._current: Any = NO_CURRENT
        course = self._choice.course
        self.keeper = MissionKeeper(self, course, self._begins)
        self._approach, self._descent = ApproachWatch(), DescentWatch()
        self._messages = course.messages(self)
        self._board = MissionBoard(self)
        self.close_gate()
        listens = course.with_altitude or (course.vehicle.dives and not self.parameters.lockstep)
        self._input = NavigationInput(self, self._step, self.keeper.restart, True, listens)
        self._goal = GoalInput(self, lambda: self._choice.course, lambda: self.keeper.next_service)
        self.keeper.offer()
        self._switching = SwitchingParameters(self)
        self._post()
        self.keeper.report.publish(self.keeper.state.mission)

    def validate(self, proposed: GuidanceParameters) -> None:
        self._choice.propose(proposed, self.keeper.refuses_missions, self._current)

    def configure(self) -> None:
        if self._choice.taken(self.parameters):
            self.keeper.take(self._choice.course)
            self._post()
            return
        self.keeper.configure()
        self._input.odometry.configure()

    def _post(self) -> None:
        """Show the chosen mission, with its notices in the log."""
        course = self._choice.course
        self._board.post(course.mission, course.message(self.get_clock().now().nanoseconds))
        for notice in course.mission.notices:
            self.get_logger().info(notice)
        self._switching.take(course.mission)
        if other := self._choice.empty_again(self.parameters):
            self.set_parameters([Parameter(other, value="")])

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
        measured = self._choice.course.measured(inputs, self.keeper.to_go, self.now())
        self._current = inputs.current
        self._goal.is_at(inputs.navigation)
        dt = 0.0 if self.keeper.state.begins else inputs.dt
        output, thrust = self.keeper.step(measured, inputs.current, inputs.dt)
        late = thrust > 0.0 and inputs.current_age > p.current_timeout
        self.health.warn("current", f"no fresh {topics.CURRENT_ESTIMATE.name}" if late else "")
        course = self._choice.course
        self.health.warn("altitude", course.warning(self.keeper.state.follower))
        depth, _ = course.depth_and_heading(inputs.navigation)
        self.health.warn("sinking", self._descent.update(p.diving, depth, thrust))
        if thrust > 0.0 and has_water:
            if text := self._approach.update(output.approach, dt):
                self.get_logger().info(text)
            self.health.warn("approach", self._approach.complaint(p.guidance.approach.overdue))
        self._messages.fill(output, thrust, self.keeper.to_go, inputs.stamp)
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
