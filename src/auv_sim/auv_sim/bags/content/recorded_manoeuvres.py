"""What an identification needs of a recording: measured motion, new samples of the log, commands."""

from __future__ import annotations

import contextlib
import dataclasses
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import Convention, FrameIds, FrameTable
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_sim.bags.content.recorded_commands import TimedCommands, on_odometry_clock, timed_commands
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.columns import Columns, decode
from auv_sim.bags.reading.load import run_of
from auv_sim.bags.reading.manoeuvre_topics import missing, renamed, topics_of
from auv_sim.bags.reading.other_makers.foreign_motion import twist_in_body, twist_world, velocity_as_contract
from auv_sim.bags.reading.recording import Bag, RecordedTopic
from auv_sim.flight.run_record import Run, SpatialRun

Column = NDArray[np.float64]
_COMMANDS = (topics.RUDDER_CMD, topics.THRUST_CMD, topics.STERNPLANE_CMD)
#: Stamps that go back by more, in the order of the log, come from a clock that was set, s.
_SET_BACK = 1.0


class Manoeuvring(NamedTuple):
    """A recording of manoeuvres, NED and FRD, SI units, radians.

    Attributes:
        run: poses and rates at the odometries.
        over: velocity over ground at the odometries, (n, 3), m/s; NaN where there is none.
        water_t, water: stamps (s) of the new samples of the velocity through the water, and these, (m, 3).
        rudder, thrust: commands.
        sternplanes: commands; None where there are none.
        notes: what was converted, one line each.
    """

    run: Run
    over: Column
    water_t: Column
    water: Column
    rudder: TimedCommands
    thrust: TimedCommands
    sternplanes: TimedCommands | None
    notes: tuple[str, ...] = ()


def manoeuvres_in(
    path: Path, names: Mapping[str, str] | None = None, namespace: str | None = None,
    odometry: str | None = None, frames: FrameIds | None = None,
) -> Manoeuvring:  # fmt: skip
    """Read the manoeuvres of a recording.

    Args:
        path: of the recording.
        names: name of the wire contract -> full topic name, where a recording has another; see `renamed`.
        namespace: which vehicle, where there are several.
        odometry: full name of the odometry topic.
        frames: accepted frame ids; the contract's if None.

    Raises:
        ConfigurationError: no readable recording, a missing topic, one of another type, unknown frames.
    """
    bag = renamed(read_bag(path, odometry=odometry), names or {})
    found = topics_of(bag, namespace)
    frames = frames or FrameIds()
    found[topics.ODOM], odom, notes = _odometry(bag, found[topics.ODOM], topics.ODOM, frames)
    found[topics.WATER_VELOCITY], of_water = _as_contract(bag, found[topics.WATER_VELOCITY], odom, frames)
    log = _columns(bag, found[topics.WATER_VELOCITY], topics.WATER_VELOCITY)
    motion = {t.name: t for t in (found[topics.ODOM], found[topics.WATER_VELOCITY]) if t is not None}
    planes = found[topics.STERNPLANE_CMD]
    if planes is not None:  # makes a run in three dimensions
        motion[planes.name] = dataclasses.replace(planes, type=topics.STERNPLANE_CMD.type)
    odom_axes = _convention(bag, topics.ODOM, frames, odom.columns.frames)
    log_axes = _convention(bag, topics.WATER_VELOCITY, frames, log.columns.frames)
    run = run_of(dataclasses.replace(bag, topics=motion), namespace, frames)
    _check_clock(path, odom)
    water_t, water = _water(bag, log, log_axes)
    rudder, thrust, sternplanes = (_commands(bag, found[topic], odom) for topic in _COMMANDS)
    if rudder is None or thrust is None:
        raise missing(bag, topics.RUDDER_CMD if rudder is None else topics.THRUST_CMD)
    spatial = sternplanes if isinstance(run, SpatialRun) else None
    return Manoeuvring(
        run, _over(run, odom, odom_axes), water_t, water, rudder, thrust, spatial, notes + of_water
    )


class _Decoded(NamedTuple):
    """Messages of one topic by log time: log times, ns, and columns."""

    log_ns: NDArray[np.int64]
    columns: Columns


def _odometry(
    bag: Bag, topic: RecordedTopic | None, row: Topic, frames: FrameIds
) -> tuple[RecordedTopic, _Decoded, tuple[str, ...]]:
    """Return an odometry with its twist in the body, decoded too, and a line where it was in the world."""
    assert topic is not None
    decoded = _columns(bag, topic, row)
    turned = twist_world(decoded.columns.frames, frames)
    if turned is None:
        return topic, decoded, ()
    world, body = turned
    with _damage(bag, topic):
        topic = twist_in_body(topic, body)
    note = f"{topic.source or topic.name}: a twist in the world frame '{world}', turned by its own attitude"
    return topic, _columns(bag, topic, row), (note,)


def _as_contract(
    bag: Bag, topic: RecordedTopic | None, odom: _Decoded, frames: FrameIds
) -> tuple[RecordedTopic, tuple[str, ...]]:
    """Return the velocity through the water as the contract's type, and a line where it was converted."""
    assert topic is not None
    notes: tuple[str, ...] = ()
    if topic.type == topics.ODOM.type:
        topic, _, notes = _odometry(bag, topic, topics.WATER_VELOCITY, frames)

    def stamp_of(log_ns: NDArray[np.int64]) -> Column:
        return on_odometry_clock(log_ns, odom.log_ns, odom.columns.stamp_ns)

    with _damage(bag, topic):
        return velocity_as_contract(topic, stamp_of), notes


