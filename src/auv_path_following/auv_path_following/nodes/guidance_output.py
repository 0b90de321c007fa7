"""What guidance publishes: its path, and its result for each odometry, as the contract's messages."""

from __future__ import annotations

from typing import Any

from rclpy.clock import Clock, ClockType
from std_msgs.msg import String

from auv_msgs_py import topics
from auv_msgs_py.conversions import PATH_FRAME, fill_pose, path_message, set_stamp
from auv_msgs_py.frames import flip_yaw
from auv_msgs_py.mission_word import PERIOD, TIMES
from auv_msgs_py.runtime import SuiteNode
from auv_msgs_py.wire import Float64, PoseStamped, Vector3Stamped
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.paths.composite import CompositePath

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


class StateMessages:
    """Publish the mission's state as `mission_word` says: a new one twice, any once every `PERIOD`.

    Free running by wall time, because a state must come when the ROS clock stands still. In lockstep by
    mission time and as part of an answer, so that a run has the same messages each time.

    Args:
        node: whose publisher it is.
    """

    def __init__(self, node: SuiteNode) -> None:
        self._node = node
        self._publisher = node.advertise(topics.MISSION_STATE)
        self._lockstep = bool(node.parameters.lockstep)
        self._word = ""
        self._said = 0.0
        if not self._lockstep:
            node.create_timer(PERIOD, self._publish, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def tell(self, word: str) -> None:
        """Publish a new state."""
        self._word = word
        for _ in range(TIMES):
            self._publish()

    def answered(self, running: bool) -> None:
        """An odometry was answered.

        In lockstep an answer without thrust is always followed by the state: the simulator waits for it.
        """
        if self._lockstep and (not running or abs(self._node.now() - self._said) >= PERIOD):
            self._publish()

    def _publish(self) -> None:
        self._said = self._node.now()
        if self._word:
            self._publisher.publish(String(data=self._word))


class GuidanceMessages:
    """Filled and published again and again; what the autopilot waits for goes first.

    Args:
        node: whose publishers they are.
    """

    def __init__(self, node: SuiteNode) -> None:
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

    def fill(self, output: GuidanceOutput, distance_to_go: float, thrust: float, stamp: int) -> None:
        """Take a result in NED.

        Args:
            output: the result.
            distance_to_go: from P to the end of the path, m.
            thrust: desired thrust, N.
            stamp: of the odometry that it answers, ns.
        """
        floats = self._floats
        floats[topics.DESIRED_YAW][1].data = flip_yaw(output.psi_d)
        floats[topics.DESIRED_YAW_RATE][1].data = -output.r_d
        floats[topics.DESIRED_THRUST][1].data = thrust
        floats[topics.PATH_PARAMETER][1].data = output.s
        floats[topics.DISTANCE_TO_GO][1].data = distance_to_go
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
