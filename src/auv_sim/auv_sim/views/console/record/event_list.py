"""What happened to a vehicle, one line each, in bounded memory."""

from __future__ import annotations

from collections import deque
from typing import Any

#: Most events that are kept.
MOST_EVENTS = 2000
#: An event with the text of one of the last few is the same event, reported twice.
_RECENT = 5
_LONGEST = 1000


class EventList:
    """Events, numbered from 1."""

    def __init__(self) -> None:
        self._events: deque[dict[str, Any]] = deque(maxlen=MOST_EVENTS)
        self._number = 0

    def add(self, text: str, source: str, level: str, mission_time: float | None, wall: float) -> None:
        """Append an event unless it was just reported.

        Args:
            text: for people.
            source: the node.
            level: info, warning or error.
            mission_time: at its arrival, s; None before a mission.
            wall: the machine's time of the event, s.
        """
        text = text[:_LONGEST]
        recent = list(self._events)[-_RECENT:]
        if any((event["text"], event["source"]) == (text, source) and wall - event["wall"] < 1.0
               for event in recent):  # fmt: skip
            return
        self._number += 1
        self._events.append(
            {
                "id": self._number, "mission_time": mission_time, "wall": wall, "source": source,
                "level": level, "text": text,
            }
        )  # fmt: skip

    @property
    def last_number(self) -> int:
        """Number of the newest event; 0 before the first."""
        return self._number

    def after(self, number: int) -> list[dict[str, Any]]:
        """Return the events after one, oldest first."""
        return [event for event in self._events if event["id"] > number]
