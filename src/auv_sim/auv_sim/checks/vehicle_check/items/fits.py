"""Fits a measured signal to a model of the rudder: factor, rate limit and dead time."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.samples import Array
from auv_sim.vehicle.fins.actuator import Servo, ServoState, turn

#: Step of the grid on which commands and models stand, s.
STEP = 0.05
#: Shares of the file's rudder rate, and dead times (s), that are tried.
_RATES = (0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.4, 2.0, 3.0)
_DELAYS = np.arange(0.0, 1.501, 0.02)
DEGREES = 180.0 / math.pi


class Fit(NamedTuple):
    """How a signal follows the model.

    Attributes:
        gain: its factor.
        rate: share of the file's rudder rate.
        delay: dead time, s.
        unexplained: share of the signal's power that the fit leaves, 0 to 1.
        scale: factor of the command before the rudder: 1, or that of degrees taken for radians.
    """

    gain: float
    rate: float
    delay: float
    unexplained: float
    scale: float = 1.0


class Way(NamedTuple):
    """A hypothesis on a command: its scale, and the share of the file's rudder rate."""

    scale: float
    rate: float


WAYS = (*(Way(1.0, rate) for rate in _RATES), Way(1.0 / DEGREES, 1.0), Way(DEGREES, 1.0))


def servo(rudder: Array, vehicle: Vehicle, rate: float) -> Array:
    """Return the angle of a rudder that moves with a share of the file's rate, rad; shape of `rudder`."""
    config = Servo(vehicle.rudder.max_angle, rate * vehicle.rudder.max_rate)
    state = ServoState()
    angles = np.empty_like(rudder)
    for k, angle in enumerate(rudder):
        angles[k] = state.angle
        state, _ = turn(config, state, (float(angle), True), STEP)
    return angles


def best(t: Array, models: dict[Way, Array], times: Array, values: Array) -> Fit:
    """Return the rate, dead time and factor that explain a signal best."""
    power = float(values @ values) or 1e-12
    best = Fit(0.0, 1.0, 0.0, 1.0)
    for way, model in models.items():
        for delay in _DELAYS:
            expected = np.interp(times - delay, t, model, left=0.0)
            own = float(expected @ expected)
            if own < 1e-9:
                continue
            gain = float(expected @ values) / own
            rest = 1.0 - gain * float(expected @ values) / power
            if rest < best.unexplained - 1e-6:
                best = Fit(gain, way.rate, float(delay), rest, way.scale)
    return best
