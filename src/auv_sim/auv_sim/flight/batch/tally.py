"""Tallies of a flight while it is flown: sums, largest values and times instead of a track."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch.compiled import compiled
from auv_sim.flight.metrics import OBSERVER_SETTLING_TIME

#: Distance at which the path counts as joined, the first time with s > 0, m: an approach to the path's start,
#: with s = 0, may cross the path. The `late_*` figures count from there.
ARRIVED = 1.0
#: Time after the start from which the yaw rate counts, s; in proportion longer for a vehicle that takes more
#: than `_BRISK` s for its length. What is left on a straight line is a limit cycle.
CALM_TIME, _BRISK = 60.0, 1.25
_ROUNDING = 1e-6

# Rows of a subpath's tally.
ROWS, DURATION, SQUARES, LARGEST, HEADING_SQUARES, TRAVEL, COVERED = range(7)
SUBPATH_TALLIES = 7
# The flight's own.
LATE_ROWS, LATE_SQUARES, LATE_LARGEST, TIME_TO_PATH, ESTIMATE_ERROR = range(5)
COMMANDS, RATE_SQUARES, RATE_LARGEST, SATURATED = range(5, 9)
FREE_ROWS, FREE_SQUARES, FREE_LARGEST, CALM_ROWS, YAW_SQUARES = range(9, 14)
FLIGHT_TALLIES = 14
# How it ended: odometries, s of Eq. (1), whether the state stayed finite, flown share, last position (m).
ODOMETRIES, S, FINITE, SHARE, LAST_X, LAST_Y = range(6)
ENDS = 6

Array = npt.NDArray[np.float64]


def calm_time(vehicle: Vehicle) -> float:
    """Return the time after the start from which a vehicle's yaw rate counts, s."""
    thrust = vehicle.thrust_max if vehicle.cruise is None else vehicle.cruise.thrust
    return CALM_TIME * max(1.0, vehicle.length / (_BRISK * vehicle.speed_at(thrust)))


@compiled
def begin(whole: Array, subpaths: Array) -> None:
    """Reset the tallies."""
    whole[:] = 0.0
    subpaths[:] = 0.0
    subpaths[:, LARGEST] = -math.inf
    whole[LATE_LARGEST] = whole[ESTIMATE_ERROR] = whole[FREE_LARGEST] = -math.inf
    whole[TIME_TO_PATH] = math.nan


@compiled
def count(
    whole: Array,
    subpaths: Array,
    i: int,
    s: float,
    elapsed: float,
    distance: float,
    psi_e: float,
    squared_error: float,
) -> None:
    """Count an odometry `elapsed` s after the start, at s of Eq. (1), `distance` m from the path.

    The estimated current has a `squared_error`, m^2/s^2.
    """
    subpaths[i, ROWS] += 1.0
    subpaths[i, SQUARES] += distance * distance
    subpaths[i, LARGEST] = max(subpaths[i, LARGEST], distance)
    subpaths[i, HEADING_SQUARES] += psi_e * psi_e
    if s > 0.0 and distance <= ARRIVED and math.isnan(whole[TIME_TO_PATH]):
        whole[TIME_TO_PATH] = elapsed
    if not math.isnan(whole[TIME_TO_PATH]):
        whole[LATE_ROWS] += 1.0
        whole[LATE_SQUARES] += distance * distance
        whole[LATE_LARGEST] = max(whole[LATE_LARGEST], distance)
    if elapsed >= OBSERVER_SETTLING_TIME:
        whole[ESTIMATE_ERROR] = max(whole[ESTIMATE_ERROR], math.sqrt(squared_error))


@compiled
def count_steadiness(
    whole: Array, elapsed: float, calm: float, distance: float, r: float, is_at_corner: bool
) -> None:
    """Count an odometry's distance away from corners (m), and from `calm` (s) on its yaw rate (rad/s)."""
    if not is_at_corner:
        whole[FREE_ROWS] += 1.0
        whole[FREE_SQUARES] += distance * distance
        whole[FREE_LARGEST] = max(whole[FREE_LARGEST], distance)
    if elapsed >= calm - _ROUNDING:
        whole[CALM_ROWS] += 1.0
        whole[YAW_SQUARES] += r * r


@compiled
def count_step(subpaths: Array, i: int, dt: float, travel: float, covered: float) -> None:
    """Count the motion from one odometry to the next; `travel` of the rudder in rad, `covered` in m."""
    subpaths[i, DURATION] += dt
    subpaths[i, TRAVEL] += travel
    subpaths[i, COVERED] += covered


@compiled
def count_command(whole: Array, rate: float, saturated: bool) -> None:
    """Count the rate of the command between two odometries, rad/s, and whether it is at the stop."""
    whole[COMMANDS] += 1.0
    whole[RATE_SQUARES] += rate * rate
    whole[RATE_LARGEST] = max(whole[RATE_LARGEST], abs(rate))
    if saturated:
        whole[SATURATED] += 1.0
