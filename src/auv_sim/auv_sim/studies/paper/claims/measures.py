"""Measures runs: settling, steady errors, deviations at joints, rates of decay."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.metrics import root_mean_square
from auv_sim.flight.path_cells import CORNER_RADIUS
from auv_sim.flight.run_record import Column, Run

#: After a joint a subpath counts as steady from here on, m of path.
RUN_IN = 30.0


def distance(run: Run, path: CompositePath) -> Column:
    """Return the distance to the path, m, shape (n,)."""
    return path.distance(run.x, run.y, run.subpath(path.n))


def steady(run: Run, path: CompositePath, subpath: int) -> NDArray[np.bool_]:
    """Return the rows on a subpath (from 0), `RUN_IN` off its beginning and off a G0 joint at its end."""
    length = path.segments[subpath].length
    along = (run.s - subpath) * length
    rows = (run.subpath(path.n) == subpath) & (along > min(RUN_IN, 0.5 * length))
    if subpath < len(path.joints) and path.joints[subpath].geometric == "G0":
        rows &= along < length - RUN_IN
    return np.asarray(rows)


def completed(run: Run, path: CompositePath) -> bool:
    """Whether the end of the path was reached."""
    return bool(run.s[-1] >= path.n)


def steady_distance(run: Run, path: CompositePath, subpath: int) -> float:
    """Return the rms distance (m) on the steady part of a subpath (from 0); infinite if never reached."""
    rows = steady(run, path, subpath)
    return root_mean_square(distance(run, path)[rows]) if rows.any() else math.inf


def settling_time(run: Run, path: CompositePath, band: float) -> float:
    """Return the time after which |ye| stays below `band` (m) on the first subpath, s; infinite if never."""
    first = run.subpath(path.n) == 0
    if path.joints and path.joints[0].geometric == "G0":
        first &= run.s * path.segments[0].length < path.segments[0].length - RUN_IN
    outside = np.flatnonzero(first & (np.abs(run.ye) > band))
    if not outside.size:
        return 0.0
    last = int(outside[-1])
    return float(run.t[last] - run.t[0]) if last < np.flatnonzero(first)[-1] else math.inf


def at_joint(run: Run, path: CompositePath, joint: int) -> float:
    """Return the largest distance to the path (m) near a joint (from 0); infinite if never there."""
    j, subpath = path.joints[joint], run.subpath(path.n)
    near = np.hypot(run.x - j.x, run.y - j.y) < CORNER_RADIUS
    near &= (subpath == joint) | (subpath == joint + 1)
    return float(distance(run, path)[near].max()) if near.any() else math.inf


def rudder_rate(run: Run) -> Column:
    """Return the rate of the commanded rudder, rad/s, shape (n - 2,): the last command is the stop."""
    return np.asarray(np.diff(run.rudder_cmd[:-1]) / np.diff(run.t[:-1]))


class Decay(NamedTuple):
    """Exponential decay fitted to a signal: rate (1/s) and how well it fits (R squared, 1 is perfect)."""

    rate: float
    fit: float


def envelope(size: Column) -> Column:
    """Return the largest value from each row on, which bounds an oscillation."""
    return np.asarray(np.maximum.accumulate(size[::-1])[::-1])


def decay(t: Column, size: Column, largest: float, smallest: float) -> Decay:
    """Fit log(size) by a line while the signal falls from `largest` to `smallest`.

    Args:
        t, size: shape (n,), the size not negative.
        largest: the fit begins where the signal is below this for good.
        smallest: and ends where it is first below this.
    """
    above = np.flatnonzero(size > largest)
    begin = int(above[-1]) + 1 if above.size else 0
    below = np.flatnonzero(size[begin:] < smallest)
    end = begin + int(below[0]) if below.size else len(size)
    if end - begin < 5:
        return Decay(math.nan, 0.0)
    x, y = t[begin:end], np.log(size[begin:end])
    slope, offset = np.polyfit(x, y, 1)
    spread = float(np.sum((y - y.mean()) ** 2))
    rest = float(np.sum((y - slope * x - offset) ** 2))
    return Decay(-float(slope), 1.0 - rest / spread if spread > 0.0 else 0.0)
