"""The mean speed over a window of time, constant in time: a few chords in place of every position."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure

#: Chords per window: summing chords counts a circle as progress but not jitter.
_CHORDS = 6


class Marks(NamedTuple):
    """Positions at the ends of the chords of one window; the newest last.

    Attributes:
        corners: number so far, at most `_CHORDS` + 1.
        time: since the first one, s.
        times, xs, ys: of the corners, s and m.
    """

    corners: int
    time: float
    times: tuple[float, ...]
    xs: tuple[float, ...]
    ys: tuple[float, ...]


_NONE = (0.0,) * (_CHORDS + 1)
NO_MARKS = Marks(0, 0.0, _NONE, _NONE, _NONE)


@pure
def marked(marks: Marks, x: float, y: float, dt: float, window: float) -> tuple[Marks, bool]:
    """Add a position `dt` s after the last; return the marks, and whether a full window's chord ended."""
    count, time, times, xs, ys = marks
    time += dt
    if count > 0 and time - times[-1] < window / _CHORDS:
        return Marks(count, time, times, xs, ys), False
    if dt > window:  # nothing was measured for a whole window
        count, time = 0, 0.0
    count = min(count + 1, _CHORDS + 1)
    corners = Marks(count, time, (*times[1:], time), (*xs[1:], x), (*ys[1:], y))
    return corners, count > _CHORDS


@pure
def covered(marks: Marks) -> float:
    """Return the length of the chords of a full window, m."""
    way = 0.0
    for k in range(_CHORDS):
        way += math.hypot(marks.xs[k + 1] - marks.xs[k], marks.ys[k + 1] - marks.ys[k])
    return way
