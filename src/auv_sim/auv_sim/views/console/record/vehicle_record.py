"""All that the console shows of one vehicle, and what of it has changed since the last look."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_sim.views.console.record import health_board, readiness
from auv_sim.views.console.record.alarm_list import AlarmList
from auv_sim.views.console.record.event_list import EventList
from auv_sim.views.console.record.health_board import ERROR, SILENT, HealthBoard
from auv_sim.views.console.record.history import History
from auv_sim.views.console.record.mission_progress import MissionProgress
from auv_sim.views.console.record.readiness import CHAIN, NAVIGATION, PlanLines
from auv_sim.views.console.record.track_columns import NAMES, OF_ODOMETRY
from auv_sim.views.console.record.track_file import TrackFile
from auv_sim.views.console.record.wire_messages import rows_message, text_of

#: A tick is sent at least this often, s.
_SLOWEST = 1.0
#: Most rows of a message.
_PIECE = 1000
#: A hold by an operator is no alarm; any other one is.
_ASKED = "hold was called"
#: Guidance reports a mission that holds or has ended as an error of its own; the state is an alarm already.
_STATES = tuple(f"{state}:" for state in MissionState)


@dataclasses.dataclass
class Sighting:
    """The newest values that are drawn on the chart; ENU, m and rad; None: not heard."""

    stamp: float = math.nan
    pose: tuple[float, float, float, float, float] | None = None
    virtual_point: tuple[float, float, float] | None = None
    current: tuple[float, float, float] | None = None
    covariance: tuple[float, float, float] | None = None


class VehicleRecord:
    """One vehicle.

    Args:
        index: its number in messages.
        namespace: of its nodes.
        tracks: directory of kept tracks; None keeps none.

    Attributes:
        seen: the newest values on the chart.
        values: column -> newest value, for the next row.
        progress: the mission's state and figures.
        course: path, joints, fence, origin and mission, as the page takes them.
        plan: what the check of the mission found; None before it was made.
    """

    def __init__(self, index: int, namespace: str, tracks: Path | None = None) -> None:
        self.index, self.namespace = index, namespace
        self.seen = Sighting()
        self.values: dict[str, float] = {}
        self.history, self.events, self.alarms = History(), EventList(), AlarmList()
        self.health = HealthBoard((*CHAIN, NAVIGATION))
        self.progress = MissionProgress()
        self.course: dict[str, Any] | None = None
        self.plan: PlanLines | None = None
        self.epoch, self.t0 = 0, math.nan
        self._tracks, self._file = tracks, TrackFile(None, "")
        self._older = math.nan  # an odometry that was older than the one before
        self._fresh: list[Any] = []  # rows that were not sent yet
        self._sent_events, self._is_course_new, self._is_epoch_new = 0, False, False
        self._has_acknowledged = False
        self._halved, self._last_tick, self._ticked_at = 0, "", -math.inf

    def belongs_to(self, publisher: str) -> None:
        """Take the publisher of the odometry: its track is continued, that of any other one is not."""
        self._file = TrackFile(self._tracks, publisher)
        kept = self._file.read()
        if kept is not None and not self.history.taken:
            self.t0, rows = kept
            self.history.restore(rows)
            self.seen.stamp = self.t0 + float(rows[-1, 0])
            self.epoch, self._is_epoch_new = self.epoch + 1, True
        elif self.history.taken:
            self.forget(NAMES)
            self._begin(math.nan)

    def take_row(self, stamp: float) -> bool:
        """Append a row of the newest values; return whether it was taken.

        A lone stamp that is older than the last one is left out. Two that continue each other mean that time
        went back: the table begins anew.

        Args:
            stamp: of the odometry, s.
        """
        last = self.seen.stamp
        if stamp <= last:
            if not (stamp > self._older):
                self._older = stamp
                return False
            self.forget(name for name in NAMES if name not in OF_ODOMETRY)
            self._begin(stamp)
        self._older = math.nan
        if math.isnan(self.t0):
            self._begin(stamp)
        self.seen.stamp = stamp
        row = self.history.append({**self.values, "t": stamp - self.t0})
        self._fresh.append(row.copy())
        return True

    def forget(self, columns: Iterable[str]) -> None:
        """Leave the values of some columns out of the rows that follow."""
        for name in columns:
            self.values.pop(name, None)
            if name == "s":
                self.progress.to_go = math.nan

    def _begin(self, stamp: float) -> None:
        if self.history.taken:  # what was seen is of another time
            self.seen = Sighting()
        self.history, self._fresh, self._halved = History(), [], 0
        self.epoch, self.t0, self._is_epoch_new = self.epoch + 1, stamp, True
        self.seen.stamp = math.nan
        if math.isfinite(stamp):
            self._file.begin(stamp, self.history.rows)

    def set_course(self, course: dict[str, Any], plan: PlanLines | None) -> None:
        """Take another path, fence, origin or mission."""
        self.course, self.plan, self._is_course_new = course, plan, True

    def changes(self, now: float) -> list[str | bytes]:
        """Return what has changed since the last call, as messages; `now` is steady time, s."""
        found: list[str | bytes] = []
        if self._is_course_new:
            found.append(self._course_message())
        if self._is_epoch_new:
            found += [self._begin_message(), *self._all_rows()]
            self._keep(b"", anew=True)
        elif self._fresh:
            rows = np.array(self._fresh)
            found.append(rows_message(self.index, self.epoch, self.history.taken - len(rows), rows))
            self._keep(rows.astype("<f4").tobytes(), anew=self.history.halved != self._halved)
        self._fresh, self._is_epoch_new, self._is_course_new = [], False, False
        self._halved = self.history.halved
        if events := self.events.after(self._sent_events):
            self._sent_events = self.events.last_number
            found.append(text_of("events", vehicle=self.index, events=events))
        if self.alarms.update(self._conditions(now), self.progress.mission_time) or self._has_acknowledged:
            self._has_acknowledged = False
            found.append(self._alarm_message())
        tick = self.tick(now)
        if tick != self._last_tick or now - self._ticked_at >= _SLOWEST:
            self._last_tick, self._ticked_at = tick, now
            found.append(tick)
        return found

    def whole(self, now: float) -> list[str | bytes]:
        """Return everything, for a browser that comes now; call `changes` before."""
        found: list[str | bytes] = [self._course_message()] if self.course is not None else []
        found += [self._begin_message(), *self._all_rows()]
        events = self.events.after(0)
        return [
            *found,
            text_of("events", vehicle=self.index, events=events),
            self._alarm_message(),
            self.tick(now),
        ]

    def acknowledge(self, number: int) -> bool:
        """Acknowledge an alarm; return whether there is one of this number."""
        is_there = self.alarms.acknowledge(number)
        self._has_acknowledged |= is_there
        return is_there

    def tick(self, now: float) -> str:
        """Return the newest values as a message."""
        seen, progress = self.seen, self.progress
        guidance = self.health.of(topics.GUIDANCE, now)
        ready = readiness.preflight(self.health, self.plan, progress.state, now)
        return text_of(
            "tick", vehicle=self.index, now=seen.stamp, fresh=guidance.level != SILENT,
            **progress.figures(seen.stamp, self.history, self.course),
            pose=seen.pose, virtual_point=seen.virtual_point, current=seen.current,
            covariance=seen.covariance, health=health_board.as_json(self.health.table(now)),
            preflight=ready, can=readiness.buttons(progress.state, ready["ready"]),
        )  # fmt: skip

    def start_refusal(self, digest: object, now: float) -> str:
        """Return why a start is refused; empty if it is not.

        Args:
            digest: of the mission that the page shows; None where it did not say.
            now: steady time, s.
        """
        progress = self.progress
        if digest is not None and digest != progress.status.get("digest"):
            return "the page shows another mission than guidance has: look at the mission again"
        checked = readiness.preflight(self.health, self.plan, progress.state, now)
        return readiness.start_refusal(checked, progress.state)

    def _conditions(self, now: float) -> Mapping[str, str]:
        """Return what is an alarm now: key -> text."""
        found = {}
        progress = self.progress
        for row in self.health.table(now):
            if (
                row.level == SILENT
                and row.age is not None
                and (row.node != NAVIGATION or progress.state == MissionState.RUNNING)
            ):
                found[f"silent {row.node}"] = f"{row.node} is silent"
            elif row.level == ERROR and not row.message.startswith(_STATES):
                found[f"error {row.node}"] = f"{row.node}: {row.message}"
        if progress.state == MissionState.ABORTED:
            found[f"aborted {progress.reason}"] = f"mission aborted: {progress.reason}"
        if progress.state == MissionState.HOLDING and progress.reason != _ASKED:
            found["holding"] = f"mission holds: {progress.reason}"
        return found

    def _keep(self, rows: bytes, anew: bool) -> None:
        if anew and math.isfinite(self.t0):
            self._file.begin(self.t0, self.history.rows)
        else:
            self._file.append(rows)

    def _all_rows(self) -> Sequence[str | bytes]:
        """Return all rows in pieces: a ping must find its way between them."""
        rows, first = self.history.rows, self.history.taken - len(self.history.rows)
        return [
            rows_message(self.index, self.epoch, first + k, rows[k : k + _PIECE])
            for k in range(0, len(rows), _PIECE)
        ]

    def _begin_message(self) -> str:
        return text_of("begin", vehicle=self.index, epoch=self.epoch, t0=self.t0)

    def _course_message(self) -> str:
        return text_of("course", vehicle=self.index, **(self.course or {}))

    def _alarm_message(self) -> str:
        return text_of("alarms", vehicle=self.index, alarms=self.alarms.as_json())
