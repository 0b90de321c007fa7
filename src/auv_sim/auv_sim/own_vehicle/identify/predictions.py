"""Predictions of manoeuvres that were left out of the estimate."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.innovations import Channels, filtered, flown
from auv_sim.own_vehicle.identify.time_grid import LONGEST_GAP, Passage
from auv_sim.own_vehicle.identify.unknowns import GYRO

#: Time from one start of a prediction to the next, s.
_EVERY = 2.0


class Prediction(NamedTuple):
    """Predictions over one horizon from many starts.

    Attributes:
        horizon: s.
        error: rms error of the yaw rate, or of a dive's pitch rate, over its rms.
        noise: white noise of that rate as measured over its rms; no error lies below it.
        state: rms error of u, or of a dive's pitch, over its rms.
        starts: how many.
    """

    horizon: float
    error: float
    noise: float
    state: float
    starts: int


def predictions_of(
    channels: Channels, physical: Numbers, horizons: Sequence[float] = (2.0, 10.0)
) -> list[Prediction]:
    """Predict recordings from the filter's states, by the commands alone.

    Args:
        channels: recordings that were left out of the estimate.
        physical: the unknowns.
        horizons: s.
    """
    return [_over(channels, physical, horizon) for horizon in horizons]


def _over(channels: Channels, physical: Numbers, horizon: float) -> Prediction:
    errors: list[Numbers] = []
    for passage in channels.passages:
        states = filtered(passage, channels, physical)
        for first, length in starts_of(passage, horizon):
            track = flown(passage, channels, physical, first, length, states[first])
            errors.append(_compared(passage, track, first, length, physical[GYRO], states))
    if not errors:
        return Prediction(horizon, np.nan, np.nan, np.nan, 0)
    off_r, r, off_u, u = np.concatenate(errors, axis=1)
    rate, state = np.sqrt(np.mean(off_r**2) / np.mean(r**2)), np.sqrt(np.mean(off_u**2) / np.mean(u**2))
    noise = math.sqrt(channels.noise[2] / float(np.mean(r**2)))
    return Prediction(horizon, float(rate), noise, float(state), len(errors))


def starts_of(passage: Passage, horizon: float) -> list[tuple[int, int]]:
    """Return the first nodes of predictions and their numbers of steps; none reaches beyond a gap."""
    times, begins = passage.times[:-1], np.flatnonzero(passage.grid.begins)
    behind_gaps = np.flatnonzero(np.diff(times) >= LONGEST_GAP) + 1
    limits = np.append(np.union1d(begins, behind_gaps), times.size)
    found = []
    for begin in begins:
        end = limits[np.searchsorted(limits, begin, side="right")]
        start = times[begin] + _EVERY
        while start + horizon <= times[end - 1]:
            first = int(np.searchsorted(times, start))
            last = int(np.searchsorted(times, times[first] + horizon - 1e-6))
            if last < end:
                found.append((first, last - first))
            start += _EVERY
    return found


def _compared(
    passage: Passage, track: Numbers, first: int, length: int, gyro: float, states: Numbers
) -> Numbers:
    """Return error of r, r, error of u and u at the nodes where r was measured, shape (4, rows).

    Of a dive these are pitch rate and pitch.
    """
    nodes = np.arange(first + 1, first + 1 + length)
    measured = passage.grid.rate_row[nodes] >= 0
    r, u = passage.grid.rate[nodes] - gyro, states[nodes, 0]
    return np.array([track[:, 2] - r, r, track[:, 0] - u, u])[:, measured]
