"""Limit rate, acceleration and jerk of the heading reference to what a rudder can follow.

Table 4 lets the heading error fall at up to k1 = 0.8 rad/s, which takes a far larger yaw acceleration than a
rudder of 10 or 15 degrees a second can build up. A step of psi_d then puts the loop into saturation, where
the rudder lags by up to a quarter of a turn and a limit cycle persists. Behind this model the controller's
error stays small for any request of guidance, within the range of its stability proof.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import bounded, pure
from auv_path_following.control.hull_model import LEAST_EFFECT, measured_effect, rudder_effect, tightest_turn
from auv_path_following.vehicle import Vehicle


@settings
class ReferenceConfig:
    """Limits of the reference; a limit of 0 is derived from hull and rudder, see `limits_of`."""

    enabled: bool = setting(False, "shape the heading reference before the controller")
    bandwidth: float = setting(
        0.7, "rate at which the reference approaches psi_d", unit="1/s", gt=0.0, le=10.0, live=True
    )
    damping: float = setting(
        0.8, "damping ratio of the reference without its limits", gt=0.1, le=5.0, live=True
    )
    max_rate: float = setting(
        0.0, "largest yaw rate; 0: from the hull", unit="rad/s", ge=0.0, le=10.0, live=True
    )
    max_acceleration: float = setting(
        0.0, "largest yaw acceleration; 0: from the hull", unit="rad/s^2", ge=0.0, le=10.0, live=True
    )
    max_jerk: float = setting(
        0.0,
        "largest change of the yaw acceleration; 0: from the hull",
        unit="rad/s^3",
        ge=0.0,
        le=100.0,
        live=True,
    )


class ReferenceLimits(NamedTuple):
    """Yaw rate (rad/s), acceleration (rad/s^2) and jerk (rad/s^3)."""

    rate: float
    acceleration: float
    jerk: float


#: Share of the jerk of a rudder at its greatest rate; the rest is left to the controller.
JERK_SHARE = 0.9
#: Time in which the reference may build up acceleration, s.
BUILD_UP = 0.8
#: Share of the full rudder that the acceleration may take.
RUDDER_SHARE = 1.0 / 3.0


def limits_of(config: ReferenceConfig, vehicle: Vehicle, rudder_rate: float) -> ReferenceLimits:
    """Return the limits in use: those given, and in place of 0 those that hull and rudder allow.

    At cruising speed under full thrust a radian of rudder turns the hull with b = |dr/dt per rad|. So

    - jerk = `JERK_SHARE` b rudder_rate: the rudder itself cannot do more;
    - acceleration = jerk `BUILD_UP`, at most `RUDDER_SHARE` b max_angle: a fast servo makes no larger rudder;
    - rate = acceleration / bandwidth: from there the linear law alone brakes within the acceleration;
      never more than the tightest turn at cruising speed: a corner is over before much speed is lost.

    Args:
        config: what is given.
        vehicle: the controller's model; not used when all limits are given.
        rudder_rate: the fastest that the controller moves the rudder, rad/s.

    Raises:
        ConfigurationError: a limit has to be derived, and the vehicle file has neither hull nor effect.
    """
    if config.max_rate and config.max_acceleration and config.max_jerk:
        return ReferenceLimits(config.max_rate, config.max_acceleration, config.max_jerk)
    # By the least b, limits without a hull are narrow rather than wide.
    limits = _derived(config, vehicle, rudder_effect(vehicle, LEAST_EFFECT), rudder_rate)
    if vehicle.hull is not None or measured_effect(vehicle) is not None:
        return limits
    advice = limits._asdict()
    missing = [name for name in advice if not getattr(config, f"max_{name}")]
    names = ", ".join(f"reference.max_{name}" for name in missing)
    numbers = ", ".join(f"max_{name}: {advice[name]:.2g}" for name in missing)
    raise ConfigurationError(
        f"{vehicle.name}: hull",
        f"nothing to derive {names} from, which {'is' if len(missing) == 1 else 'are'} 0",
        f"the hull's coefficients, or limits; by length, cruise and turning: {numbers}",
    )


def _derived(config: ReferenceConfig, vehicle: Vehicle, b: float, rudder_rate: float) -> ReferenceLimits:
    """Return the limits given, and the others by the rule of `limits_of` for b = |dr/dt per rad|, 1/s^2."""
    jerk = config.max_jerk or JERK_SHARE * b * rudder_rate
    largest = RUDDER_SHARE * b * vehicle.rudder.max_angle
    acceleration = config.max_acceleration or min(BUILD_UP * jerk, largest)
    fastest = vehicle.top_speed / tightest_turn(vehicle).radius
    rate = config.max_rate or min(acceleration / config.bandwidth, fastest)
    return ReferenceLimits(rate, acceleration, jerk)


class Shaping(NamedTuple):
    """Configuration of the reference model.

    Attributes:
        enabled: whether the reference is shaped.
        bandwidth: of the linear law, 1/s.
        stiffness: 4 damping^2 bandwidth: acceleration of the reference over the lack of its rate, 1/s.
        linear: largest gap that the linear law closes within the limits, rad.
        limits: of the reference.
    """

    enabled: bool
    bandwidth: float
    stiffness: float
    linear: float
    limits: ReferenceLimits


def prepare(config: ReferenceConfig, vehicle: Vehicle, rudder_rate: float) -> Shaping:
    """Return the configuration of the reference model.

    Args:
        config: bandwidth, damping, and limits where they are given.
        vehicle: hull and rudder, for the other limits.
        rudder_rate: the fastest that the controller moves the rudder, rad/s.

    Raises:
        ConfigurationError: as `limits_of`.
    """
    limits = limits_of(config, vehicle, rudder_rate) if config.enabled else ReferenceLimits(0.0, 0.0, 0.0)
    w = float(config.bandwidth)
    stiffness = 4.0 * float(config.damping) ** 2 * w
    return Shaping(config.enabled, w, stiffness, float(limits.acceleration) / (w * w), limits)


class ReferenceState(NamedTuple):
    """The shaped psi_d (rad), its exact rate (rad/s) and acceleration (rad/s^2), once it has begun."""

    begun: bool = False
    angle: float = 0.0
    rate: float = 0.0
    acceleration: float = 0.0


@pure
def shape(
    config: Shaping, state: ReferenceState, psi: float, r: float, psi_d: float, r_d: float, dt: float
) -> ReferenceState:
    """Follow psi_d with limited rate, acceleration and jerk, from the vehicle's own heading and rate.

    The acceleration chosen here is held until the next step, so that rate and acceleration are the exact
    derivatives of the angle: a controller may feed them forward without differencing anything.

    Args:
        config: of the reference model.
        state: of the last step.
        psi, r: heading and yaw rate of the vehicle, where the reference starts (rad, rad/s).
        psi_d, r_d: request of guidance (rad, rad/s).
        dt: seconds since the last step.
    """
    _, bandwidth, stiffness, linear, (largest_rate, largest, jerk) = config
    begun, angle, turning, held = state
    if begun:
        angle, turning = angle + turning * dt + 0.5 * held * dt * dt, turning + held * dt
    else:
        angle, turning = psi, r
    closing = closing_rate(wrap(psi_d - angle), bandwidth, linear, largest)
    pull = stiffness * (bounded(r_d + closing, largest_rate) - turning)
    held += bounded(bounded(pull, largest) - held, jerk * dt)
    angle = wrap(angle)
    return ReferenceState(True, angle, turning, held)


@pure
def closing_rate(gap: float, bandwidth: float, linear: float, acceleration: float) -> float:
    """Return the rate at which to close a gap: proportional when small, else such that braking is possible.

    Args:
        gap: rad.
        bandwidth: 1/s.
        linear: largest gap that is closed in proportion, rad.
        acceleration: largest, rad/s^2.
    """
    if abs(gap) <= linear:
        return bandwidth * gap
    return math.copysign(math.sqrt(2.0 * acceleration * (abs(gap) - 0.5 * linear)), gap)