def _commands(bag: Bag, topic: RecordedTopic | None, odom: _Decoded) -> TimedCommands | None:
    """Return the commands of a topic; None if there are none."""
    if topic is None:
        return None
    with _damage(bag, topic):
        return timed_commands(topic, odom.log_ns, odom.columns.stamp_ns)


@contextlib.contextmanager
def _damage(bag: Bag, topic: RecordedTopic) -> Iterator[None]:
    """Turn what damaged bytes raise, which is any exception, into one line."""
    try:
        yield
    except ConfigurationError:
        raise
    except Exception as error:
        found = f"a damaged message ({' '.join(str(error).split())})"
        raise ConfigurationError(f"{bag.path}: {topic.source or topic.name}", found, topic.type) from None


def _columns(bag: Bag, topic: RecordedTopic | None, row: Topic) -> _Decoded:
    assert topic is not None
    order = np.argsort(np.array(topic.log_ns, np.int64), kind="stable")
    kept = [k for k in order if topic.messages[k] is not None]
    with _damage(bag, topic):
        columns = decode(topic.type, [m for k in kept if (m := topic.messages[k]) is not None])
    if len(kept) > 1 and (columns.stamp_ns == columns.stamp_ns[0]).all():
        found = f"the stamp {columns.stamp_ns[0] * 1e-9:.9g} s in every message"
        raise ConfigurationError(f"{bag.path}: {row.name}", found, "the time of each measurement")
    return _Decoded(np.array(topic.log_ns, np.int64)[kept], columns)


def _check_clock(path: Path, odom: _Decoded) -> None:
    """Refuse a clock that was set back: neither order of the messages is that of the motion."""
    back = (np.maximum.accumulate(odom.columns.stamp_ns) - odom.columns.stamp_ns) * 1e-9
    if back.size and back.max() > _SET_BACK:
        at = (odom.log_ns[int(np.argmax(back > _SET_BACK))] - odom.log_ns[0]) * 1e-9
        found = f"stamps that go back by {back.max():.1f} s, {at:.0f} s after the begin"
        raise ConfigurationError(f"{path}: {topics.ODOM.name}", found, "one clock: cut the recording there")


def _convention(bag: Bag, topic: Topic, ids: FrameIds, frames: tuple[tuple[str, ...], ...]) -> Convention:
    """Return the axes of a topic's messages.

    Raises:
        ConfigurationError: frame ids that are unknown, with the option that gives their axes, or that change.
    """
    table = FrameTable(ids)
    names: tuple[str, ...] = ()
    try:
        (names,) = frames
        return table.of_pose(topic.name, *names) if len(names) == 2 else table.of_body(topic.name, *names)
    except MessageRefused as refused:
        expected = f"{refused.expected}, or their axes by --frame {_axes_of(names)}"
        raise ConfigurationError(f"{bag.path}: {refused.topic}", refused.found, expected) from None
    except ValueError:
        listed = " and ".join(map(repr, frames)) or "no frame id"
        raise ConfigurationError(
            f"{bag.path}: {topic.name}", f"frame ids {listed}", "the same in every message"
        ) from None


def _axes_of(names: tuple[str, ...]) -> str:
    """Return what `--frame` takes for frame ids; of an odometry's two the first is the world's."""
    empty_world, empty_body = len(names) == 2 and not names[0], not names[-1]
    if empty_world and empty_body:
        return "=enu --frame =flu or =ned --frame =frd"
    if empty_world:
        return "=enu or =ned"
    return "=flu or =frd" if empty_body else "ID=AXES"


def _velocity(columns: Columns, axes: Convention) -> Column:
    """Return the linear velocity of every message, FRD, (n, 3), m/s."""
    velocity = np.array([columns.column(f"twist.twist.linear.{axis}") for axis in "xyz"]).T
    velocity[:, 1:] *= 1.0 if axes is Convention.NED_FRD else -1.0
    return velocity


def _water(bag: Bag, log: _Decoded, axes: Convention) -> tuple[Column, Column]:
    """Return stamps (s) and values (FRD, m/s) of new samples: a repeated one is no sample.

    Raises:
        ConfigurationError: no message has a finite velocity.
    """
    columns = log.columns
    values = _velocity(columns, axes)
    t = columns.stamp_ns * 1e-9
    order = np.argsort(t, kind="stable")
    t, values = t[order], values[order]
    with_numbers = np.isfinite(values[:, :2]).all(axis=1)
    t, values = t[with_numbers], values[with_numbers]
    if t.size == 0:
        raise ConfigurationError(
            f"{bag.path}: {topics.WATER_VELOCITY.name}", "no finite velocity", "a log that measures the water"
        )
    new = np.append(True, (np.diff(values[:, :2], axis=0) != 0.0).any(axis=1) & (np.diff(t) > 0.0))
    return t[new], values[new]


def _over(run: Run, odom: _Decoded, axes: Convention) -> Column:
    """Return the velocity over ground at the run's stamps, FRD, (n, 3), m/s."""
    over = _velocity(odom.columns, axes)
    stamps = odom.columns.stamp_ns * 1e-9
    order = np.argsort(stamps, kind="stable")
    rows = np.clip(np.searchsorted(stamps[order], run.t), 0, stamps.size - 1)
    found: Column = over[order][rows]
    return found
