"""Whole files of every kind, to be spoiled: the shipped ones, small ones of each format, recordings."""

from __future__ import annotations

import shutil
import sqlite3
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from auv_path_following import config_files
from auv_sim.bags.definitions import typestore
from auv_sim.bags.writing.bag_writer import BagWriter

#: The mission beside each waypoint file, and what it takes of the file.
AROUND = (
    "version: 1\nname: m\nframe: wgs84\norigin: {latitude_deg: 63.447, longitude_deg: 10.399}\nthrust: 6\n"
)
USES = {
    "waypoints": "waypoints: {{file: places.{suffix}, smoothing: {{kind: linear}}}}\n",
    "survey": "survey: {{file: places.{suffix}, spacing: 30, heading_deg: 0, smoothing: {{kind: linear}}}}\n",
    "geofence": "geofence: {{file: places.{suffix}}}\nloiter: {{centre: [63.447, 10.399], radius: 9}}\n",
}
_ROUTES = """version: 1
name: "all keys"
description: "of one \\u00e9 text"
frame: ned
speed: 1.5
switching: {mode: g0, radius: 5}
limits: {path_distance: 50, duration: 900, max_depth: 60, max_slope_deg: 30, depth_error: 9}
geofence: [[-99, -99], [500, -99], [500, 500], [-99, 500]]
reverse: false
repeat: 1
segments:
  - line: {start: [0, 0], length: 100, course_deg: 0}
  - arc: {centre: [100, 50], radius: 50, from_deg: -90, to_deg: 0}
  - clothoid: {start: [150, 50], course_deg: 90, length: 50, start_curvature: 0.02, end_curvature: 0}
  - spline: {points: [[158.0, 99.2], [170, 150], [160, 200]]}
"""
_MORE = (
    "survey: {polygon: [[0, 0], [90, 0], [90, 90]], swath: 20, overlap: 0.2, heading_deg: 10,"
    " smoothing: {kind: dubins, radius: 6}}",
    "spiral: {centre: [0, 0], inner_radius: 5, spacing: 9, turns: 4, bearing_deg: 20}",
    "figure_of_eight: {centre: [0, 0], radius: 20, separation: 60, axis_deg: 20}",
    "loiter: {centre: [0, 0], radius: 20, turns: 3}",
    "waypoints: {points: &p [[0, 0], [90, 0], [90, 90], [0, 90]], closed: true,"
    " smoothing: {kind: fermat, radius: 9}}",
    "depth: 12\nwaypoints: {points: [[0, 0], [90, 0]], smoothing: {kind: linear}}",
    "depth_profile: {kind: smooth, knots: [[0, 5], [60, 9], [120, 5]]}\nreverse: true\n"
    "waypoints: {points: [[0, 0], [120, 0]], smoothing: {kind: linear}}",
    "altitude: {above_bottom: 5, min: 2}\nloiter: {centre: [0, 0], radius: 20, turns: 3}",
    "waypoints: {points: [[0, 0, 5], [90, 0, 9], [90, 90, 7]], depths: take, depth_ramp: linear,"
    " smoothing: {kind: fermat, radius: 9}}",
    "waypoints: {points: [[0, 0, 5], [90, 0, 9], [90, 90, 7]], smoothing: {kind: spline}}",
    "survey: {polygon: [[0, 0], [90, 0], [90, 40], [0, 40]], spacing: 20, heading_deg: 0, leg_depths: [5, 9],"
    " smoothing: {kind: dubins, radius: 6}}",
    "helix: {centre: [0, 0], radius: 15, from_depth: 5, to_depth: 40, slope_deg: 10, turn: -1, run_in: 9}",
)


def missions() -> list[bytes]:
    """Every route and every key."""
    head = _ROUTES.split("segments:")[0]
    return [_ROUTES.encode(), *(f"{head}{route}\n".encode() for route in _MORE), *shipped("missions")]


def shipped(kind: config_files.Kind) -> list[bytes]:
    """The files that come with the suite."""
    return [path.read_bytes() for path in config_files.shipped(kind).values()]


