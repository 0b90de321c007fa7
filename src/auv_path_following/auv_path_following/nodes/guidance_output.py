"""Messages of guidance: the path, and the result for each odometry."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import PATH_FRAME, fill_pose, path_message, set_stamp
from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.contract.wire import Float64, PoseStamped, Vector3Stamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.curves.composite import CompositePath
from auv_path_following.guidance.follow import GuidanceOutput

#: Distance between the poses of `path`, m.
_PATH_SPACING = 1.0
#: Most poses of `path`; a longer path has larger steps.
_PATH_POSES = 20_000


def whole_path(path: CompositePath, stamp: int) -> Any:
    """Return a path as the message `path`.

    Args:
        path: the mission's.
        stamp: ns.
    """
    points = (path.at(float(s)) for s in path.polyline(max(_PATH_SPACING, path.length / _PATH_POSES))[2])
    return path_message([(point.x, point.y, point.chi) for point in points], stamp)


class GuidanceMessages:
    """The messages of one step, reused; those that the autopilot waits for go first.

    Args:
        node: ailos_guidance.

    Attributes:
        output: the latest result.
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
        """Write a result (NED) into the messages.

        Args:
            output: the result.
            thrust: desired thrust, N.
            to_go: length of path to the end, m.
            stamp: of the answered odometry, ns.
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
        """Publish all messages."""
        for publisher, message in self._floats.values():
            publisher.publish(message)
        self._virtual_point.publish(self._pose)
        self._path_error.publish(self._error)
