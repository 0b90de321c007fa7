"""Shows a mission in RViz or Foxglove: markers, transforms, the vehicle's model and its joints.

It polls its topics a few times a second, so it costs the same at any speed of the mission, and nothing waits
for it: without it, or when it dies, the mission is the same.
"""

from __future__ import annotations

import contextlib
import math
import sys
import time
from collections.abc import Sequence
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.frames import FrameTable
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node import params
from auv_msgs_py.node.log_directory import ensure_log_directory
from auv_msgs_py.node.ros_arguments import check_parameter_files
from auv_msgs_py.node.run import EXIT_BAD_INPUT, StopRequest
from auv_msgs_py.node.start_gate import pass_gate
from auv_msgs_py.values.errors import MessageRefused, SuiteError, printable
from auv_path_following import vehicle as vehicles
from auv_path_following.missions import mission_file
from auv_sim.nodes.display import display_topics, markers, transforms
from auv_sim.nodes.display.markers import Place
from auv_sim.nodes.display.robot_model import RUDDER, STERNPLANE, diameter_of, urdf
from auv_sim.sim_parameters import DisplayParameters

#: A joint of the mission file farther from every point of `path` than this is not drawn, m.
_ON_PATH = 1.0
_HEARD = (
    topics.ODOM, topics.PATH, topics.MISSION_STATE, topics.VIRTUAL_POINT, topics.CURRENT_ESTIMATE,
    topics.PATH_ERROR, topics.RUDDER_STATE, topics.GEOFENCE,
)  # fmt: skip


class DisplayNode(Node):  # type: ignore[misc]
    """Publishes what a viewer draws.

    Args:
        arguments: passed on to `rclpy.node.Node`.

    Raises:
        ConfigurationError: a parameter or one of the files that it names.
    """

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.DISPLAY, **arguments)
        names = arguments.get("cli_args") or sys.argv
        p = params.declare(self, DisplayParameters, arguments=names)
        self.period = 1.0 / p.rate
        self._prefix = p.frame_prefix
        self._frames = FrameTable(p.frames)
        self._vehicle = vehicles.load(p.vehicle)
        self._joints = _joints_of(p.mission, self._vehicle) if p.mission else []
        self._newest: dict[Topic, Any] = {}
        spatial = (topics.STERNPLANE_STATE, topics.PATH_ERROR_3D) if self._vehicle.dives else ()
        for topic in (*_HEARD, *spatial):
            self._listen(topic)
        self._markers = self._advertise(display_topics.MARKERS)
        self._live = self._advertise(display_topics.LIVE_MARKERS)
        self._joint_states = self._advertise(display_topics.JOINT_STATES)
        self._advertise(display_topics.ROBOT_DESCRIPTION).publish(
            String(data=urdf(self._vehicle, p.frame_prefix))
        )
        self._transforms = self._transform_publisher() if p.tf else None
        self._drawn: tuple[Any, ...] = ()

    def _advertise(self, topic: Topic) -> Any:
        return self.create_publisher(qos.message_class(topic.type), topic.name, qos.offered(topic))

    def _listen(self, topic: Topic) -> None:
        def keep(message: Any) -> None:
            self._newest[topic] = message

        profile = qos.requested(topic, reliable=False, depth=1)
        self.create_subscription(qos.message_class(topic.type), topic.name, keep, profile)

    def _transform_publisher(self) -> Any:
        """Return the publisher of /tf once /tf_static has its transforms; None without tf2_msgs."""
        try:
            from tf2_msgs.msg import TFMessage
        except ImportError:
            self.get_logger().info("no transforms: tf2_msgs is not installed (ros-jazzy-tf2-msgs)")
            return None
        self._message = TFMessage
        static = Topic("/tf_static", "tf2_msgs/msg/TFMessage", topics.DISPLAY, latched=True)
        self._static = self.create_publisher(TFMessage, static.name, qos.offered(static))
        self._static.publish(TFMessage(transforms=transforms.fixed_transforms(self._prefix)))
        return self.create_publisher(TFMessage, "/tf", 100)

    def tick(self) -> None:
        """Publish what has changed since the last call."""
        self._draw_mission()
        odometry = self._newest.pop(topics.ODOM, None)
        if odometry is None:
            return
        with contextlib.suppress(MessageRefused):  # the control chain reports it
            place, attitude = transforms.pose_of(odometry, self._frames)
            if math.isfinite(sum(place)):
                self._show(odometry.header.stamp, place, attitude)

    def _draw_mission(self) -> None:
        """Publish the latched markers when path or fence are new."""
        sources = tuple(self._newest.get(topic) for topic in (topics.PATH, topics.GEOFENCE))
        if all(new is old for new, old in zip(sources, self._drawn or (None, None), strict=True)):
            return
        self._drawn = sources
        path, fence = sources
        line = [_place(each.pose.position) for each in path.poses] if path else []
        corners = [(each.x, each.y, 0.0) for each in fence.polygon.points] if fence else []
        drawn = markers.mission_markers(line, _on_path(self._joints, line), corners)
        self._markers.publish(MarkerArray(markers=drawn))

    def _show(self, stamp: Any, place: Place, attitude: Any) -> None:
        newest, hull = self._newest, self._vehicle
        shown = [markers.vehicle_marker(place, attitude, hull.length, diameter_of(hull), stamp)]
        if current := newest.get(topics.CURRENT_ESTIMATE):
            shown.append(markers.current_marker(place, _place(current.vector), stamp))
        state = newest[topics.MISSION_STATE].data if topics.MISSION_STATE in newest else ""
        if virtual := newest.get(topics.VIRTUAL_POINT):
            shown.append(markers.virtual_point_marker(place, _place(virtual.pose.position), stamp))
        if error := newest.get(topics.PATH_ERROR):
            spatial = newest.get(topics.PATH_ERROR_3D)
            errors = (error.vector.y, spatial.vector.z) if spatial else (error.vector.y,)
            shown.append(markers.error_marker(place, state, errors, stamp))
        self._live.publish(MarkerArray(markers=shown))
        angles = {
            joint: newest[topic].data
            for joint, topic in ((RUDDER, topics.RUDDER_STATE), (STERNPLANE, topics.STERNPLANE_STATE))
            if topic in newest
        }
        joints = JointState(name=list(angles), position=list(angles.values()))
        joints.header.stamp = stamp
        self._joint_states.publish(joints)
        if self._transforms is not None:
            moving = transforms.moving_transforms(stamp, place, attitude, hull, angles, self._prefix)
            self._transforms.publish(self._message(transforms=moving))


