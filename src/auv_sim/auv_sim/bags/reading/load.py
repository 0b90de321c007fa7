"""Reads a recording as a `Run`: any rosbag2 directory with the topics of the wire contract."""

from __future__ import annotations

import contextlib
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import (
    Convention,
    FrameIds,
    FrameTable,
    flip_yaw,
    swap_axes,
    yaw_of_quaternion,
)
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.columns import Columns, decode
from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.reading.held_rows import held_rows
from auv_sim.bags.reading.recording import Bag, RecordedTopic
from auv_sim.flight.run_record import Run

#: Every topic with signals of a `Run`.
USED = (
    topics.ODOM,
    topics.WATER_VELOCITY,
    topics.RUDDER_STATE,
    topics.TRUE_CURRENT,
    topics.TRUE_ODOM,
    topics.CURRENT_ESTIMATE,
    topics.DESIRED_YAW,
    topics.DESIRED_YAW_RATE,
    topics.PATH_PARAMETER,
    topics.PATH_ERROR,
    topics.RUDDER_CMD,
    topics.THRUST_CMD,
)
#: Its states are intervals of time, not numbers.
_STATE = topics.MISSION_STATE  # fmt: skip

_POSITION, _ORIENTATION = "pose.pose.position.", "pose.pose.orientation."
#: The numbers of an odometry that make a pose.
_POSE = (f"{_POSITION}x", f"{_POSITION}y", *(f"{_ORIENTATION}{axis}" for axis in "xyzw"))


class _Recorded(NamedTuple):
    """One topic of the bag: log times (n,), ns, and the messages' fields."""

    log_ns: NDArray[np.int64]
    columns: Columns


def load(bag: Path, namespace: str | None = None, frame_ids: FrameIds | None = None) -> Run:
    """Read a recording.

    Topics are found by the last part of their names. Stamped messages are matched with the odometry by
    stamp; unstamped ones row by row when there is exactly one for each odometry (lockstep), else by log
    time. In both cases the newest message that is not younger than the odometry counts.

    Args:
        bag: the rosbag2 directory.
        namespace: of the vehicle, needed only when the bag holds several (``/auv``).
        frame_ids: the frame ids to accept; the contract's by default.

    Returns:
        The run in NED / FRD on the odometry's stamps, which strictly increase: a lone older or repeated
        stamp is left out, and reading ends at a backward jump (a reset).

    Raises:
        ConfigurationError: not a readable recording, no odometry, topics of several vehicles, a topic
            of another type, or frame ids that are unknown or change.
    """
    return run_of(read_bag(bag, is_used), namespace, frame_ids)


def is_used(name: str, type_name: str) -> bool:
    """Return whether a topic has signals of a `Run`; it may be odometry of any name."""
    used = {topic.name for topic in (*USED, _STATE)}
    return type_name == topics.ODOM.type or name.rsplit("/", 1)[-1] in used


def run_of(bag: Bag, namespace: str | None = None, frame_ids: FrameIds | None = None) -> Run:
    """Return the run of a bag in memory, as `load`.

    Raises:
        ConfigurationError: as `load`.
    """
    recorded = {}
    for topic, found in _read(bag, namespace).items():
        # By log time, as every reader sorts them; messages of one time stay in the order of the file.
        rows = np.argsort(np.array(found.log_ns, np.int64), kind="stable")
        messages = [message for k in rows if (message := found.messages[k]) is not None]
        if messages:
            log_ns = np.array(found.log_ns, np.int64)[rows]
            recorded[topic] = _Recorded(log_ns, _decoded(topic, messages, bag.path))
    if topics.ODOM not in recorded:
        expected = f"messages on {topics.ODOM.name}, or of type {topics.ODOM.type} on one other topic"
        raise ConfigurationError(str(bag.path), "no odometry", expected)
    table = FrameTable(frame_ids or FrameIds())
    state = bag.find(_STATE.name, namespace)
    states = messages_of(state) if state is not None and state.type == _STATE.type else []
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # numbers of a damaged message
            return _assemble(recorded, states, table, bag.path)
    except MessageRefused as refused:
        raise ConfigurationError(f"{bag.path}: {refused.topic}", refused.found, refused.expected) from None


def load_messages(bag: Path, name: str, namespace: str | None = None) -> list[tuple[int, Any]]:
    """Return all messages of one topic, deserialised.

    Args:
        bag: the rosbag2 directory.
        name: last part of the topic's name (``mission_state``).
        namespace: as in `load`.

    Returns:
        (log time in ns, message) in the order of log time; empty when the topic was not recorded.

    Raises:
        ConfigurationError: not a readable recording, or topics of several vehicles.
    """
    content = read_bag(bag, lambda topic, _: topic.rsplit("/", 1)[-1] == name)
    found = content.find(name, namespace)
    if found is None:
        return []
    return messages_of(found)


def messages_of(topic: RecordedTopic) -> list[tuple[int, Any]]:
    """Return (log time in ns, message) of every decodable message, by log time."""
    decode_one = deserializer(topic)
    decoded = []
    for log_ns, cdr in sorted(zip(topic.log_ns, topic.messages, strict=True), key=itemgetter(0)):
        if cdr is not None:
            with contextlib.suppress(Exception):  # damaged bytes raise any exception
                decoded.append((log_ns, decode_one(cdr)))
    return decoded


def _read(bag: Bag, namespace: str | None) -> dict[Topic, RecordedTopic]:
    chosen: dict[Topic, RecordedTopic] = {}
    for topic in USED:
        found = bag.find(topic.name, namespace)
        if found is None:
            continue
        if found.type != topic.type:
            raise ConfigurationError(f"{bag.path}: {found.name}", found.type, topic.type)
        chosen[topic] = found
    return chosen


def _decoded(topic: Topic, messages: list[bytes], bag: Path) -> Columns:
    try:
        return decode(topic.type, messages)
    except Exception as error:
        # Bytes of no such message: rosbags raises any exception.
        reason = " ".join(str(error).split())
        raise ConfigurationError(
            f"{bag}: {topic.name}", f"a damaged message ({reason})", topic.type
        ) from None


def _assemble(
    recorded: dict[Topic, _Recorded], states: list[tuple[int, Any]], table: FrameTable, bag: Path
) -> Run:
    odometry = recorded[topics.ODOM]
    world, body = _frames(topics.ODOM, odometry.columns, bag)
    convention = table.of_pose(topics.ODOM.name, world, body)
    x, y, psi = _pose([odometry.columns.column(field) for field in _POSE], convention)
    turn = odometry.columns.column("twist.twist.angular.z")
    if convention is Convention.ENU_FLU:
        turn = -turn

    def aligned(topic: Topic, field: str = "data") -> Any:
        return _aligned(odometry, recorded.get(topic), field)

    Vx_est, Vy_est = swap_axes(*(aligned(topics.CURRENT_ESTIMATE, f"vector.{axis}") for axis in "xy"))
    Vx_true, Vy_true = swap_axes(*(aligned(topics.TRUE_CURRENT, f"vector.{axis}") for axis in "xy"))
    x_true, y_true, psi_true = _pose([aligned(topics.TRUE_ODOM, field) for field in _POSE], convention)
    run = Run.from_columns(
        {
            "t": odometry.columns.stamp_ns * 1e-9,
            "x": x,
            "y": y,
            "psi": psi,
            "r": turn,
            "ur": aligned(topics.WATER_VELOCITY, "twist.twist.linear.x"),
            "vr": _sway_sign(recorded, table, bag) * aligned(topics.WATER_VELOCITY, "twist.twist.linear.y"),
            "rudder": aligned(topics.RUDDER_STATE),
            "rudder_cmd": aligned(topics.RUDDER_CMD),
            "thrust_cmd": aligned(topics.THRUST_CMD),
            "psi_d": wrap(flip_yaw(aligned(topics.DESIRED_YAW))),
            "r_d": -aligned(topics.DESIRED_YAW_RATE),
            "xe": aligned(topics.PATH_ERROR, "vector.x"),
            "ye": aligned(topics.PATH_ERROR, "vector.y"),
            "psi_e": aligned(topics.PATH_ERROR, "vector.z"),
            "s": aligned(topics.PATH_PARAMETER),
            "Vx_est": Vx_est,
            "Vy_est": Vy_est,
            "Vx_true": Vx_true,
            "Vy_true": Vy_true,
            "x_true": x_true,
            "y_true": y_true,
            "psi_true": psi_true,
            "held": held_rows(odometry.log_ns, states),
        }
    )
    return run.select(_first_flight(odometry.columns.stamp_ns))


def _sway_sign(recorded: dict[Topic, _Recorded], table: FrameTable, bag: Path) -> float:
    """Return -1 where the velocity through water is in FLU, whose sway is opposite to FRD's; else 1."""
    water = recorded.get(topics.WATER_VELOCITY)
    if water is None:
        return 1.0
    (frame,) = _frames(topics.WATER_VELOCITY, water.columns, bag)
    convention = table.of_body(topics.WATER_VELOCITY.name, frame)
    return -1.0 if convention is Convention.ENU_FLU else 1.0


def _pose(columns: list[Any], convention: Convention) -> tuple[Any, Any, Any]:
    """Return x, y (m) and psi (rad), NED, from the columns of `_POSE`."""
    x, y, yaw = columns[0], columns[1], yaw_of_quaternion(*columns[2:])
    if convention is Convention.ENU_FLU:
        (x, y), yaw = swap_axes(x, y), flip_yaw(yaw)
    return x, y, wrap(yaw)


def _first_flight(stamp: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return the rows up to the first backward jump, without lone older or repeated stamps, shape (n,)."""
    newest_before = np.concatenate(([np.iinfo(np.int64).min], np.maximum.accumulate(stamp)[:-1]))
    older = stamp < newest_before
    jumps = np.flatnonzero(older[:-1] & older[1:])
    kept: NDArray[np.bool_] = stamp > newest_before
    if jumps.size:
        kept[jumps[0] :] = False
    return kept


def _frames(topic: Topic, columns: Columns, bag: Path) -> tuple[str, ...]:
    if len(columns.frames) > 1:
        listed = " and ".join(repr(frames) for frames in columns.frames)
        raise ConfigurationError(f"{bag}: {topic.name}", f"frame ids {listed}", "the same in every message")
    return columns.frames[0]


def _aligned(odometry: _Recorded, other: _Recorded | None, field: str) -> NDArray[np.float64]:
    """Return one field of a topic for each odometry, shape (n,); NaN before the topic's first message."""
    n = odometry.log_ns.size
    if other is None:
        return np.full(n, np.nan)
    values = other.columns.column(field)
    if other.columns.frames:
        kept = _first_flight(other.columns.stamp_ns)
        values, times, at = values[kept], other.columns.stamp_ns[kept], odometry.columns.stamp_ns
    elif values.size == n:
        return values
    else:
        times, at = other.log_ns, odometry.log_ns
    row = np.searchsorted(times, at, side="right") - 1
    return np.where(row >= 0, values[np.maximum(row, 0)], np.nan)
