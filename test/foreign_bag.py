"""A recording of 2 s in SQLite, written by rosbags: messages of any type beside a turn."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

STORE = get_typestore(Stores.ROS2_JAZZY)
FINS = "fin_msgs/msg/FinCommand"
STORE.register(get_types_from_msg("float64[4] fins\nauv/Setpoint setpoint\nstring mode", FINS))
STORE.register(get_types_from_msg("float32 thrust\nbool armed", "auv/msg/Setpoint"))
#: Time of the first odometry by its stamps and by the log, and between odometries, ns.
BEGIN, LOGGED, STEP, COUNT = 5 * 10**9, 1700 * 10**9, 50_000_000, 40
RATE = 0.1  # to port, rad/s

Made = Callable[[int], Any]


def made(kind: str, *values: Any) -> Any:
    """Return a message by the short name of its type, package/Name."""
    return STORE.types[kind.replace("/", "/msg/", 1) if "/msg/" not in kind else kind](*values)


def header(k: int, frame: str) -> Any:
    """Return the header of the k-th odometry's time."""
    stamp = BEGIN + k * STEP
    return made("std_msgs/Header", made("builtin_interfaces/Time", *divmod(stamp, 10**9)), frame)


def vector(x: float, y: float, z: float = 0.0) -> Any:
    """Return a vector."""
    return made("geometry_msgs/Vector3", float(x), float(y), float(z))


def twist(linear: Any, yaw_rate: float = 0.0) -> Any:
    """Return a twist."""
    return made("geometry_msgs/Twist", linear, vector(0, 0, yaw_rate))


def covered(inner: Any) -> Any:
    """Return a twist or pose with covariance."""
    name = type(inner).__msgtype__.rpartition("/")[2]
    return made(f"geometry_msgs/{name}WithCovariance", inner, np.zeros(36))


def odometry(k: int, world: str = "odom", child: str = "base_link", linear: Any = None) -> Any:
    """Return an odometry that turns to port; by default it makes 1.5 m/s ahead and 0.1 m/s to port."""
    yaw = 1.0 + RATE * k * STEP * 1e-9
    q = made("geometry_msgs/Quaternion", 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))
    pose = made("geometry_msgs/Pose", made("geometry_msgs/Point", 0.0, 0.0, 0.0), q)
    linear = vector(1.5, 0.1) if linear is None else linear
    return made("nav_msgs/Odometry", header(k, world), child, covered(pose), covered(twist(linear, RATE)))


def number(value: float) -> Any:
    """Return a Float64."""
    return made("std_msgs/Float64", float(value))


def velocity(k: int) -> Any:
    """Return the contract's velocity through the water, which differs from sample to sample."""
    inner = covered(twist(vector(1.5 + 0.001 * k, 0.1)))
    return made("geometry_msgs/TwistWithCovarianceStamped", header(k, "base_link"), inner)


#: Topics of the wire contract.
CONTRACT: Mapping[str, Made] = {
    "/auv/odom": odometry,
    "/auv/velocity_through_water": velocity,
    "/auv/rudder_cmd": lambda k: number(0.01 * k),
    "/auv/thrust_cmd": lambda k: number(8.0),
}


def write_foreign(directory: Path, content: Mapping[str, Made], without: Sequence[str] = ()) -> Path:
    """Write a recording; return its directory.

    Args:
        directory: new.
        content: topic -> message of the k-th odometry's time, which may be None; beside the wire contract.
        without: topics that are left out.
    """
    rows = {name: make for name, make in {**CONTRACT, **content}.items() if name not in without}
    with Writer(directory, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        connections: dict[str, Any] = {}
        for k in range(COUNT):
            for late, (name, make) in enumerate(rows.items()):
                message = make(k)
                if message is None:
                    continue
                kind = type(message).__msgtype__
                if name not in connections:
                    connections[name] = writer.add_connection(name, kind, typestore=STORE)
                data = bytes(STORE.serialize_cdr(message, kind))
                writer.write(connections[name], LOGGED + k * STEP + late * 100_000, data)
    return directory
