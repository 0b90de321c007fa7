"""Tallies of a flight in three dimensions: after those of `tally`, in the same tables."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from auv_sim.flight.batch import tally
from auv_sim.flight.batch.compiled import compiled

#: The steady figures count from this long after the path was joined, s: then the vehicle has settled on it.
SETTLING_TIME = 30.0

# Further columns of a subpath's tally.
DEPTH_SQUARES, DEPTH_LARGEST, PLANES_TRAVEL, SINE_OF_PITCH = range(
    tally.SUBPATH_TALLIES, tally.SUBPATH_TALLIES + 4
)
SPATIAL_SUBPATH_TALLIES = tally.SUBPATH_TALLIES + 4
# Further ones of the flight: from `SETTLING_TIME` after the path was joined on, away from corners.
STEADY_ROWS, STEADY_SQUARES, STEADY_LARGEST = range(tally.FLIGHT_TALLIES, tally.FLIGHT_TALLIES + 3)
# And of the pitch rate, from `tally.calm_time` on.
PITCH_SQUARES = tally.FLIGHT_TALLIES + 3
SPATIAL_FLIGHT_TALLIES = tally.FLIGHT_TALLIES + 4
# And how it ended.
LAST_Z = tally.ENDS
SPATIAL_ENDS = tally.ENDS + 1

_ROUNDING = 1e-6

Array = npt.NDArray[np.float64]


@compiled
def count_depth(
    whole: Array, subpaths: Array, i: int, elapsed: float, calm: float, below: float, sine_of_pitch: float,
    q: float, is_at_corner: bool,
) -> None:  # fmt: skip
    """Count an odometry that `tally.count` has counted, `elapsed` s after the start, `below` m too deep.

    It has the pitch rate q (rad/s), which counts from `calm` (s) on.
    """
    error = abs(below)
    if elapsed >= calm - _ROUNDING:
        whole[PITCH_SQUARES] += q * q
    subpaths[i, DEPTH_SQUARES] += below * below
    subpaths[i, DEPTH_LARGEST] = max(subpaths[i, DEPTH_LARGEST], error)
    subpaths[i, SINE_OF_PITCH] = max(subpaths[i, SINE_OF_PITCH], abs(sine_of_pitch))
    # A path that has not been joined has the time NaN.
    if not is_at_corner and elapsed - whole[tally.TIME_TO_PATH] >= SETTLING_TIME - _ROUNDING:
        whole[STEADY_ROWS] += 1.0
        whole[STEADY_SQUARES] += below * below
        whole[STEADY_LARGEST] = max(whole[STEADY_LARGEST], error)
