"""Parts of a recording without commands while the odometry goes on.

A vehicle stops a second after its last command, another one sooner or never. What its fins do meanwhile is in
no recording, and commands that are taken as held put b wrong by 10 to 15 % after a few seconds.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.time_grid import LONGEST_GAP

#: Share of commands equal to the one before from which on commands are taken as sent at a rate. With a
#: smaller share they count as sent when they change, and hold until the next one: a rudder in a closed loop
#: that falls silent alone is not noticed.
_REPEATED = 0.1
#: Fewer commands show no rate.
_FEWEST = 20
#: A silence is longer than this many usual intervals (95 % are shorter than the usual one).
_INTERVALS, _USUAL = 3.0, 0.95


def silences(streams: Iterable[tuple[Numbers, Numbers]], end: float) -> list[tuple[float, float]]:
    """Return the intervals in which any one kind of command is silent: last command and next one, s, rising.

    Args:
        streams: times (s, rising) and values of the commands of each kind.
        end: of the recording, s; a silence that lasts until then ends at infinity.
    """
    found = []
    for t, value in streams:
        if t.size < _FEWEST or float(np.mean(np.diff(value) == 0.0)) < _REPEATED:
            continue
        intervals = np.diff(t)
        longest = max(LONGEST_GAP, _INTERVALS * float(np.quantile(intervals, _USUAL)))
        silent = np.append(intervals, end - t[-1]) >= longest
        found += list(zip(t[silent], np.append(t, np.inf)[1:][silent], strict=True))
    joined: list[tuple[float, float]] = []
    for last, following in sorted((float(last), float(following)) for last, following in found):
        if joined and last <= joined[-1][1]:
            joined[-1] = joined[-1][0], max(joined[-1][1], following)
        else:
            joined.append((last, following))
    return joined


def outside(spans: Iterable[tuple[float, float]], t: Numbers) -> NDArray[np.bool_]:
    """Return which times lie within none of the open intervals, shape (n,)."""
    kept = np.ones(t.size, bool)
    for begin, end in spans:
        kept &= (t <= begin) | (t >= end)
    return kept
