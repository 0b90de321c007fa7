"""PID heading control: tuned by pole placement, derivative on measurement, back-calculated integral."""

from __future__ import annotations

import math

from auv_msgs_py.settings import setting, settings
from auv_path_following.control.controller import ControllerOutput, HeadingInputs
from auv_path_following.control.rudder_limiter import RudderLimiter
from auv_path_following.vehicle import Rudder


@settings
class PidConfig:
    """Gains from the heading error to the rudder; docs/tuning.md tells how the defaults were found."""

    kp: float = setting(1.0, "rudder for heading error", gt=0.0, le=100.0, live=True)
    ki: float = setting(
        0.13, "rudder for the integral of the heading error", unit="1/s", ge=0.0, le=100.0, live=True
    )
    kd: float = setting(1.8, "rudder for yaw rate", unit="s", ge=0.0, le=100.0, live=True)
    largest_error: float = setting(
        0.63, "the proportional part acts on at most this heading error, so that far turns stay damped",
        unit="rad", gt=0.0, le=math.pi, live=True,
    )  # fmt: skip


class Pid:
    """delta = kp psi_e + ki integral(psi_e) + kd (r - r_d), within the rudder's angle and rate.

    The derivative is the measured yaw rate against the path's own, so a step of psi_d gives no kick. What
    the rudder could not follow is taken back from the integral (anti-windup by back-calculation).

    Args:
        config: gains.
        rudder: limits of angle and rate.
    """

    def __init__(self, config: PidConfig, rudder: Rudder) -> None:
        self.config = config
        self._limiter = RudderLimiter(rudder)
        self.reset()

    def reset(self) -> None:
        """Forget the integral; the rudder starts from neutral."""
        self._integral = 0.0
        self._limiter.reset()

    def update(self, inputs: HeadingInputs, dt: float) -> ControllerOutput:
        """The rudder for this instant."""
        g = self.config
        error = min(max(inputs.psi_e, -g.largest_error), g.largest_error)
        self._integral += g.ki * error * dt
        wanted = g.kp * error + self._integral + g.kd * (inputs.r - inputs.r_d)
        rudder = self._limiter.limit(wanted, dt)
        # The integral follows the rudder that there is within kd/kp seconds, the law's own lead.
        if g.ki > 0.0 and dt > 0.0:
            tracking = max(g.kd / g.kp, dt)
            self._integral += (rudder - wanted) * min(dt / tracking, 1.0)
        return ControllerOutput(rudder)
