"""The bridge to Foxglove, with a file of the SDK in place of a client."""

from __future__ import annotations

import time
from pathlib import Path
from types import SimpleNamespace

import pytest
import rclpy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from nav_msgs.msg import Path as PathMessage
from rclpy.executors import SingleThreadedExecutor
from rclpy.serialization import deserialize_message

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_sim.bags.definitions import typestore
from auv_sim.nodes.live_view.bridge import Bridge, listener_of


def test_messages_pass_as_they_are_and_latched_ones_again_on_request(domain: int, tmp_path: Path) -> None:
    missing = "foxglove-sdk is not installed: requirements/foxglove.txt"
    foxglove = pytest.importorskip("foxglove", reason=missing)
    from mcap.reader import make_reader

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain)
    node = rclpy.create_node("bridge", namespace="/auv", context=context)
    other = rclpy.create_node("other", namespace="/auv", context=context)
    path, odometry = PathMessage(), Odometry(child_frame_id="base_link_frd")
    path.poses.append(PoseStamped())
    odometry.header.frame_id = "map_ned"
    odometry.pose.pose.position.x, odometry.pose.pose.position.z = 30.0, 5.0
    odometry.pose.pose.orientation.w = 1.0
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(other)
    with foxglove.open_mcap(str(tmp_path / "log.mcap")):
        bridge = Bridge(node, foxglove, FrameTable(FrameIds()))
        listener = listener_of(bridge, foxglove)
        latched = other.create_publisher(PathMessage, "path", qos.offered(topics.PATH))
        latched.publish(path)
        odom = other.create_publisher(Odometry, "odom", 10)
        heard = bridge.latched_topics
        deadline = time.monotonic() + 180.0
        while "/auv/path" not in heard() and time.monotonic() < deadline:
            executor.spin_once(timeout_sec=0.05)
        for _ in range(40):
            odom.publish(odometry)
            executor.spin_once(timeout_sec=0.02)
        listener.on_subscribe(SimpleNamespace(id=1), SimpleNamespace(id=heard()["/auv/path"]))
        listener.on_subscribe(SimpleNamespace(id=1), SimpleNamespace(id=999_999))  # not latched
        bridge.answer_late()
    for each in (node, other):
        each.destroy_node()
    rclpy.shutdown(context=context)
    found: dict[str, list[bytes]] = {}
    with (tmp_path / "log.mcap").open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            found.setdefault(channel.topic, []).append(message.data)
            if channel.topic == "/auv/odom":
                assert (schema.name, schema.encoding) == ("nav_msgs/msg/Odometry", "ros2msg")
                assert channel.message_encoding == "cdr" and b"PoseWithCovariance pose" in schema.data
    # Compared by their contents: the bytes between two fields are anything.
    assert [deserialize_message(data, PathMessage) for data in found["/auv/path"]] == [path] * 2
    assert all(deserialize_message(data, Odometry) == odometry for data in found["/auv/odom"])
    read = typestore().deserialize_cdr(found["/auv/odom"][0], "nav_msgs/msg/Odometry")
    assert read.pose.pose.position.x == 30.0
    assert len(found["/tf"]) == len(found["/auv/odom"])
    assert b"base_link" in found["/tf"][0] and b"base_link_frd" not in found["/tf"][0]
