"""Faults of the console's own code: logged, and nothing ends with them."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator

from auv_msgs_py.values.errors import printable

#: A fault of one place is logged again after this time, s.
_AGAIN = 60.0


class FaultLog:
    """Logs faults, those of one place at most once in `_AGAIN` s.

    Args:
        log: takes a line.
        clock: returns steady time, s.
    """

    def __init__(self, log: Callable[[str], None], clock: Callable[[], float]) -> None:
        self._log, self._clock = log, clock
        self._logged: dict[str, float] = {}

    @contextlib.contextmanager
    def guard(self, place: str) -> Iterator[None]:
        """Log an exception of the block instead of raising it."""
        try:
            yield
        except Exception as error:  # of whatever kind: the other vehicles and the abort do not depend on it
            self.report(place, error)

    def report(self, place: str, error: Exception) -> None:
        """Log an exception."""
        now = self._clock()
        if place not in self._logged or now - self._logged[place] >= _AGAIN:
            self._logged[place] = now
            self._log(printable(f"the console failed at {place}: {type(error).__name__}: {error}"))
