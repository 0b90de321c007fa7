"""ROS 1 bags: every message in ROS 2's layout, whose header has no `seq`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.typesys import Stores, get_typestore

from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.load import load
from auv_sim.cli import bag as bag_command


def ros1(file: Path) -> None:
    """Half a second of odometry going east, its header with `seq`, and a type with fewer fields in ROS 1."""
    store = get_typestore(Stores.ROS1_NOETIC)
    kinds = store.types
    with Ros1Writer(file) as writer:
        odometry = writer.add_connection("/auv/odom", "nav_msgs/msg/Odometry", typestore=store)
        ranges = writer.add_connection("/auv/altitude", "sensor_msgs/msg/Range", typestore=store)
        for k in range(50):
            stamp = kinds["builtin_interfaces/msg/Time"](100, k * 10_000_000)
            header = kinds["std_msgs/msg/Header"](7 + k, stamp, "map")
            point = kinds["geometry_msgs/msg/Point"](0.5 * k, 2.0, 0.0)
            pose = kinds["geometry_msgs/msg/Pose"](
                point, kinds["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
            )
            zero = kinds["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
            twist = kinds["geometry_msgs/msg/Twist"](zero, zero)
            sent = kinds["nav_msgs/msg/Odometry"](
                header, "base_link",
                kinds["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36)),
                kinds["geometry_msgs/msg/TwistWithCovariance"](twist, np.zeros(36)),
            )  # fmt: skip
            at = 100 * 10**9 + k * 10_000_000
            writer.write(odometry, at, store.serialize_ros1(sent, "nav_msgs/msg/Odometry"))
            seen = kinds["sensor_msgs/msg/Range"](header, 0, 0.1, 0.2, 50.0, 4.5)
            writer.write(ranges, at, store.serialize_ros1(seen, "sensor_msgs/msg/Range"))


def test_a_ros1_bag_with_headers_is_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "dive.bag"
    ros1(file)
    run = load(file)
    assert run.steps == 50
    np.testing.assert_array_equal(run.y, 0.5 * np.arange(50))  # ENU x is east
    np.testing.assert_array_equal(run.x, np.full(50, 2.0))
    np.testing.assert_allclose(run.t, 100 + 0.01 * np.arange(50), atol=1e-9)
    bag = read_bag(file)
    assert bag.notes == []
    (seen,) = (topic for topic in bag.topics.values() if topic.name == "/auv/altitude")
    decoded = typestore().deserialize_cdr(seen.messages[3] or b"", "sensor_msgs/msg/Range")
    assert decoded.header.frame_id == "map"
    assert decoded.range == pytest.approx(4.5)
    assert bag_command.main(["repair", str(file)]) == 0
    assert "whole, 100 messages" in capsys.readouterr().out
    whole = read_bag(tmp_path / "dive")
    for name, topic in bag.topics.items():
        assert whole.topics[name].messages == topic.messages
        assert whole.topics[name].log_ns == topic.log_ns
    assert load(tmp_path / "dive").steps == 50


def test_of_a_ros1_bag_cut_off_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "dive.bag"
    ros1(file)
    file.write_bytes(file.read_bytes()[:3000])
    assert bag_command.main(["inspect", str(file)]) == 2
    err = capsys.readouterr().err
    assert "a recording that cannot be read" in err and err.count("\n") == 1
