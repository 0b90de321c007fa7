"""Messages of guidance: the path, and the result for each odometry."""

from __future__ import annotations

import math
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import PATH_FRAME, fill_pose, path_message, set_stamp
from auv_msgs_py.contract.spatial_conversions import fill_error, fill_spatial_pose, spatial_path_message
from auv_msgs_py.contract.wire import Float64, PoseStamped, Vector3Stamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_point import tangent_of
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.nodes.readings import PLANAR, SPATIAL, Readings

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

    _wire: Readings = PLANAR

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
        for topic, value in zip(self._wire.references, self._wire.sent(output, thrust), strict=True):
            floats[topic][1].data = value
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


def whole_spatial_path(path: SpatialPath, stamp: int) -> Any:
    """Return a path with depths as the message `path`.

    Args:
        path: the mission's.
        stamp: ns.
    """
    spacing = max(_PATH_SPACING, path.length / _PATH_POSES)
    rows = []
    for i, subpath in enumerate(path.subpaths):
        n = max(1, math.ceil(subpath.length / spacing))
        for k in range(n + (i + 1 == path.n)):
            point = path.evaluate(i, k / n)
            along = tangent_of(point)
            rows.append(((point.x, point.y, point.z), along.gamma, along.chi))
    return spatial_path_message(rows, stamp)


class SpatialGuidanceMessages(GuidanceMessages):
    """The messages of one step of a vehicle that dives, reused."""

    _wire = SPATIAL

    def __init__(self, node: SuiteNode) -> None:
        super().__init__(node)
        self._floats |= {
            topic: (node.advertise(topic), Float64())
            for topic in (topics.DESIRED_PITCH, topics.DESIRED_PITCH_RATE, topics.DESIRED_DEPTH)
        }
        self._error_3d, self._errors = node.advertise(topics.PATH_ERROR_3D), Vector3Stamped()

    def fill(self, output: Any, thrust: float, to_go: float, stamp: int) -> None:
        """Write a `SpatialOutput` into the messages; arguments as those of `GuidanceMessages.fill`."""
        super().fill(output, thrust, to_go, stamp)
        place = (output.x_p, output.y_p, output.z_p)
        fill_spatial_pose(self._pose, place, output.gamma_p, output.chi_p, stamp)
        fill_error(self._errors, (output.xe, output.ye, output.ze), stamp)

    def publish(self) -> None:
        """Publish all messages."""
        super().publish()
        self._error_3d.publish(self._errors)
