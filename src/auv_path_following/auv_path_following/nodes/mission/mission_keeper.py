"""The mission in its node: started and aborted by services, held without navigation, reset with time."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from std_srvs.srv import Trigger

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.course import PlanarCourse
from auv_path_following.guidance.approach import empty_approach
from auv_path_following.guidance.failsafe.guard import (
    asked_to_abort,
    held_too_long,
    surfaces,
    without_navigation,
)
from auv_path_following.guidance.guide import (
    Guide,
    at_the_beginning,
    first_state,
    guide,
    reconfigured,
    resume,
    start,
)
from auv_path_following.guidance.path_follower import distance_to_go
from auv_path_following.missions import mission_state as states
from auv_path_following.missions.mission_state import MissionStatus
from auv_path_following.nodes.mission.flown_length import FlownLength
from auv_path_following.nodes.mission.mission_report import MissionReport


class MissionKeeper:
    """Configuration and state of guidance, and their changes by services, parameters and time.

    Args:
        node: ailos_guidance.
        course: the mission and its path.
        begins: called when a mission begins again, with whether a start was requested.
    """

    def __init__(self, node: SuiteNode, course: PlanarCourse, begins: Callable[[bool], None]) -> None:
        self._node, self._course, self._begins = node, course, begins
        self.config = self._prepared()
        self.state = first_state(self.config, empty_approach())
        self._last_usable: float | None = None
        self._place, self._placed_at = (0.0, 0.0), -math.inf
        self._clock_went_back = False
        #: Length of path that is left after the last step, the rest of an approach included, m.
        self.to_go: float = course.path.length
        #: Whether a mission was taken that has not begun yet.
        self._is_new = False
        self.report = MissionReport(node)
        self._describe()

    def take(self, course: PlanarCourse) -> None:
        """Take another mission; it begins with the next start, or when the operator's hold ends."""
        self._course, self._is_new, self.to_go = course, True, course.path.length
        self.config = self._prepared()
        self.state = at_the_beginning(self.config, self.state.mission, empty_approach())
        self._describe()

    @property
    def refuses_missions(self) -> str:
        """Why no other mission can be taken now; empty where one can."""
        mission = self.state.mission
        is_free = not states.is_under_way(mission) or states.is_held(mission)
        return "" if is_free else f"a change while a mission is {states.STATES[mission.state].value}"

    @property
    def next_service(self) -> str:
        """Name of the service that begins the mission."""
        return topics.RESUME_SERVICE if states.is_under_way(self.state.mission) else topics.START_SERVICE

    def offer(self) -> None:
        """Offer the services, and start the watchdog of navigation."""
        self._node.create_service(Trigger, topics.HOLD_SERVICE, self._on_hold)
        self._node.create_service(Trigger, topics.RESUME_SERVICE, self._on_resume)
        self._node.create_service(Trigger, topics.START_SERVICE, self._on_start)
        self._node.create_service(Trigger, topics.ABORT_SERVICE, self._on_abort)
        if not self._node.parameters.lockstep:
            self._node.every(0.1, self._watch)

    def configure(self) -> None:
        """Take the node's parameters; keep the place on the path."""
        self.config = self._prepared()
        self.state = reconfigured(self.config, self.state)

    def step(self, measured: Any, current: Any, dt: float) -> tuple[Any, float]:
        """Take one measurement, see `guide`; return the follower's result and the desired thrust, N."""
        self._place, self._placed_at = self._course.depth_and_heading(measured.navigation), measured.now
        jumps = self.state.rejoins or self.state.begins or measured.moved
        self.state, output, thrust, has_resumed = guide(
            self.config, self._course.rows, self.state, measured, current, dt
        )
        self.to_go = distance_to_go(self._course.path, self.config.follower.progress, self.state.follower)
        self._count(measured.now, jumps or has_resumed or thrust == 0.0 or output.approach > 0.0)
        if measured.has_water or surfaces(self.state.guard):
            self._last_usable = measured.now
        if has_resumed:
            self.report.resumed(self.config.hold_after)
        return output, thrust

    def restart(self) -> None:
        """Begin again after stamps that went back, but not if only the vehicle's clock was set back."""
        went_back = self._clock_went_back or self._node.now() < (self._last_usable or 0.0)
        if self._node.parameters.lockstep or went_back:
            self._begin(False)
        self._clock_went_back = False

    def _prepared(self) -> Guide:
        return self._course.prepare(self._node.parameters)

    def _on_start(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        before, self.state = self.state, start(self.config, self.state)
        response.success = self.state is not before
        if response.success:
            self._begin(True)
        self.report.publish(self.state.mission)
        response.message = self.report.reason if response.success else f"already {self.report.word}"
        return response

    def _on_hold(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        before = self.state.mission
        self._become(states.held(before))
        response.success = states.is_held(self.state.mission)
        is_new = response.success and not states.is_held(before)
        response.message = self.report.reason if is_new else f"already {self.report.word}"
        return response

    def _on_resume(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        if not states.is_held(self.state.mission):
            response.message = f"{self.report.word}: no hold that the service hold began"
        elif self._is_blind:
            response.message = "no usable navigation"
        else:
            self.state = resume(self.state)
            if self._is_new:
                self._begin(True)
            self.report.publish(self.state.mission)
            response.success, response.message = True, self.report.reason
        return response

    @property
    def _is_blind(self) -> bool:
        """Whether navigation is missing for longer than a mission runs without it."""
        since = self._node.now() - (self._last_usable if self._last_usable is not None else math.inf)
        return not self._node.parameters.lockstep and since > self.config.hold_after

    def _on_abort(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        mission, before = self.state.mission, self.state.guard
        guard, mission = asked_to_abort(self.config.guard, before, mission, self._place)
        self.state = self.state._replace(guard=guard)
        self._become(mission)
        ends = self.report.word is MissionState.ABORTED or surfaces(guard)
        response.success, response.message = ends, self.report.reason
        return response

    def _begin(self, by_request: bool) -> None:
        """Go to the beginning of the path, after a start or a restart of time."""
        self.state = at_the_beginning(self.config, self.state.mission, empty_approach())
        self._last_usable, self._clock_went_back, self._is_new = None, False, False
        self._describe()
        self._begins(by_request)

    def _describe(self) -> None:
        """Begin a report of the course's mission."""
        self._flown = FlownLength(self._course.path.length)
        place = self._node.parameters.start_at
        self.report.describe(self._course.mission, self._course.path.length, place)

    def _count(self, now: float, jumps: bool) -> None:
        """Count what was flown up to the measurement of `now`, s."""
        report = self.report
        if report.begun_at is None and self.state.mission.state == states.RUNNING:
            report.begins(now)
        self._flown.update(self.to_go, jumps)
        report.flown = self._flown.share

    def _watch(self) -> None:
        """Hold a mission without usable navigation, and end one that holds for too long."""
        now, mission, guard = self._node.now(), self.state.mission, self.state.guard
        if self._last_usable is None or now < self._last_usable:
            self._clock_went_back = self._last_usable is not None
            self._last_usable = now
        if now - self._last_usable > self.config.hold_after:
            guard, mission = without_navigation(guard, mission, self.config.hold_after, now)
        mission = states.waited(mission, self._node.parameters.holding.abort_after, now)
        if mission.state == states.ABORTED and self.state.mission.state == states.HOLDING:
            place = self._place if now - self._placed_at < self.config.hold_after else None
            guard, mission = held_too_long(self.config.guard, guard, mission, place)
        if surfaces(guard) and not surfaces(self.state.guard):
            self._last_usable = now
        self.state = self.state._replace(guard=guard)
        self._become(mission)

    def _become(self, mission: MissionStatus) -> None:
        self.state = self.state._replace(mission=mission)
        self.report.publish(mission)
