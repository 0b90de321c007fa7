"""The share of a path that was flown, as guidance sees it."""

from __future__ import annotations


class FlownLength:
    """Counts what is left of the path as it becomes less, but no jump.

    A rejoin after a hold, and a place to begin behind the path's start, leave out a part of it: that part was
    not flown.

    Args:
        length: of the path, m.
    """

    def __init__(self, length: float) -> None:
        self._length, self._flown = length, 0.0
        self._least: float | None = None

    @property
    def share(self) -> float:
        """From 0 to 1."""
        return self._flown / self._length

    def update(self, to_go: float, jumps: bool) -> None:
        """Take what is left of the path, m; `jumps` where P was put elsewhere, or is not on the path."""
        to_go = min(to_go, self._length)
        if not jumps and self._least is not None:
            self._flown = min(self._flown + max(self._least - to_go, 0.0), self._length)
        self._least = to_go if jumps or self._least is None else min(self._least, to_go)
