"""Conventional, model-based sliding mode heading control in the form of Fossen and of Lekkas."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import bounded, numbers, numbers_of, pure
from auv_path_following.control.controller import (
    ControllerOutput,
    HeadingInputs,
    RudderLimits,
    limited,
    rudder_limits_of,
)
from auv_path_following.control.hull_model import (
    HullModel,
    SwayYaw,
    accelerations,
    rudder_gain,
    sway_after,
)
from auv_path_following.registry import Law
from auv_path_following.vehicle import Vehicle


@numbers
@settings
class SmcConfig:
    """Surface and switching gain; docs/tuning.md derives the defaults."""

    slope: float = setting(
        1.0, "slope of the surface: psi_e decays at this rate on it", unit="1/s", gt=0.0, le=10.0, live=True
    )
    gain: float = setting(
        0.7, "reaching gain, yaw acceleration off the surface", unit="rad/s^2", gt=0.0, le=10.0, live=True
    )
    boundary: float = setting(
        0.43, "half width of the boundary layer", unit="rad/s", gt=0.0, le=10.0, live=True
    )
    largest_rate: float = setting(
        0.5, "largest yaw rate of the surface, so that the rudder can follow long turns",
        unit="rad/s", gt=0.0, le=10.0, live=True,
    )  # fmt: skip


class Smc(NamedTuple):
    """Configuration: gains, the limits of the rudder, the controller's own hull and its drag (kg/m)."""

    gains: SmcConfig
    rudder: RudderLimits
    hull: SwayYaw
    drag: float


class SmcState(NamedTuple):
    """Rudder (rad) and the model's sway velocity (m/s)."""

    rudder: float = 0.0
    vr: float = 0.0


@pure
def smc(config: Smc, state: SmcState, inputs: HeadingInputs, dt: float) -> tuple[SmcState, ControllerOutput]:
    """Hold sigma = psi_e' + slope psi_e by the model's rudder, and by -gain sat(sigma/boundary).

    The equivalent control is from the yaw row of Eqs. (18), (19) of the controller's own hull. Speed and
    sway are the model's too: the first from the balance of thrust and drag, the second integrated.
    """
    rudder, vr = state
    g = config.gains
    ur = math.sqrt(max(inputs.thrust, 0.0) / config.drag)
    if ur <= 0.0:
        rudder = limited(config.rudder, rudder, 0.0, dt)
        return SmcState(rudder, vr), ControllerOutput(rudder, 0.0, 0.0)
    vr = sway_after(config.hull, ur, vr, inputs.r, rudder, dt)
    lean = g.slope * inputs.psi_e
    sigma = inputs.r - inputs.r_d + bounded(lean, g.largest_rate)
    push = -g.gain * bounded(sigma / g.boundary, 1.0)
    turn = rudder_gain(config.hull, ur)[1]
    desired = equivalent(config, inputs, ur, vr) + push / turn
    rudder = limited(config.rudder, rudder, desired, dt)
    return SmcState(rudder, vr), ControllerOutput(rudder, sigma, 0.0)


@pure
def equivalent(config: Smc, inputs: HeadingInputs, ur: float, vr: float) -> float:
    """Return the rudder (rad) that keeps the model's sigma constant."""
    g = config.gains
    # d sigma/d psi_e is 0 where the surface's rate is capped.
    slope = g.slope if abs(g.slope * inputs.psi_e) < g.largest_rate else 0.0
    r_dot = inputs.r_d_dot - slope * (inputs.r - inputs.r_d)
    return (r_dot - accelerations(config.hull, ur, vr, inputs.r)[1]) / rudder_gain(config.hull, ur)[1]


def prepare(gains: SmcConfig, vehicle: Vehicle) -> Smc:
    """Return the law's configuration.

    Raises:
        ConfigurationError: the vehicle file has no hull, or its thrust is not in N.
    """
    if vehicle.thrust_unit != "N":
        expected = "N, with which the model of this law computes the speed"
        raise ConfigurationError(f"{vehicle.name}: thrust_unit", vehicle.thrust_unit, expected)
    return Smc(
        numbers_of(gains), rudder_limits_of(vehicle), HullModel(vehicle).sway_yaw, vehicle.thrust_at(1.0)
    )


LAW = Law("smc", "conventional sliding mode", SmcConfig, Smc, SmcState(), smc, prepare)
