"""Publication of the mission's state and status, with the reason in the log and the diagnostics."""

from __future__ import annotations

import math

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.clock import Clock, ClockType
from std_msgs.msg import String

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import PERIOD, TIMES, MissionState
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.missions.mission_file import Mission
from auv_path_following.missions.mission_state import (
    HOLDING,
    NAVIGATION_LOST,
    STATES,
    MissionStatus,
    Reason,
    is_surfacing,
    words,
)

_LEVELS: dict[MissionState | None, bytes] = {
    MissionState.HOLDING: DiagnosticStatus.WARN,
    MissionState.ABORTED: DiagnosticStatus.ERROR,
}


class MissionReport:
    """Publish the mission's state as `mission_word` requires: a new state twice, any state every `PERIOD`.

    Free running by wall time, so that the state is also published when the ROS clock stands still. In
    lockstep by mission time and as part of an answer, so that each run has the same messages.

    Args:
        node: ailos_guidance.
    """

    def __init__(self, node: SuiteNode) -> None:
        self._node = node
        self._publisher = node.advertise(topics.MISSION_STATE)
        self._status = node.advertise(topics.MISSION_STATUS)
        self._status_at = -math.inf
        self._facts: dict[str, str] = {}
        #: Stamp of the first odometry of the mission, s; None before it.
        self.begun_at: float | None = None
        #: Flown share of the path.
        self.flown = 0.0
        self._lockstep = bool(node.parameters.lockstep)
        self.word: MissionState | None = None
        self._cause = -1
        self.reason = self._detail = ""
        self._published = 0.0
        if not self._lockstep:
            node.create_timer(PERIOD, self._publish, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def describe(self, mission: Mission, length: float, place: str) -> None:
        """Take the mission that is reported from now on.

        Args:
            mission: for its name and digest.
            length: of its path, m.
            place: of the path at which it begins, as the parameter `start_at` names it.
        """
        self._facts = {"mission": mission.name, "digest": mission.digest, "length [m]": f"{length:.3f}"}
        self._facts["start at"] = place
        self.begun_at, self.flown = None, 0.0
        if self.word is not None:
            self._publish_status(self._node.now())

    def begins(self, stamp: float) -> None:
        """Take the first odometry of the mission, s."""
        self.begun_at = stamp
        self._publish_status(self._node.now())

    def values(self) -> dict[str, str]:
        """Return state and reason, for the diagnostics."""
        return {"mission_state": str(self.word or ""), "reason": self.reason}

    def publish(self, mission: MissionStatus) -> None:
        """Publish the state if it, or its cause, has changed."""
        word, cause = STATES[mission.state], mission.reason.cause
        if word is self.word and cause == self._cause:
            return
        self._cause = cause
        health = self._node.health
        if word is MissionState.HOLDING:
            self._detail = health.refusals.latest
        surfaces = is_surfacing(mission)
        self.word, self.reason = word, "surfacing: " * surfaces + words(mission.reason, self._detail)
        stopped = surfaces or word in (MissionState.HOLDING, MissionState.ABORTED)
        health.error("mission", "")
        health.error("mission", f"{word.value}: {self.reason}" if stopped else "", log=False)
        self._status_at = -math.inf
        for _ in range(TIMES):
            self._publish()
        self._node.get_logger().info(f"{word.value}: {self.reason}")

    def resumed(self, hold_after: float) -> None:
        """Publish a hold that only a gap between two measurements has shown."""
        if self.word is MissionState.RUNNING:
            self.publish(MissionStatus(HOLDING, Reason(NAVIGATION_LOST, 0.0, 0.0, hold_after)))

    def answered(self, running: bool) -> None:
        """Publish the state as part of the answer to an odometry, if it is due.

        In lockstep the state follows every answer without thrust: the simulator waits for it.
        """
        if self._lockstep and (not running or abs(self._node.now() - self._published) >= PERIOD):
            self._publish()

    def _publish(self) -> None:
        now = self._published = self._node.now()
        if self.word is None:
            return
        self._publisher.publish(String(data=self.word.value))
        # In lockstep a state without thrust is published with every answer; its status once a second.
        if abs(now - self._status_at) >= PERIOD or not self._lockstep:
            self._publish_status(now)

    def _publish_status(self, now: float) -> None:
        self._status_at = now
        self._status.publish(self.status())

    def status(self) -> DiagnosticStatus:
        """Return the message `mission_status`."""
        begun = "" if self.begun_at is None else f"{self.begun_at:.9f}"
        values = {"state": str(self.word or ""), "reason": self.reason, **self._facts}
        values |= {"begun at [s]": begun, "flown share": f"{self.flown:.6f}"}
        return DiagnosticStatus(
            level=_LEVELS.get(self.word, DiagnosticStatus.OK),
            name="mission",
            message=f"{self.word}: {self.reason}",
            hardware_id=self._node.get_namespace(),
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )
