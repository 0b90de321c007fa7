"""The columns of a `Run` from the topics of a recording: frames, alignment with the odometry, angles."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import Convention, FrameTable, flip_yaw, swap_axes, yaw_of_quaternion
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.columns import Columns
from auv_sim.bags.reading.held_rows import held_rows
from auv_sim.bags.reading.spatial_columns import spatial_columns
from auv_sim.flight.run_record import Run

_POSITION, _ORIENTATION = "pose.pose.position.", "pose.pose.orientation."
#: The numbers of an odometry that make a pose.
_POSE = (f"{_POSITION}x", f"{_POSITION}y", *(f"{_ORIENTATION}{axis}" for axis in "xyzw"))


class RecordedColumns(NamedTuple):
    """One topic of the bag: log times (n,), ns, and the messages' fields."""

    log_ns: NDArray[np.int64]
    columns: Columns


def assemble(
    recorded: dict[Topic, RecordedColumns], states: list[tuple[int, Any]], table: FrameTable, bag: Path
) -> Run:
    """Return the run of the recorded topics, on the odometry's stamps.

    Args:
        recorded: columns by topic, with the odometry's.
        states: (log time in ns, mission state).
        table: the accepted frame ids.
        bag: the recording, for messages.

    Raises:
        ConfigurationError: frame ids change.
        MessageRefused: frame ids are unknown.
    """
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
    sway = _sway_sign(recorded, table, bag)
    dives = any(topic in recorded for topic in topics.SPATIAL_PER_STEP)
    run = Run.from_columns(
        (spatial_columns(odometry.columns.column, aligned, convention, sway) if dives else {})
        | {
            "t": odometry.columns.stamp_ns * 1e-9,
            "x": x,
            "y": y,
            "psi": psi,
            "r": turn,
            "ur": aligned(topics.WATER_VELOCITY, "twist.twist.linear.x"),
            "vr": sway * aligned(topics.WATER_VELOCITY, "twist.twist.linear.y"),
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


def _sway_sign(recorded: dict[Topic, RecordedColumns], table: FrameTable, bag: Path) -> float:
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


def _aligned(odometry: RecordedColumns, other: RecordedColumns | None, field: str) -> NDArray[np.float64]:
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
