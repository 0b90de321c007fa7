"""The rows of a path, made from its segments at their first look-up."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import Final

from auv_path_following.curves.joints import Joint
from auv_path_following.curves.outline import last_stretch
from auv_path_following.curves.rows import (
    CORNER,
    CUBIC,
    CUBIC_WIDTH,
    END,
    FITTED,
    FITTED_WIDTH,
    KIND,
    LENGTH,
    SMOOTH,
    Row,
)
from auv_path_following.curves.segment import Segment

_WIDTHS = {CUBIC: CUBIC_WIDTH, FITTED: FITTED_WIDTH}
_LOCK = threading.Lock()


class Subpaths(dict[int, Row]):
    """Row of each subpath, by its index from 0.

    A row is made at its first look-up, because a path may have many thousands of subpaths; every further
    look-up is a dictionary's.

    Args:
        segments, joints: of the path.
        after: length of path after each segment, m.
    """

    def __init__(self, segments: Sequence[Segment], joints: Sequence[Joint], after: Sequence[float]) -> None:
        self._segments: Final = segments
        self._joints: Final = joints
        self._after: Final = after
        #: `PathRows.piece`.
        self.piece: Final[list[float]] = []
        # A path that repeats itself holds one segment many times; its pieces are kept once.
        self._shapes: Final[dict[int, list[float]]] = {}

    def __missing__(self, i: int) -> Row:
        with _LOCK:
            row = self.get(i)
            if row is None:
                row = self[i] = self._row(i)
        return row

    def _row(self, i: int) -> Row:
        segment = self._segments[i]
        shape = self._shapes.get(id(segment))
        if shape is None:
            shape = self._shapes[id(segment)] = self._shape(segment)
        length, speed = segment.length, segment.evaluate(0.0).speed
        if i == len(self._joints):
            return (*shape, length, 0.0, speed, END, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        joint = self._joints[i]
        kind = CORNER if joint.geometric == "G0" else SMOOTH
        widest = 0.5 * min(length, self._segments[i + 1].length)
        at = (kind, joint.x, joint.y, last_stretch(segment), joint.chi_in, joint.chi_out, widest, 0.0)
        return (*shape, length, self._after[i], speed, *at)

    def _shape(self, segment: Segment) -> list[float]:
        """Return kind and numbers of a segment; pieces are replaced by their place in `piece`."""
        row = segment.row()
        width = _WIDTHS.get(abs(row[KIND]))
        if width is not None:
            place = [row[KIND], float(len(self.piece)), float((len(row) - 1) // width)]
            self.piece.extend(row[1:])
            row = place
        return row + [0.0] * (LENGTH - len(row))
