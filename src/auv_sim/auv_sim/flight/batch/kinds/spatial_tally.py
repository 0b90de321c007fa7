"""Tallies of a flight in three dimensions: after those of `tally`, in the same tables."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from auv_sim.flight.batch import tally
from auv_sim.flight.batch.compiled import compiled

# Further columns of a subpath's tally.
DEPTH_SQUARES, DEPTH_LARGEST, PLANES_TRAVEL, SINE_OF_PITCH = range(
    tally.SUBPATH_TALLIES, tally.SUBPATH_TALLIES + 4
)
SPATIAL_SUBPATH_TALLIES = tally.SUBPATH_TALLIES + 4
# Further ones of the flight: from where the path was joined on, away from corners.
STEADY_ROWS, STEADY_SQUARES, STEADY_LARGEST = range(tally.FLIGHT_TALLIES, tally.FLIGHT_TALLIES + 3)
SPATIAL_FLIGHT_TALLIES = tally.FLIGHT_TALLIES + 3
# And how it ended.
LAST_Z = tally.ENDS
SPATIAL_ENDS = tally.ENDS + 1

Array = npt.NDArray[np.float64]


@compiled
def count_depth(
    whole: Array, subpaths: Array, i: int, below: float, sine_of_pitch: float, is_at_corner: bool
) -> None:
    """Count an odometry that `tally.count` has counted, `below` m deeper than the path."""
    error = abs(below)
    subpaths[i, DEPTH_SQUARES] += below * below
    subpaths[i, DEPTH_LARGEST] = max(subpaths[i, DEPTH_LARGEST], error)
    subpaths[i, SINE_OF_PITCH] = max(subpaths[i, SINE_OF_PITCH], abs(sine_of_pitch))
    if not is_at_corner and not math.isnan(whole[tally.TIME_TO_PATH]):
        whole[STEADY_ROWS] += 1.0
        whole[STEADY_SQUARES] += below * below
        whole[STEADY_LARGEST] = max(whole[STEADY_LARGEST], error)
