"""The distance to the path by the vehicle's own odometry, beside the true one.

In a sea the navigator errs, and guidance follows the path relative to the odometry: the distance that it
reports is smaller than the true one, by which a mission is judged.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.metrics import root_mean_square, under_way
from auv_sim.flight.run_record import Run


class ByOdometry(NamedTuple):
    """Distances to the path by odometry, m.

    Attributes:
        rms, largest: of all rows under way.
        subpaths: rms on each subpath, shape (n,); NaN where none was flown.
    """

    rms: float
    largest: float
    subpaths: tuple[float, ...]


def by_odometry(run: Run, path: CompositePath) -> ByOdometry | None:
    """Judge a run by its odometry; None where the truth was not recorded, so that there is only one distance.

    Args:
        run: the flown mission.
        path: the path of that mission, NED.
    """
    flown = under_way(run, path.n)
    if not flown.steps or not np.isfinite(flown.x_true).any():
        return None
    index = flown.subpath(path.n)
    distance = path.distance(flown.x, flown.y, index)
    parts = (distance[index == k] for k in range(path.n))
    return ByOdometry(
        root_mean_square(distance),
        float(distance.max()),
        tuple(root_mean_square(part) for part in parts),
    )
