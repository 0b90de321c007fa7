"""Counts lost messages by the sequence numbers of their publishers. ROS-free."""

from __future__ import annotations


class SequenceWatch:
    """Watches one topic. Numbers increase by one for each publisher; the publisher of a number is unknown.

    A number that continues no known publisher belongs to a new one while there are more publishers than known
    ones, or when it is 1; otherwise it shows a gap of a known one.
    """

    def __init__(self) -> None:
        self.lost = 0
        self._next: list[int] = []
        self._first = -1

    def note(self, number: int, publishers: int) -> None:
        """Process one number (0: the middleware gives none); `publishers` is their present count."""
        if number == self._first:
            self._first += 1
            return
        self._slowly(number, publishers)

    def _slowly(self, number: int, publishers: int) -> None:
        if number <= 0:
            return
        if self._first > 0:
            self._next[0] = self._first
        known = self._next
        if number in known:
            k = known.index(number)
        else:
            behind = [k for k, expected in enumerate(known) if expected < number]
            if not known or not behind or number == 1 or len(known) < publishers:
                known.append(number)
                k = len(known) - 1
            else:
                k = max(behind, key=known.__getitem__)
                self.lost += number - known[k]
        known[k] = number + 1
        # The publisher of the last message is checked first.
        known[0], known[k] = known[k], known[0]
        self._first = known[0]
