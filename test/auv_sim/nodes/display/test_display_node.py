"""The display over DDS: what it publishes for a vehicle at depth that passes by."""

from __future__ import annotations

import time
from typing import Any

import rclpy
from geometry_msgs.msg import Point32, PolygonStamped
from nav_msgs.msg import Odometry
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from std_msgs.msg import Float64

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.spatial_conversions import fill_spatial_odometry, spatial_path_message
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.types import SpatialNavigation
from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_sim.nodes.display import display_topics
from auv_sim.nodes.display.display_node import DisplayNode

SHOWN = (
    display_topics.MARKERS, display_topics.LIVE_MARKERS, display_topics.ROBOT_DESCRIPTION,
    display_topics.JOINT_STATES,
)  # fmt: skip


def publish(node: Any, topic: Topic, message: Any) -> Any:
    publisher = node.create_publisher(type(message), topic.name, qos.offered(topic))
    publisher.publish(message)
    return publisher


def test_it_shows_path_joints_fence_vehicle_and_fins(domain: int) -> None:
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain)
    other = rclpy.create_node("other", namespace="/auv", context=context)
    values = {"mission": "helix", "vehicle": "remus100_6dof"}
    display = DisplayNode(
        namespace="/auv", context=context, use_global_arguments=False,
        parameter_overrides=[Parameter(name, value=value) for name, value in values.items()],
    )  # fmt: skip
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(display)
    executor.add_node(other)
    seen: dict[Topic, Any] = {}
    for topic in SHOWN:
        other.create_subscription(
            qos.message_class(topic.type), topic.name, lambda m, t=topic: seen.__setitem__(t, m),
            qos.requested(topic, reliable=True),
        )  # fmt: skip
    odometry = Odometry(child_frame_id="base_link_frd")
    odometry.header.frame_id = "map_ned"
    navigation = SpatialNavigation(10.0, 20.0, 5.0, 0.0, -0.1, 0.0, 0.0, 0.0)
    fill_spatial_odometry(odometry, navigation, (1.5, 0.0, 0.0), 0.0, 7_000_000_000)
    polygon = PolygonStamped()
    polygon.polygon.points = [Point32(x=float(x), y=float(y)) for x, y in ((0, 0), (90, 0), (90, 90))]
    north, east, _ = mission_file.load("helix", vehicle.load("remus100_6dof")).path.start_pose
    start = ((north, east, 3.0), 0.0, 0.0)  # of the mission's joints the first alone lies on this path
    sources = [
        publish(other, topics.PATH, spatial_path_message([start], 0)),
        publish(other, topics.GEOFENCE, polygon),
    ]
    feeds = [
        (other.create_publisher(type(message), topic.name, 10), message)
        for topic, message in (
            (topics.ODOM, odometry), (topics.RUDDER_STATE, Float64(data=0.2)),
            (topics.STERNPLANE_STATE, Float64(data=-0.1)),
        )
    ]  # fmt: skip

    def complete() -> bool:
        return (
            set(seen) == set(SHOWN)
            and len(seen[display_topics.JOINT_STATES].name) == 2
            and bool(seen[display_topics.MARKERS].markers[2].points)
        )

    deadline = time.monotonic() + 180.0
    while not complete() and time.monotonic() < deadline:
        for publisher, message in feeds:
            publisher.publish(message)
        for _ in range(20):
            executor.spin_once(timeout_sec=0.01)
        display.tick()
    assert complete(), {topic.name: message for topic, message in seen.items()}
    line, joints, _ = seen[display_topics.MARKERS].markers
    assert (
        [(p.x, p.y, p.z) for p in line.points]
        == [(east, north, -3.0)]
        == [(p.x, p.y, p.z) for p in joints.points]
    )
    hull = seen[display_topics.LIVE_MARKERS].markers[0]
    assert (hull.ns, hull.pose.position.x, hull.pose.position.y, hull.pose.position.z) == (
        "vehicle", 20.0, 10.0, -5.0,
    )  # fmt: skip
    assert hull.header.frame_id == "map" and hull.header.stamp.sec == 7
    state = seen[display_topics.JOINT_STATES]
    assert (state.name, list(state.position)) == (["rudder_joint", "sternplane_joint"], [0.2, -0.1])
    assert "sternplane_joint" in seen[display_topics.ROBOT_DESCRIPTION].data
    assert len(sources) == 2
    for node in (display, other):
        node.destroy_node()
    rclpy.shutdown(context=context)
