"""What guidance publishes: its path, and its result for each odometry, as the contract's messages."""

from __future__ import annotations

from typing import Any

from rclpy.clock import Clock, ClockType
from std_msgs.msg import String

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import PATH_FRAME, fill_pose, path_message, set_stamp
from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.contract.mission_word import PERIOD, TIMES, MissionState
from auv_msgs_py.contract.wire import Float64, PoseStamped, Vector3Stamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.curves.composite import CompositePath
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.missions.mission_state import (
    HOLDING,
    NAVIGATION_LOST,
    STATES,
    MissionStatus,
    Reason,
    words,
)

#: Distance between the poses of `path`, m.
_PATH_SPACING = 1.0
#: A path longer than so many metres is published in larger steps.
_PATH_POSES = 20_000


def whole_path(path: CompositePath, stamp: int) -> Any:
    """Return a path as the message `path`.

    Args:
        path: the mission's.
        stamp: ns.
    """
    points = (path.at(float(s)) for s in path.polyline(max(_PATH_SPACING, path.length / _PATH_POSES))[2])
    return path_message([(point.x, point.y, point.chi) for point in points], stamp)


class MissionReport:
    """Publishes the mission's state as `mission_word` says: a new one twice, any once every `PERIOD`.

    Free running by wall time, because a state must come when the ROS clock stands still. In lockstep by
    mission time and as part of an answer, so that a run has the same messages each time.

    Args:
        node: whose publisher, log and diagnostics they are.
    """

    def __init__(self, node: SuiteNode) -> None:
        self._node = node
        self._publisher = node.advertise(topics.MISSION_STATE)
        self._lockstep = bool(node.parameters.lockstep)
        self.word: MissionState | None = None
        self.reason = self._detail = ""
        self._published = 0.0
        if not self._lockstep:
            node.create_timer(PERIOD, self._publish, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def values(self) -> dict[str, str]:
        """State and reason, for the diagnostics."""
        return {"mission_state": str(self.word or ""), "reason": self.reason}

    def publish(self, mission: MissionStatus) -> None:
        """Publish the state where it has changed."""
        word = STATES[mission.state]
        if word is self.word:
            return
        health = self._node.health
        if word is MissionState.HOLDING:
            self._detail = health.refusals.latest
        self.word, self.reason = word, words(mission.reason, self._detail)
        stopped = word in (MissionState.HOLDING, MissionState.ABORTED)
        health.error("mission", "")
        health.error("mission", f"{word.value}: {self.reason}" if stopped else "", log=False)
        for _ in range(TIMES):
            self._publish()
        self._node.get_logger().info(f"{word.value}: {self.reason}")

    def resumed(self, hold_after: float) -> None:
        """Publish that the mission held, if only a gap between two measurements shows it."""
        if self.word is MissionState.RUNNING:
            self.publish(MissionStatus(HOLDING, Reason(NAVIGATION_LOST, 0.0, 0.0, hold_after)))

    def answered(self, running: bool) -> None:
        """Publish the state as part of the answer to an odometry, where it is due.

        In lockstep an answer without thrust is always followed by the state: the simulator waits for it.
        """
        if self._lockstep and (not running or abs(self._node.now() - self._published) >= PERIOD):
            self._publish()

    def _publish(self) -> None:
        self._published = self._node.now()
        if self.word is not None:
            self._publisher.publish(String(data=self.word.value))


class GuidanceMessages:
    """Messages that are filled and published again and again; those that the autopilot waits for go first.

    Args:
        node: whose publishers they are.

    Attributes:
        output: what they were filled with last.
    """

    def __init__(self, node: SuiteNode) -> None:
        self.output: GuidanceOutput | None = None
        self._floats = {
            topic: (node.advertise(topic), Float64())
            for topic in (
                topics.DESIRED_YAW, topics.DESIRED_YAW_RATE, topics.DESIRED_THRUST,
                topics.PATH_PARAMETER, topics.DISTANCE_TO_GO,
            )
        }  # fmt: skip
        self._virtual_point, self._pose = node.advertise(topics.VIRTUAL_POINT), PoseStamped()
        self._path_error, self._error = node.advertise(topics.PATH_ERROR), Vector3Stamped()
        self._error.header.frame_id = PATH_FRAME

    def fill(self, output: GuidanceOutput, thrust: float, to_go: float, stamp: int) -> None:
        """Take a result in NED.

        Args:
            output: the result.
            thrust: desired thrust, N.
            to_go: path to the end, m.
            stamp: of the odometry that it answers, ns.
        """
        self.output, floats = output, self._floats
        floats[topics.DESIRED_YAW][1].data = flip_yaw(output.psi_d)
        floats[topics.DESIRED_YAW_RATE][1].data = -output.r_d
        floats[topics.DESIRED_THRUST][1].data = thrust
        floats[topics.PATH_PARAMETER][1].data = output.s
        floats[topics.DISTANCE_TO_GO][1].data = to_go
        fill_pose(self._pose, output.x_p, output.y_p, output.chi_p, stamp)
        set_stamp(self._error.header.stamp, stamp)
        vector = self._error.vector
        vector.x, vector.y, vector.z = output.xe, output.ye, output.psi_e

    def publish(self) -> None:
        """Send them all."""
        for publisher, message in self._floats.values():
            publisher.publish(message)
        self._virtual_point.publish(self._pose)
        self._path_error.publish(self._error)