def _place(vector: Any) -> Place:
    return vector.x, vector.y, vector.z


def _joints_of(mission: str, vehicle: vehicles.Vehicle) -> list[tuple[float, float]]:
    """Return the ends of a mission's subpaths, east and north, m."""
    path = mission_file.load(mission, vehicle).path
    return [(point.y, point.x) for point in (path.at(float(k)) for k in range(path.n + 1))]


def _on_path(joints: Sequence[tuple[float, float]], line: Sequence[Place]) -> list[Place]:
    """Return the joints at the depth of the path there; a path of another mission has none of them."""
    found = []
    for east, north in joints:
        nearest = min(line, key=lambda place: math.hypot(place[0] - east, place[1] - north), default=None)
        if nearest is not None and math.hypot(nearest[0] - east, nearest[1] - north) <= _ON_PATH:
            found.append((east, north, nearest[2]))
    return found


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `display`: 0 after a signal, 2 for input that cannot be used."""
    ensure_log_directory()
    stop = StopRequest()
    node = None
    try:
        check_parameter_files(sys.argv if args is None else args)
        if not pass_gate(lambda: stop.requested):
            return 0
        rclpy.init(args=args if args is None else list(args), signal_handler_options=SignalHandlerOptions.NO)
        node = DisplayNode()
        _poll(node, stop)
        return 0
    except (SuiteError, RuntimeError) as error:  # RuntimeError: arguments that ROS does not understand
        print(printable(str(error)), file=sys.stderr)
        return EXIT_BAD_INPUT
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


def _poll(node: DisplayNode, stop: StopRequest) -> None:
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not stop.requested:
        begin = time.monotonic()
        for _ in range(20):  # at most one message for each topic, and a service
            executor.spin_once(timeout_sec=0.0)
        node.tick()
        time.sleep(max(0.0, begin + node.period - time.monotonic()))


if __name__ == "__main__":
    raise SystemExit(main())
