"""PID heading control: tuned by pole placement, derivative on measurement, back-calculated integral."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, numbers, numbers_of, pure
from auv_path_following.control.controller import (
    ControllerOutput,
    HeadingInputs,
    RudderLimits,
    limited,
    rudder_limits_of,
)
from auv_path_following.registry import Law
from auv_path_following.vehicle import Vehicle


@numbers
@settings
class PidConfig:
    """Gains from the heading error to the rudder; docs/tuning.md derives the defaults."""

    kp: float = setting(1.0, "rudder for heading error", gt=0.0, le=100.0, live=True)
    ki: float = setting(
        0.13, "rudder for the integral of the heading error", unit="1/s", ge=0.0, le=100.0, live=True
    )
    kd: float = setting(1.8, "rudder for yaw rate", unit="s", ge=0.0, le=100.0, live=True)
    largest_error: float = setting(
        0.63, "largest heading error of the proportional part, so that long turns stay damped",
        unit="rad", gt=0.0, le=math.pi, live=True,
    )  # fmt: skip


class Pid(NamedTuple):
    """Configuration: gains, and the limits of the rudder."""

    gains: PidConfig
    rudder: RudderLimits


class PidState(NamedTuple):
    """Rudder and integral part, rad."""

    rudder: float = 0.0
    integral: float = 0.0


@pure
def pid(config: Pid, state: PidState, inputs: HeadingInputs, dt: float) -> tuple[PidState, ControllerOutput]:
    """Return delta = kp psi_e + ki integral(psi_e) + kd (r - r_d), within the rudder's angle and rate.

    The derivative uses the measured yaw rate less the path's, so a step of psi_d gives no kick. The part that
    the rudder cannot follow is subtracted from the integral (anti-windup by back-calculation).
    """
    rudder, integral = state
    g = config.gains
    error = bounded(inputs.psi_e, g.largest_error)
    integral += g.ki * error * dt
    desired = g.kp * error + integral + g.kd * (inputs.r - inputs.r_d)
    rudder = limited(config.rudder, rudder, desired, dt)
    # The integral follows the actual rudder within kd/kp seconds, the law's own lead.
    if g.ki > 0.0 and dt > 0.0:
        tracking = max(g.kd / g.kp, dt)
        integral += (rudder - desired) * min(dt / tracking, 1.0)
    return PidState(rudder, integral), ControllerOutput(rudder, 0.0, 0.0)


def prepare(gains: PidConfig, vehicle: Vehicle) -> Pid:
    """Return the law's configuration."""
    return Pid(numbers_of(gains), rudder_limits_of(vehicle))


LAW = Law("pid", "PID", PidConfig, Pid, PidState(), pid, prepare)
