"""A simulated cable or acoustic modem between a vehicle and its driver."""

from __future__ import annotations

import heapq
import random
from collections.abc import Iterator
from typing import Any, NamedTuple


class MessageKind(NamedTuple):
    """A kind of message: its period, the delay on its way and the variation of that (all ms)."""

    period: int
    delay: float
    jitter: float


class DelayLine:
    """Delivers each message later, perhaps in another order, perhaps never.

    Args:
        loss: share of the messages that are lost.
        dice: seeded.
    """

    def __init__(self, loss: float, dice: random.Random) -> None:
        self._loss, self._dice = loss, dice
        self._under_way: list[tuple[float, int, Any]] = []
        self._number = 0

    def put(self, now: float, kind: MessageKind, item: Any) -> None:
        """Send an item at `now`, ms."""
        if self._dice.random() < self._loss:
            return
        self._number += 1
        due = now + max(0.0, kind.delay + self._dice.uniform(-kind.jitter, kind.jitter))
        heapq.heappush(self._under_way, (due, self._number, item))

    def take(self, now: float) -> Iterator[Any]:
        """Yield the items that have arrived by `now`, ms."""
        while self._under_way and self._under_way[0][0] <= now:
            yield heapq.heappop(self._under_way)[2]
