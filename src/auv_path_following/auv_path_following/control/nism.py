"""Nonlinear iterative sliding mode heading control, Eqs. (45), (46)."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, numbers, numbers_of, pure
from auv_path_following.control.controller import ControllerOutput, HeadingInputs
from auv_path_following.control.hull_model import rudder_effect
from auv_path_following.registry import Law
from auv_path_following.vehicle import Vehicle

#: Largest value of each part of the rudder rate, rad/s: faster than any fin.
LARGEST_RATE = 10.0
#: Largest crossover b kp k5 of the inner loop where kp is derived, 1/s. With a delay tau it is stable up
#: to 1.25/tau: 12 1/s allow 0.1 s, which is 50 ms of dead time and half a period at 10 odometries a second.
LARGEST_CROSSOVER = 12.0


@numbers
@settings
class NismConfig:
    """Gains of Table 4. The rudder rate never exceeds kp + ks."""

    k1: float = setting(0.8, "fastest decay of the heading error", unit="rad/s", gt=0.0, le=10.0, live=True)
    k2: float = setting(
        1.5, "narrows the range of psi_e with exponential decay", unit="1/rad", gt=0.0, le=1e4, live=True
    )
    k3: float = setting(0.8, "fastest decay of sigma_1", unit="rad/s^2", gt=0.0, le=10.0, live=True)
    k4: float = setting(
        1.0, "narrows the range of sigma_1 with exponential decay", unit="s/rad", gt=0.0, le=1e4, live=True
    )
    k5: float = setting(
        15.0,
        "narrows the range of sigma_2 with proportional rudder rate",
        unit="s^2/rad",
        gt=0.0,
        le=1e5,
        live=True,
    )
    kp: float = setting(
        0.1745,
        "bound of the smooth part of the rudder rate",
        unit="rad/s",
        gt=0.0,
        le=LARGEST_RATE,
        live=True,
    )
    kp_from_rudder: bool = setting(
        False,
        "take kp from the vehicle's file: the rudder's rate less ks; less where b kp k5 would exceed 12 1/s",
        live=True,
    )
    ks: float = setting(
        0.0,
        "switching part of the rudder rate, against varying disturbance",
        unit="rad/s",
        ge=0.0,
        le=LARGEST_RATE,
        live=True,
    )


def kp_of(config: NismConfig, vehicle: Vehicle) -> float:
    """Return kp, rad/s: as given, or with `kp_from_rudder` from rudder and hull.

    kp is then the rudder's rate less ks. With a fast servo that would raise the crossover of the inner loop,
    b kp k5, beyond the limit of dead time and sampling, so it is bounded by `LARGEST_CROSSOVER`. Where the
    vehicle's file has no hull, b is that of a typical torpedo of its length and speed. A k5 above the
    default counts as the default: raising it must not take rate from the rudder.
    """
    if not config.kp_from_rudder:
        return config.kp
    kp = min(max(vehicle.rudder.max_rate - config.ks, 1e-6), LARGEST_RATE)
    return min(kp, LARGEST_CROSSOVER / (rudder_effect(vehicle) * min(config.k5, NismConfig().k5)))


class Nism(NamedTuple):
    """Configuration: gains, and the angle (rad) at which the integral of Eq. (46) is clamped."""

    gains: NismConfig
    max_angle: float


class NismState(NamedTuple):
    """The rudder, rad."""

    rudder: float = 0.0


@pure
def nism(
    config: Nism, state: NismState, inputs: HeadingInputs, dt: float
) -> tuple[NismState, ControllerOutput]:
    """Move the rudder by Eqs. (45), (46): an incremental law that needs no model of the hull.

    The clamp is inside the integral, so that it cannot wind up. With a `dt` of 0 only the surfaces are
    computed; the rudder rests.
    """
    rate, sigma_1, sigma_2 = rudder_rate(config.gains, inputs)
    rudder = bounded(state.rudder + rate * dt, config.max_angle)
    return NismState(rudder), ControllerOutput(rudder, sigma_1, sigma_2)


@pure
def rudder_rate(g: NismConfig, inputs: HeadingInputs) -> tuple[float, float, float]:
    """Return d delta/dt of Eq. (46), rad/s, and the surfaces sigma_1 and sigma_2 of Eq. (45) behind it."""
    psi_e = inputs.psi_e
    psi_e_dot = inputs.r - inputs.r_d
    psi_e_ddot = inputs.r_dot - inputs.r_d_dot

    bend = math.tanh(g.k2 * psi_e)
    sigma_1 = g.k1 * bend + psi_e_dot
    # sech^2 = 1 - tanh^2
    sigma_1_dot = g.k1 * g.k2 * (1.0 - bend * bend) * psi_e_dot + psi_e_ddot
    sigma_2 = g.k3 * math.tanh(g.k4 * sigma_1) + sigma_1_dot

    sign = 1.0 if sigma_2 > 0.0 else -1.0 if sigma_2 < 0.0 else 0.0
    rate = g.kp * math.tanh(g.k5 * sigma_2) + g.ks * sign
    return rate, sigma_1, sigma_2


def prepare(gains: NismConfig, vehicle: Vehicle) -> Nism:
    """Return the law's configuration, with kp from rudder and hull where the settings ask for it."""
    return Nism(numbers_of(dataclasses.replace(gains, kp=kp_of(gains, vehicle))), vehicle.rudder.max_angle)


LAW = Law("nism", "NISM", NismConfig, Nism, NismState(), nism, prepare)
