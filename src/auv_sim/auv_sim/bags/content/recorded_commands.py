"""Commands of a recording: numbers, on the clock of the odometry's stamps."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.reading.other_makers.message_parts import number_in
from auv_sim.bags.reading.recording import RecordedTopic

Column = NDArray[np.float64]
Times = NDArray[np.int64]
#: Commands count from the last one that is older than the first odometry by this time, s.
_BEFORE = 5.0


class TimedCommands(NamedTuple):
    """Commands of one kind: times of the odometry's clock (s), and values (rad, N or per cent)."""

    t: Column
    value: Column


def timed_commands(topic: RecordedTopic, odom_log_ns: Times, odom_stamp_ns: Times) -> TimedCommands | None:
    """Return commands on the odometry's clock; None where no finite one is logged up to the last odometry.

    Where one command is logged after each odometry and before the next one, it belongs to that odometry's
    stamp (lockstep); others to the time by the log's clock, between the odometries around it. The last
    commands before the first odometry count too: some vehicles send one only when it changes.

    Args:
        topic: of the commands, each one number.
        odom_log_ns, odom_stamp_ns: log times and stamps of the odometries by log time, ns, (n,).
    """
    if not topic.count:
        return None
    log_ns, value = _logged(topic)
    stamps = odom_stamp_ns * 1e-9
    if _answers_each(log_ns, odom_log_ns):
        t = stamps
    else:
        t = on_odometry_clock(log_ns, odom_log_ns, odom_stamp_ns)
    kept = np.isfinite(t) & np.isfinite(value)
    if not kept.any():
        return None
    order = np.argsort(t[kept], kind="stable")
    t, value = t[kept][order], value[kept][order]
    first = max(int(np.searchsorted(t, stamps[0] - _BEFORE, side="right")) - 1, 0)
    return TimedCommands(t[first:], value[first:])


def on_odometry_clock(log_ns: Times, odom_log_ns: Times, odom_stamp_ns: Times) -> Column:
    """Return log times as times of the odometry's stamps, s; NaN after the last odometry.

    Args:
        log_ns: log times, ns.
        odom_log_ns, odom_stamp_ns: log times and stamps of the odometries by log time, ns, (n,).
    """
    logged = (log_ns - odom_log_ns[0]) * 1e-9
    own, stamps = (odom_log_ns - odom_log_ns[0]) * 1e-9, odom_stamp_ns * 1e-9
    growing = np.append(True, np.diff(np.maximum.accumulate(own)) > 0.0)
    t: Column = np.interp(logged, own[growing], stamps[growing], right=np.nan) + np.minimum(logged, 0.0)
    return t


def _logged(topic: RecordedTopic) -> tuple[Times, Column]:
    """Return log times (ns) and numbers of a topic's messages, by log time."""
    decoder = deserializer(topic)
    log_ns, values = [], []
    for at in np.argsort(np.array(topic.log_ns, np.int64), kind="stable"):
        data: Any = topic.messages[at]
        if data is not None:
            log_ns.append(topic.log_ns[at])
            values.append(number_in(decoder(data), topic.part))
    return np.array(log_ns, np.int64), np.array(values)


def _answers_each(commands_ns: Times, odometry_ns: Times) -> bool:
    """Return whether each odometry has one command, logged between it and the next odometry."""
    if commands_ns.size != odometry_ns.size:
        return False
    return bool((commands_ns >= odometry_ns).all() and (commands_ns[:-1] < odometry_ns[1:]).all())
