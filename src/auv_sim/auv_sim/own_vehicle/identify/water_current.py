"""The mean current: velocity over ground less the velocity through the water, turned to north."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.time_grid import PlanarData

_BLOCK = 10.0


class MeanCurrent(NamedTuple):
    """Mean current of a recording.

    Attributes:
        north, east: m/s.
        deviation: standard deviation of each, by the scatter of blocks of 10 s, m/s.
        scale: excess of the log's velocity through water over that over ground, a share.
    """

    north: float
    east: float
    deviation: float
    scale: float


def mean_current(data: PlanarData) -> MeanCurrent | None:
    """Return the mean current; None without velocity over ground.

    The scales of the two logs differ; their ratio is the third unknown, which a course over several headings
    shows.
    """
    rows = np.clip(np.searchsorted(data.t, data.water_t - 1e-6), 0, data.t.size - 1)
    over_u, over_v, psi = data.over_u[rows], data.over_v[rows], np.unwrap(data.psi)[rows]
    known = np.isfinite(over_u) & np.isfinite(over_v)
    if known.sum() < 50:
        return None
    cos, sin, u, v = np.cos(psi[known]), np.sin(psi[known]), data.u[known], data.v[known]
    off_u, off_v = over_u[known] - u, over_v[known] - v
    north, east = cos * off_u - sin * off_v, sin * off_u + cos * off_v
    ahead, aside = -(cos * u - sin * v), -(sin * u + cos * v)
    block = ((data.water_t[known] - data.water_t[0]) // _BLOCK).astype(int)
    found = _fit(north, east, ahead, aside)
    left = np.concatenate((north - found[0] - found[2] * ahead, east - found[1] - found[2] * aside))
    means = _block_means(left, np.concatenate((block, block + block.max() + 1)))
    return MeanCurrent(*found[:2], float(np.std(means) / np.sqrt(max(len(means) / 2.0, 1.0))), found[2])


def _fit(north: Numbers, east: Numbers, ahead: Numbers, aside: Numbers) -> tuple[float, float, float]:
    n = north.size
    table = np.zeros((2 * n + 1, 3))
    table[:n, 0], table[n : 2 * n, 1], table[: 2 * n, 2] = 1.0, 1.0, np.concatenate((ahead, aside))
    # A scale within about 1 %: needed where the course has one heading only.
    table[2 * n, 2] = 0.02 / 0.01
    found = np.linalg.lstsq(table, np.concatenate((north, east, [0.0])), rcond=None)[0]
    return float(found[0]), float(found[1]), float(found[2])


def _block_means(values: Numbers, block: Sequence[int] | Numbers) -> list[float]:
    return [float(values[block == k].mean()) for k in np.unique(block)]