def _messages() -> list[tuple[str, str, int, bytes]]:
    """Some seconds of a flight: (topic, type, log time in ns, serialised message)."""
    store = typestore()
    kinds: Any = store.types

    def header(k: int) -> Any:
        stamp = kinds["builtin_interfaces/msg/Time"](sec=1 + k // 10, nanosec=k % 10 * 100_000_000)
        return kinds["std_msgs/msg/Header"](stamp=stamp, frame_id="map")

    def vector(x: float = 0.0, y: float = 0.0) -> Any:
        return kinds["geometry_msgs/msg/Vector3"](x=x, y=y, z=0.0)

    def odometry(k: int) -> Any:
        point = kinds["geometry_msgs/msg/Point"](x=0.0, y=0.15 * k, z=0.0)
        turn = kinds["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.707, w=0.707)
        pose = kinds["geometry_msgs/msg/Pose"](position=point, orientation=turn)
        twist = kinds["geometry_msgs/msg/Twist"](linear=vector(1.5), angular=vector())
        return kinds["nav_msgs/msg/Odometry"](
            header=header(k),
            child_frame_id="base_link",
            pose=kinds["geometry_msgs/msg/PoseWithCovariance"](pose=pose, covariance=np.zeros(36)),
            twist=kinds["geometry_msgs/msg/TwistWithCovariance"](twist=twist, covariance=np.zeros(36)),
        )

    made: list[tuple[str, str, int, bytes]] = []

    def put(name: str, kind: str, k: int, message: Any) -> None:
        made.append((f"/auv/{name}", kind, 10**9 + k * 10**8, bytes(store.serialize_cdr(message, kind))))

    number, text = "std_msgs/msg/Float64", "std_msgs/msg/String"
    for k in range(60):
        put("odom", "nav_msgs/msg/Odometry", k, odometry(k))
        put("rudder_cmd", number, k, kinds[number](0.01 * k))
        put("path_parameter", number, k, kinds[number](k / 60))
        error = kinds["geometry_msgs/msg/Vector3Stamped"](header=header(k), vector=vector(0.1, 0.2))
        put("path_error", "geometry_msgs/msg/Vector3Stamped", k, error)
        if k % 20 == 0:
            put("mission_state", text, k, kinds[text]("running"))
    return made


def mcap(directory: Path, compression: str) -> Path:
    """Write a rosbag2 directory in MCAP; returns the storage file."""
    writer = BagWriter(directory, compression, texts={"mission.yaml": _ROUTES})  # type: ignore[arg-type]
    channels: dict[str, Any] = {}
    for k, (topic, kind, at, data) in enumerate(_messages()):
        if topic not in channels:
            channels[topic] = writer.add_topic(topic, kind, [])
        writer.write(channels[topic], at, at, data, k + 1)
        if k % 40 == 39:
            writer.flush()
    writer.close()
    return writer.file


def sqlite(directory: Path) -> Path:
    """Write a rosbag2 directory in SQLite; returns the storage file."""
    _fill(Writer(directory, version=9, storage_plugin=StoragePlugin.SQLITE3))
    return next(directory.glob("*.db3"))


def _fill(opened: Writer) -> None:
    with opened as writer:
        connections: dict[str, Any] = {}
        for topic, kind, at, data in _messages():
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=typestore())
            writer.write(connections[topic], at, data)


def packed(directory: Path) -> Path:
    """Write a rosbag2 directory in SQLite, the file packed; returns it."""
    writer = Writer(directory, version=9, storage_plugin=StoragePlugin.SQLITE3)
    writer.set_compression(CompressionMode.FILE, CompressionFormat.ZSTD)
    _fill(writer)
    return next(directory.glob("*.zstd"))


def unmerged(directory: Path) -> Path:
    """Write a rosbag2 directory in SQLite that was not closed; returns what lies beside the file."""
    whole = directory.with_name("whole")
    file = sqlite(whole)
    connection = sqlite3.connect(file)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("UPDATE messages SET timestamp = timestamp + 1 WHERE id % 3 = 0")
    connection.commit()
    shutil.copytree(whole, directory, ignore=shutil.ignore_patterns("*-shm"))
    connection.close()
    shutil.rmtree(whole)
    return directory / f"{file.name}-wal"


def ros1(directory: Path) -> Path:
    """Write a ROS 1 bag; returns it."""
    store = get_typestore(Stores.ROS1_NOETIC)
    kinds: Any = store.types
    directory.mkdir()
    with Ros1Writer(directory / "bag.bag") as writer:
        text = writer.add_connection("/auv/mission_state", "std_msgs/msg/String", typestore=store)
        fence = writer.add_connection("/auv/origin", "geometry_msgs/msg/PointStamped", typestore=store)
        for k in range(20):
            at = (100 + k) * 10**9
            header = kinds["std_msgs/msg/Header"](k, kinds["builtin_interfaces/msg/Time"](100 + k, 0), "map")
            point = kinds["geometry_msgs/msg/PointStamped"](
                header, kinds["geometry_msgs/msg/Point"](k, 0.0, 0.0)
            )
            running = kinds["std_msgs/msg/String"]("running")
            writer.write(text, at, store.serialize_ros1(running, "std_msgs/msg/String"))
            writer.write(fence, at, store.serialize_ros1(point, "geometry_msgs/msg/PointStamped"))
    return directory / "bag.bag"
