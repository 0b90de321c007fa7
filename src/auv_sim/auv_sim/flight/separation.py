"""The distance between vehicles over time."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from auv_sim.flight.run_record import Column, Run, SpatialRun


@dataclass(frozen=True)
class Separation:
    """The distance between two vehicles while both are recorded.

    Attributes:
        vehicles: their names.
        t, distance: stamps (s) and distances there (m), shape (n,).
    """

    vehicles: tuple[str, str]
    t: Column
    distance: Column

    @property
    def closest(self) -> tuple[float, float]:
        """The least distance, m, and its time, s; NaN without a common time."""
        if not len(self.t):
            return float("nan"), float("nan")
        k = int(np.argmin(self.distance))
        return float(self.distance[k]), float(self.t[k])


def separation(first: tuple[str, Run], second: tuple[str, Run]) -> Separation:
    """Return the distance between two vehicles, at the stamps of the first one.

    The second one's position is interpolated linearly between its stamps. True positions count where they
    were recorded. A vehicle without depth is at the surface.

    Args:
        first, second: name and recording.
    """
    (name, run), (other_name, other) = first, second
    span = (run.t >= other.t[0]) & (run.t <= other.t[-1]) if other.steps else np.zeros(run.steps, bool)
    t = run.t[span]
    squares = np.zeros(len(t))
    for own, theirs in zip(_position(run), _position(other), strict=True):
        squares += (own[span] - np.interp(t, other.t, theirs)) ** 2 if len(t) else 0.0
    return Separation((name, other_name), t, np.sqrt(squares))


def separations(runs: dict[str, Run]) -> list[Separation]:
    """Return the distance of each pair of vehicles, in their order."""
    return [separation(first, second) for first, second in combinations(runs.items(), 2)]


def closest_over_time(pairs: list[Separation], period: float = 0.5) -> tuple[Column, Column]:
    """Return the least distance between any two vehicles over time.

    Args:
        pairs: of the vehicles.
        period: length of the intervals of which the least distance is taken, s.

    Returns:
        The beginnings of the intervals (s) and the distances (m); NaN where no two vehicles are recorded.
    """
    begun = [pair for pair in pairs if len(pair.t)]
    if not begun:
        return np.empty(0), np.empty(0)
    first, last = min(pair.t[0] for pair in begun), max(pair.t[-1] for pair in begun)
    least = np.full(int((last - first) / period) + 1, np.inf)
    for pair in begun:
        np.minimum.at(least, ((pair.t - first) / period).astype(int), pair.distance)
    return first + period * np.arange(len(least)), np.where(np.isfinite(least), least, np.nan)


def _position(run: Run) -> tuple[Column, Column, Column]:
    """Return north, east and depth, m."""
    known = np.isfinite(run.x_true)
    x, y = np.where(known, run.x_true, run.x), np.where(known, run.y_true, run.y)
    return x, y, run.depth if isinstance(run, SpatialRun) else np.zeros(run.steps)
