"""Alarms that stay until they are acknowledged."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any


@dataclasses.dataclass
class Alarm:
    """One alarm.

    Attributes:
        id: its number.
        text: for people.
        since: mission time at which it began, s; None before a mission.
        active: whether its condition lasts.
        acknowledged: by an operator.
    """

    id: int
    text: str
    since: float | None
    active: bool = True
    acknowledged: bool = False


class AlarmList:
    """An alarm leaves when it is both acknowledged and no longer active."""

    def __init__(self) -> None:
        self._alarms: dict[str, Alarm] = {}
        self._number = 0

    def update(self, conditions: Mapping[str, str], since: float | None) -> bool:
        """Take the conditions that last now; return whether the list has changed.

        Args:
            conditions: key -> text.
            since: mission time for alarms that begin, s.
        """
        before = self.as_json()
        for key, text in conditions.items():
            alarm = self._alarms.get(key)
            if alarm is None:
                self._number += 1
                self._alarms[key] = Alarm(self._number, text, since)
            elif not alarm.active:  # it is back: an acknowledgement of the last time does not count
                alarm.active, alarm.acknowledged, alarm.text, alarm.since = True, False, text, since
            else:
                alarm.text = text
        for key, alarm in self._alarms.items():
            alarm.active = key in conditions
        self._alarms = {k: a for k, a in self._alarms.items() if a.active or not a.acknowledged}
        return self.as_json() != before

    def acknowledge(self, number: int) -> bool:
        """Acknowledge an alarm; return whether there is one of this number."""
        for key, alarm in list(self._alarms.items()):
            if alarm.id == number:
                alarm.acknowledged = True
                if not alarm.active:
                    del self._alarms[key]
                return True
        return False

    def as_json(self) -> list[dict[str, Any]]:
        """Return the list for the page, oldest first."""
        return [dataclasses.asdict(alarm) for alarm in self._alarms.values()]
