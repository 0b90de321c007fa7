"""The rows of one vehicle since its simulation began, in bounded memory."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from auv_sim.views.console.record.track_columns import NAMES

Rows = npt.NDArray[np.float32]

#: Most rows that are kept: 10 MB.
MOST_ROWS = 100_000
_FIRST_ROWS = 1024


class History:
    """Rows of float32. At `most` rows every second one is dropped, so the oldest part is the coarsest.

    Args:
        most: bound of the number of rows.

    Attributes:
        taken: number of rows that were ever appended.
        halved: how often rows were dropped.
    """

    def __init__(self, most: int = MOST_ROWS) -> None:
        self._most = most
        self._rows: Rows = np.empty((min(_FIRST_ROWS, most), len(NAMES)), np.float32)
        self._count = 0
        self.taken = 0
        self.halved = 0

    @property
    def rows(self) -> Rows:
        """The rows that are kept; a view, valid until the next change."""
        return self._rows[: self._count]

    def append(self, values: Mapping[str, float]) -> Rows:
        """Append a row and return it.

        Args:
            values: column -> value; a column without one is NaN.
        """
        if self._count == self._most:
            self._halve()
        if self._count == len(self._rows):
            self._grow()
        row: Rows = self._rows[self._count]
        row[:] = [values.get(name, math.nan) for name in NAMES]
        self._count += 1
        self.taken += 1
        return row

    def restore(self, rows: Rows) -> None:
        """Take the rows of an earlier process in place of those here."""
        kept = rows[-self._most :]
        self._rows = np.array(kept, np.float32).reshape(-1, len(NAMES))
        self._count = self.taken = len(kept)

    def _halve(self) -> None:
        """Keep every second row, the newest among them."""
        kept = self._rows[: self._count][(self._count - 1) % 2 :: 2].copy()
        self._rows[: len(kept)] = kept
        self._count = len(kept)
        self.halved += 1

    def _grow(self) -> None:
        size = min(max(2 * len(self._rows), _FIRST_ROWS), self._most)
        grown = np.empty((size, self._rows.shape[1]), np.float32)
        grown[: self._count] = self._rows[: self._count]
        self._rows = grown
