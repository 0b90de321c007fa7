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
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.frames import FrameTable
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node import params
from auv_msgs_py.node.log_directory import ensure_log_directory
from auv_msgs_py.node.ros_arguments import check_parameter_files
from auv_msgs_py.node.run import EXIT_BAD_INPUT, StopRequest, start_ros
from auv_msgs_py.node.start_gate import pass_gate
from auv_msgs_py.values.errors import MessageRefused, SuiteError, printable
from auv_path_following import vehicle as vehicles
from auv_sim.nodes.display import display_topics, transforms
from auv_sim.nodes.display.drawn_messages import fin_angles, joints_of, mission_drawn, vehicle_drawn
from auv_sim.nodes.display.markers import Place
from auv_sim.nodes.display.robot_model import urdf
from auv_sim.nodes.display.transform_publisher import transform_publisher
from auv_sim.sim_parameters import DisplayParameters


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
        self._frames = FrameTable(p.frames)
        self._vehicle = vehicles.load(p.vehicle)
        self._joints = joints_of(p.mission, self._vehicle) if p.mission else []
        self._newest: dict[Topic, Any] = {}
        spatial = (topics.STERNPLANE_STATE, topics.PATH_ERROR_3D) if self._vehicle.dives else ()
        for topic in (*display_topics.HEARD, *spatial):
            self._listen(topic)
        self._markers = self._advertise(display_topics.MARKERS)
        self._live = self._advertise(display_topics.LIVE_MARKERS)
        self._joint_states = self._advertise(display_topics.JOINT_STATES)
        self._advertise(display_topics.ROBOT_DESCRIPTION).publish(
            String(data=urdf(self._vehicle, p.frame_prefix))
        )
        self._transforms = transform_publisher(self, self._vehicle, p.frame_prefix) if p.tf else None
        self._drawn: tuple[Any, ...] = ()

    def _advertise(self, topic: Topic) -> Any:
        return self.create_publisher(qos.message_class(topic.type), topic.name, qos.offered(topic))

    def _listen(self, topic: Topic) -> None:
        def keep(message: Any) -> None:
            self._newest[topic] = message

        profile = qos.requested(topic, reliable=False, depth=1)
        self.create_subscription(qos.message_class(topic.type), topic.name, keep, profile)

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
        path, fence = sources = self._newest.get(topics.PATH), self._newest.get(topics.GEOFENCE)
        if all(new is old for new, old in zip(sources, self._drawn or (None, None), strict=True)):
            return
        self._drawn = sources
        self._markers.publish(MarkerArray(markers=mission_drawn(path, fence, self._joints)))

    def _show(self, stamp: Any, place: Place, attitude: Any) -> None:
        shown = vehicle_drawn(self._newest, self._vehicle, place, attitude, stamp)
        self._live.publish(MarkerArray(markers=shown))
        angles = fin_angles(self._newest)
        joints = JointState(name=list(angles), position=list(angles.values()))
        joints.header.stamp = stamp
        self._joint_states.publish(joints)
        if self._transforms is not None:
            self._transforms.publish(stamp, place, attitude, angles)


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `display`: 0 after a signal, 2 for input that cannot be used."""
    ensure_log_directory()
    stop = StopRequest()
    node = None
    try:
        check_parameter_files(sys.argv if args is None else args)
        if not pass_gate(lambda: stop.requested):
            return 0
        start_ros(args)
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
        stop.withdraw()


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
