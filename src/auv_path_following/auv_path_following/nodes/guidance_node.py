"""ailos_guidance: follows the mission's path with virtual point, subpath switching and AILOS."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from auv_msgs_py import topics
from auv_msgs_py.runtime import SuiteNode, run_nodes
from auv_path_following import vehicle
from auv_path_following.guidance.approach import ApproachWatch, agility_of
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.guidance.limits import Limits
from auv_path_following.guidance.mission_state import MissionState, State
from auv_path_following.guidance.path_follower import PathFollower
from auv_path_following.nodes.guidance_output import GuidanceMessages, StateMessages, whole_path
from auv_path_following.nodes.navigation_input import Inputs, NavigationInput
from auv_path_following.parameters import GuidanceParameters
from auv_path_following.paths import mission_file


class GuidanceNode(SuiteNode):
    """Answers every odometry with one set of references; keeps the mission's state."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.GUIDANCE, GuidanceParameters, **arguments)
        hull = vehicle.load(self.parameters.vehicle)
        self.mission = mission_file.load(self.parameters.mission, hull)
        agility = agility_of(hull, self.mission.thrust)
        self.follower = PathFollower(self.mission.path, self.parameters.guidance, agility)
        self.state = MissionState(self.parameters.holding)
        self.limits = Limits(self.parameters.limits.stricter(self.mission.limits), self.mission.geofence)
        self._told: State | None = None
        self._output: GuidanceOutput | None = None
        self._last_usable: float | None = None
        self._rejoining = self._clock_went_back = self._begins = False
        self._approach = ApproachWatch()
        #: Time without usable navigation, by the odometry's stamps, s.
        self._blind = 0.0
        self._messages = GuidanceMessages(self)
        self._mission_state = StateMessages(self)
        self._path = self.advertise(topics.PATH)
        self.close_gate()
        self._input = NavigationInput(self, self._step, self._restart, with_current=True)
        self.create_service(Trigger, topics.START_SERVICE, self._on_start)
        self.create_service(Trigger, topics.ABORT_SERVICE, self._on_abort)
        if not self.parameters.lockstep:
            self.every(0.1, self._watch)
        self._path.publish(whole_path(self.mission.path, self.get_clock().now().nanoseconds))
        for notice in self.mission.notices:
            self.get_logger().info(notice)
        self._take_wishes()
        self._tell()

    def _take_wishes(self) -> None:
        """The mission's switching becomes the parameters', where everybody can see and change it."""
        wished = self.parameters.with_wishes_of(self.mission).guidance.switching
        if wished != self.parameters.guidance.switching:
            self.set_parameters(
                [
                    Parameter("guidance.switching.mode", value=wished.mode),
                    Parameter("guidance.switching.radius", value=wished.radius),
                ]
            )

    def configure(self) -> None:
        self.follower.configure(self.parameters.guidance)
        self.state.config = self.parameters.holding
        self.limits.config = self.parameters.limits.stricter(self.mission.limits)
        self._input.odometry.configure()

    def waiting_for(self) -> str:
        return self.gate_waits_for() or ", ".join(self._input.missing)

    def report(self) -> dict[str, Any]:
        values = {"mission_state": self.state.state.value, "reason": self.state.reason}
        if self._output is not None:
            values |= {"s": f"{self._output.s:.3f}", "ye [m]": f"{self._output.ye:.3f}"}
            values["phase"] = self._approach.phase
        return values

    def _on_start(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success = self.state.start()
        if response.success:
            self._begin()
            self._input.odometry.believe_anew()
        response.message = self.state.reason if response.success else f"already {self.state.state.value}"
        self._tell()
        return response

    def _on_abort(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self.state.abort("abort was called")
        response.success = self.state.state is State.ABORTED
        response.message = self.state.reason
        self._tell()
        return response

    def _begin(self) -> None:
        """At the beginning of the path, and only when asked to start or when time itself began again."""
        self.follower.reset()
        self.limits.reset()
        self._last_usable, self._rejoining, self._clock_went_back = None, False, False
        self._approach, self._blind = ApproachWatch(), 0.0
        self._begins = True

    def _restart(self) -> None:
        """The odometry's stamps went back. If the clock did not, only the vehicle's clock was set: go on."""
        if self.parameters.lockstep or self._clock_went_back or self.now() < (self._last_usable or 0.0):
            self._begin()
        self._clock_went_back = False

    def _watch(self) -> None:
        now = self.now()
        if self._last_usable is None or now < self._last_usable:
            self._clock_went_back = self._last_usable is not None
            self._last_usable = now
        self._hold_after(now - self._last_usable)
        self.state.tick(now)
        self._tell()

    def _hold_after(self, blind: float) -> None:
        """Hold if there has been no usable navigation for `blind` seconds, and that is too long."""
        if blind > self.state.config.hold_after:
            why = self.health.last_refusal
            reason = f"no usable navigation for {self.state.config.hold_after:g} s"
            self.state.navigation_lost(f"{reason} ({why})" if why else reason, self.now())

    def _look_for_gap(self, dt: float, usable: bool) -> None:
        """Hold after a gap between stamps as after one in time: which is noticed first must not matter."""
        self._blind += dt
        if not self.parameters.lockstep:
            self._hold_after(self._blind)
            self._tell()
        if usable:
            self._blind = 0.0

    def _step(self, inputs: Inputs) -> None:
        navigation, water = inputs.navigation, inputs.water
        begins, self._begins = self._begins, False
        dt = 0.0 if begins else inputs.dt
        self._rejoining = (self._rejoining or inputs.moved) and not begins
        self._look_for_gap(dt, water is not None)
        late = water is None and inputs.water_age > self.parameters.water_velocity_timeout
        self.health.warn("water", f"no fresh {topics.WATER_VELOCITY.name}" if late else "")
        if water is not None:
            self._last_usable = self.now()
            self._rejoining = self._rejoining or self.state.state is State.HOLDING
            self.state.navigation_back()
        late = self.state.running and inputs.current_age > self.parameters.current_timeout
        self.health.warn("current", f"no fresh {topics.CURRENT_ESTIMATE.name}" if late else "")
        if self.state.running and water is not None:
            if self._rejoining:
                self.follower.rejoin(navigation)
                self.limits.rest()
            output = self.follower.update(navigation, water, inputs.current, 0.0 if self._rejoining else dt)
            self._rejoining = False
            if news := self._approach.update(output.approach, dt):
                self.get_logger().info(news)
            self.health.warn("approach", self._approach.complaint(self.parameters.guidance.approach.overdue))
            to_go = self.follower.distance_to_go
            broken = self.limits.broken(navigation, output.xe, output.ye, to_go, dt)
            if output.finished:
                self.state.complete()
        else:
            output = self.follower.look(navigation)
            to_go = self.follower.distance_to_go
            broken = self.limits.wait(dt) if self.state.under_way else ""
        if broken and self.state.under_way:
            self.state.abort(broken)
        self._output = output
        self._messages.fill(output, to_go, self.mission.thrust if self.state.running else 0.0, inputs.stamp)
        self.answer(self._publish)

    def _publish(self) -> None:
        self._messages.publish()
        self._tell()
        self._mission_state.answered(self.state.running)

    def _tell(self) -> None:
        """Publish the state when it has changed."""
        if self.state.state is self._told:
            return
        self._told = self.state.state
        stopped = self._told in (State.HOLDING, State.ABORTED)
        self.health.error("mission", "")
        self.health.error("mission", f"{self._told.value}: {self.state.reason}" if stopped else "", log=False)
        self._mission_state.tell(self._told.value)
        self.get_logger().info(f"{self._told.value}: {self.state.reason}")


def main(args: Sequence[str] | None = None) -> int:
    """The executable `ailos_guidance`."""
    return run_nodes([GuidanceNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
