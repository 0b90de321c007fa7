"""Manoeuvres of the simulator as a recording of another maker: no lockstep, own names, any frames."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import flip_yaw, quaternion_of_yaw
from auv_sim.bags.definitions import typestore
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import Manoeuvred

#: Names on the wire.
NAMES = {topic.name: f"/auv/{topic.name}" for topic in (
    topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_CMD, topics.THRUST_CMD,
)}  # fmt: skip
_TYPES = {topic.name: topic.type for topic in (
    topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_CMD, topics.THRUST_CMD,
)}  # fmt: skip


def _made(kind: str, *values: Any) -> Any:
    return typestore().types[kind](*values)


def _vector(x: float, y: float, z: float) -> Any:
    return _made("geometry_msgs/msg/Vector3", x, y, z)


def _header(at: int, frame: str) -> Any:
    time = _made("builtin_interfaces/msg/Time", at // 10**9, at % 10**9)
    return _made("std_msgs/msg/Header", time, frame)


def _twist(u: float, v: float, r: float) -> Any:
    twist = _made("geometry_msgs/msg/Twist", _vector(u, v, 0.0), _vector(0.0, 0.0, r))
    return _made("geometry_msgs/msg/TwistWithCovariance", twist, np.zeros(36))


def _odometry(flown: Manoeuvred, k: int, at: int, ned: bool, body: str) -> Any:
    x, y, yaw = float(flown.x[k]), float(flown.y[k]), float(flown.psi[k])
    side = 1.0 if ned else -1.0
    if not ned:
        x, y, yaw = y, x, float(flip_yaw(yaw))
    z, w = quaternion_of_yaw(yaw)
    pose = _made(
        "geometry_msgs/msg/Pose",
        _made("geometry_msgs/msg/Point", x, y, 0.0),
        _made("geometry_msgs/msg/Quaternion", 0.0, 0.0, z, w),
    )
    covered = _made("geometry_msgs/msg/PoseWithCovariance", pose, np.zeros(36))
    twist = _twist(float(flown.u[k]), side * float(flown.v[k]), side * float(flown.r[k]))
    world = "map_ned" if ned else "map"
    return _made("nav_msgs/msg/Odometry", _header(at, world), body, covered, twist)


def write_manoeuvres(
    directory: Path, flown: Manoeuvred, names: Mapping[str, str] = NAMES, ned: bool = False,
    repeated: bool = True, late: float = 0.0, set_back: float = 0.0, body: str = "",
    command: str = "std_msgs/msg/Float64", silent: tuple[float, float] = (0.0, 0.0),
    velocity: str = topics.WATER_VELOCITY.type, second: str = "",
) -> Path:  # fmt: skip
    """Write a recording; return its directory.

    Args:
        directory: new.
        flown: the manoeuvres.
        names: of the topics; one left out is not recorded.
        ned: frames NED and FRD in place of ENU and FLU.
        repeated: whether every odometry comes with the last velocity through the water; else new ones alone.
        late: time by which every command is logged later, s.
        set_back: time by which the clock of the stamps is set back in the middle, s.
        body: frame id of the body; by default as `ned` says.
        command: type of the commands, which are rounded where it holds whole numbers.
        silent: interval of the odometry's time without commands, s; its ends are not part of it.
        velocity: type of the velocity through the water.
        second: the topic that is recorded under the name of "second" too.
    """
    side, body = 1.0 if ned else -1.0, body or ("base_link_frd" if ned else "base_link")
    number = int if "Int" in command else float
    types = _TYPES | {"rudder_cmd": command, "thrust_cmd": command, topics.WATER_VELOCITY.name: velocity}
    last = np.searchsorted(flown.water_t, flown.t + 1e-6) - 1
    with BagWriter(directory) as writer:
        types["second"] = types.get(second, "")
        channels = {name: writer.add_topic(full, types[name], []) for name, full in names.items()}

        def put(name: str, at: int, message: Any) -> None:
            if name in channels:
                data = bytes(typestore().serialize_cdr(message, types[name]))
                writer.write(channels[name], at, at, data)
                if name == second:
                    writer.write(channels["second"], at, at, data)

        for k in range(flown.t.size):
            at, row = round(float(flown.t[k]) * 1e9), last[k]
            stamp = at - round(set_back * 1e9) * (2 * k > flown.t.size)
            put("odom", at, _odometry(flown, k, stamp, ned, body))
            if row >= 0 and (repeated or abs(flown.water_t[row] - flown.t[k]) < 1e-6):
                twist = _twist(float(flown.water_u[row]), side * float(flown.water_v[row]), 0.0)
                measured = twist if "Covariance" in velocity else twist.twist
                put("velocity_through_water", at, _made(velocity, _header(stamp, body), measured))
            for name, column in (("rudder_cmd", flown.rudder), ("thrust_cmd", flown.thrust)):
                if silent[0] < flown.t[k] < silent[1]:
                    continue
                put(name, at + 1_000_000 + round(late * 1e9), _made(command, number(column[k])))
    return directory
