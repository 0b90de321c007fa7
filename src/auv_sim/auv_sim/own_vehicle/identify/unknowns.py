"""The unknowns of an identification, each scaled by its prior: coefficients, rudder, biases, latency."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from auv_sim.own_vehicle.identify.combinations import COUNT, Combinations, Numbers, Prior

#: Names of the unknowns behind the combinations.
FURTHER = ("rate", "dead_time", "half_play", "gyro", "u_bias", "v_bias", "latency", "trim")
RATE, DEAD_TIME, HALF_PLAY, GYRO, U_BIAS, V_BIAS, LATENCY, TRIM = range(COUNT, COUNT + len(FURTHER))
#: How many unknowns.
ALL = COUNT + len(FURTHER)


class DataSheet(NamedTuple):
    """What data sheets say, as standard deviations, and first values; a deviation of 0 fixes an unknown.

    Attributes:
        rate: of the rudder, or of a dive's stern planes, rad/s, within about a factor of two.
        dead_time, half_play: of the same fin, s, rad.
        gyro, u_bias, v_bias: deviations of constant offsets, rad/s, m/s.
        latency, latency_deviation: age of a velocity when it arrives, s.
        trim: deviation of the fin's angle at a command of 0, rad.
        log_scale, thrust_bias: deviations of shares that motion data cannot show.
        thrust_drift, drift_time: deviation of the thrust's slow error, a share, and its time constant, s.
    """

    rate: float = math.radians(15.0)
    dead_time: float = 0.05
    half_play: float = math.radians(0.1)
    gyro: float = math.radians(0.04)
    u_bias: float = 0.005
    v_bias: float = 0.005
    latency: float = 0.1
    latency_deviation: float = 0.0
    trim: float = math.radians(2.0)
    log_scale: float = 0.007
    thrust_bias: float = 0.02
    thrust_drift: float = 0.03
    drift_time: float = 10.0


#: Standard deviations of log(rate), dead time (s) and half the play (rad) before any data.
_LOG_RATE, _DEAD_TIME, _HALF_PLAY = 0.7, 0.3, math.radians(0.2)


class Scaling(NamedTuple):
    """Turns scaled unknowns z (zero mean and unit variance before any data) into physical ones."""

    prior: Prior
    sheet: DataSheet

    def combinations(self, z: Numbers) -> Numbers:
        """Return the combinations, shape (14,)."""
        return np.asarray(self.prior.mean + self.prior.root @ z[:COUNT])

    def physical(self, z: Numbers) -> Numbers:
        """Return combinations, rate (rad/s), dead time (s), half play (rad), biases, latency, trim: (22,)."""
        s = self.sheet
        further = [
            s.rate * math.exp(_LOG_RATE * z[RATE]),
            s.dead_time + _DEAD_TIME * z[DEAD_TIME],
            s.half_play + _HALF_PLAY * z[HALF_PLAY],
            s.gyro * z[GYRO],
            s.u_bias * z[U_BIAS],
            s.v_bias * z[V_BIAS],
            s.latency + s.latency_deviation * z[LATENCY],
            s.trim * z[TRIM],
        ]
        return np.concatenate((self.combinations(z), further))

    def slopes(self, z: Numbers) -> Numbers:
        """Return the derivatives of the physical unknowns by the scaled ones, shape (22, 22)."""
        s, slopes = self.sheet, np.zeros((ALL, ALL))
        slopes[:COUNT, :COUNT] = self.prior.root
        rate = s.rate * math.exp(_LOG_RATE * z[RATE]) * _LOG_RATE
        further = (rate, _DEAD_TIME, _HALF_PLAY, s.gyro, s.u_bias, s.v_bias, s.latency_deviation, s.trim)
        slopes[range(COUNT, ALL), range(COUNT, ALL)] = further
        return slopes

    def scaled(self, physical: Numbers) -> Numbers:
        """Return the scaled unknowns of physical ones: inverse of `physical`."""
        s, z = self.sheet, np.zeros(ALL)
        z[:COUNT] = np.linalg.solve(self.prior.root, physical[:COUNT] - self.prior.mean)
        z[RATE] = math.log(physical[RATE] / s.rate) / _LOG_RATE
        z[DEAD_TIME] = (physical[DEAD_TIME] - s.dead_time) / _DEAD_TIME
        z[HALF_PLAY] = (physical[HALF_PLAY] - s.half_play) / _HALF_PLAY
        z[GYRO : V_BIAS + 1] = physical[GYRO : V_BIAS + 1] / np.array([s.gyro, s.u_bias, s.v_bias])
        if s.latency_deviation > 0.0:
            z[LATENCY] = (physical[LATENCY] - s.latency) / s.latency_deviation
        if s.trim > 0.0:
            z[TRIM] = physical[TRIM] / s.trim
        return z

    def lowest(self) -> Numbers:
        """Return the lower bounds of the scaled unknowns: no dead time and no play below 0."""
        bounds = np.full(ALL, -np.inf)
        bounds[DEAD_TIME] = -self.sheet.dead_time / _DEAD_TIME
        bounds[HALF_PLAY] = -self.sheet.half_play / _HALF_PLAY
        return bounds


def typed(physical: Numbers) -> Combinations:
    """Return the combinations among physical unknowns."""
    return Combinations(*(float(value) for value in physical[:COUNT]))
