"""Inputs and output of every heading controller: from the heading error to the rudder."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.pure import bounded, pure
from auv_path_following.vehicle import Vehicle


class HeadingInputs(NamedTuple):
    """Inputs of a controller (NED, clockwise positive, rad and s).

    psi_e = wrap(psi - psi_d); r and r_dot are the vehicle's, r_d and r_d_dot the reference's;
    thrust (N) gives a model its speed.
    """

    psi_e: float
    r: float
    r_dot: float
    r_d: float
    r_d_dot: float
    thrust: float = 0.0


class ControllerOutput(NamedTuple):
    """The rudder angle delta (rad, positive turns to port) and the two surfaces for plots."""

    rudder: float
    sigma_1: float = 0.0
    sigma_2: float = 0.0


class RudderLimits(NamedTuple):
    """Largest rudder angle (rad) and rate (rad/s)."""

    max_angle: float
    max_rate: float


def rudder_limits_of(vehicle: Vehicle) -> RudderLimits:
    """Return the limits of a vehicle's rudder."""
    return RudderLimits(vehicle.rudder.max_angle, vehicle.rudder.max_rate)


@pure
def limited(limits: RudderLimits, angle: float, desired: float, dt: float) -> float:
    """Return the rudder command after `dt` seconds on the way from `angle` to `desired`, rad."""
    return angle + bounded(bounded(desired, limits.max_angle) - angle, limits.max_rate * dt)
