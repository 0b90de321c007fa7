"""Events of a recording in their order: states, switches, saturation, diagnostics, warnings."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.bags.reading.load import messages_of
from auv_sim.bags.reading.recording import Bag
from auv_sim.flight.metrics import under_way

_LEVELS = {0: "OK", 1: "WARN", 2: "ERROR", 3: "STALE"}
#: Level of a mission's state, as of `_LEVELS`; 0 for the others.
_STATE_LEVELS: dict[str, int] = {MissionState.HOLDING: 1, MissionState.ABORTED: 2}
_LOG_WARNING = 30
_LOG_NAMES = {30: "WARN", 40: "ERROR", 50: "FATAL"}
#: Shorter interruptions do not divide a saturation, s.
_SAME = 0.5


@dataclass(frozen=True)
class Event:
    """One event.

    Attributes:
        time: recorded time, s.
        kind: state, switch, saturation, rate limit, diagnostics, log.
        text: one line.
        level: 0 normal, 1 warning, 2 error.
    """

    time: float
    kind: str
    text: str
    level: int = 0


def events_of(flight: RecordedMission) -> list[Event]:
    """Return all events by time."""
    bag = flight.bag
    found = [*_states(bag), *_diagnostics(bag), *_log(bag)]
    for part in flight.missions:
        found += _flown(part)
    return sorted(found, key=lambda event: event.time)


def _messages(bag: Bag, name: str) -> list[tuple[int, Any]]:
    found = []
    for topic in bag.topics.values():
        if topic.name.rsplit("/", 1)[-1] == name.rsplit("/", 1)[-1]:
            try:
                found += messages_of(topic)
            except ConfigurationError:
                continue
    return found


def _states(bag: Bag) -> list[Event]:
    """Return each change of a mission's state, without its repetitions once a second."""
    events = []
    for topic in bag.topics.values():
        if topic.name.rsplit("/", 1)[-1] != topics.MISSION_STATE.name:
            continue
        with contextlib.suppress(ConfigurationError):
            for word, same in groupby(messages_of(topic), key=lambda item: str(item[1].data)):
                at = next(same)[0]
                events.append(Event(at * 1e-9, "state", word, _STATE_LEVELS.get(word, 0)))
    return events


def _diagnostics(bag: Bag) -> list[Event]:
    """Return each change of a status, from the first that is not OK on."""
    last: dict[str, tuple[int, str]] = {}
    events = []
    for at, array in _messages(bag, topics.DIAGNOSTICS.name):
        for status in array.status:
            level = int(status.level[0]) if isinstance(status.level, bytes) else int(status.level)
            before = last.get(status.name, (0, ""))
            changed = level != before[0] or (level > 0 and status.message != before[1])
            last[status.name] = level, status.message
            if changed:
                text = f"{status.name}: {status.message or _LEVELS.get(level, str(level))}"
                events.append(Event(at * 1e-9, "diagnostics", text, min(level, 2)))
    return events


def _log(bag: Bag) -> list[Event]:
    return [
        Event(
            at * 1e-9,
            "log",
            f"{_LOG_NAMES.get(log.level, log.level)} {log.name}: {log.msg}",
            2 if log.level > _LOG_WARNING else 1,
        )
        for at, log in _messages(bag, "/rosout")
        if log.level >= _LOG_WARNING
    ]


def _flown(flight: RecordedMission) -> list[Event]:
    run, mission, hull = flight.run, flight.mission, flight.vehicle
    if run is None:
        return []
    n = mission.path.n if mission is not None else 10**9
    flown = under_way(run, n) if mission is not None else run
    if not flown.steps:
        return []
    index = flown.subpath(n)
    events = [
        Event(float(flown.t[k]), "switch", f"on to subpath {index[k] + 1}")
        for k in 1 + np.flatnonzero(np.diff(index) != 0)
    ]
    if hull is not None:
        at_stop = np.abs(flown.rudder_cmd) >= hull.rudder.max_angle * (1 - 1e-6)
        events += _intervals(flown.t, at_stop, "saturation", "rudder command at its limit")
        rudder = flown.rudder if np.isfinite(flown.rudder).any() else flown.rudder_cmd
        elapsed = np.maximum(np.diff(flown.t), 1e-9)
        fast = np.abs(np.diff(rudder)) / elapsed >= hull.rudder.max_rate * (1 - 1e-6)
        events += _intervals(flown.t[1:], fast, "rate limit", "rudder at its fastest")
    return events


def _intervals(t: NDArray[np.float64], active: NDArray[np.bool_], kind: str, text: str) -> list[Event]:
    """Return one event for each interval in which `active` holds."""
    rows = np.flatnonzero(active)
    if not rows.size:
        return []
    breaks = np.flatnonzero(np.diff(t[rows]) > _SAME)
    firsts, lasts = rows[np.r_[0, breaks + 1]], rows[np.r_[breaks, rows.size - 1]]
    return [
        Event(float(t[a]), kind, f"{text} for {t[b] - t[a]:.2f} s" if b > a else text, 1)
        for a, b in zip(firsts, lasts, strict=True)
    ]


def diagnostic_spans(bag: Bag) -> dict[str, list[tuple[float, float, int, str]]]:
    """Return status name -> intervals (from, to, level, message) of equal level and message, s."""
    spans: dict[str, list[tuple[float, float, int, str]]] = {}
    for at, array in _messages(bag, topics.DIAGNOSTICS.name):
        time = at * 1e-9
        for status in array.status:
            level = int(status.level[0]) if isinstance(status.level, bytes) else int(status.level)
            parts = spans.setdefault(status.name, [])
            if parts and parts[-1][2:] == (level, status.message):
                parts[-1] = (parts[-1][0], time, level, status.message)
            else:
                if parts:
                    parts[-1] = (parts[-1][0], time, *parts[-1][2:])
                parts.append((time, time, level, status.message))
    return spans
