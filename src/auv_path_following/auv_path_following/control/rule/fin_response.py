"""Response of a hull to its rudder, or seen from the side to its stern planes, as a few numbers."""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.control.hull_model import (
    TYPICAL_EFFECT,
    HullModel,
    rudder_gain,
    slopes,
    tightest_turn,
)
from auv_path_following.vehicle import Vehicle

#: p L/u and drift time (s) of a torpedo of which neither is measured, and the share of u/R that a turn with a
#: measured radius R reaches: speed is lost in it.
TYPICAL_DIVERGENCE, TYPICAL_DRIFT_TIME, TURN_SHARE = 1.2, 0.3, 0.75
#: Radius of the tightest turns of a course: in radii with the full fin, and at least in hull lengths.
COURSE_TURNS, COURSE_LENGTHS = 2.0, 4.6


class FinResponse(NamedTuple):
    """Response at the speed of design, straight ahead: of yaw to the rudder, or of pitch to the planes.

    Attributes:
        speed: of design: that of the measured cruise, else that of full thrust, m/s.
        effect: b = |dr/dt| for each radian at once, 1/s^2.
        divergence: p, growth of a deviation, 1/s; below 0 it decays.
        turn: largest steady rate, rad/s.
        drift_time: T_v, with which sideslip settles in a turn with half the fin, s.
        zero, pole: of the part that sideslip adds, (s - zero)/(s - pole), 1/s; equal where it is not known.
        course_turn: rate at the beginning of the tightest turn of a course, before it costs speed, rad/s;
            0 where there are none.
        slip: share of a turn of the bow that sideslip takes back at once; 0 where it is not known.
    """

    speed: float
    effect: float
    divergence: float
    turn: float
    drift_time: float
    zero: float
    pole: float
    course_turn: float = 0.0
    slip: float = 0.0

    def gain(self, w: float) -> complex:
        """Return r/delta at the angular frequency w (1/s), 1/s; positive for a fin that works at once."""
        s = complex(0.0, w)
        return self.effect * (s - self.zero) / ((s - self.pole) * (s - self.divergence))

    def lag(self, w: float) -> float:
        """Return by how much sideslip makes the response later at w (1/s), s; 0 where it makes it earlier."""
        s = complex(0.0, w)
        return max(-cmath.phase((s - self.zero) / (s - self.pole)), 0.0) / w

    def slip_at(self, w: float) -> float:
        """Return the share of a swing of the bow at w (1/s) that sideslip takes back."""
        return self.slip * w / math.hypot(w, self.zero)


def response_of(vehicle: Vehicle) -> FinResponse:
    """Return the response of a vehicle to its rudder.

    What is measured under `turning` takes precedence over the hull's coefficients. Without either it is that
    of a typical torpedo of the vehicle's length and speed.

    Raises:
        ConfigurationError: no turn of the hull is steady, and none was measured.
    """
    speed = vehicle.top_speed if vehicle.cruise is None else vehicle.cruise.speed
    turning, size = vehicle.turning, speed / vehicle.length
    if vehicle.hull is not None and (turning is None or turning.effect is None):
        return _of_hull(vehicle, speed)
    effect = divergence = drift_time = None
    radius = tightest_turn(vehicle).radius
    if turning is not None:
        effect, divergence, drift_time = turning.effect, turning.divergence, turning.drift_time
    pole = -size
    return FinResponse(
        speed,
        TYPICAL_EFFECT * size * size if effect is None else effect,
        TYPICAL_DIVERGENCE * size if divergence is None else divergence,
        TURN_SHARE * speed / radius,
        TYPICAL_DRIFT_TIME if drift_time is None else drift_time,
        pole,
        pole,
        _course_turn(vehicle, speed, radius),
    )


def _of_hull(vehicle: Vehicle, speed: float) -> FinResponse:
    model = HullModel(vehicle)
    (vv, vr), (rv, rr) = slopes(model.sway_yaw, speed, 0.0, 0.0)
    by_sway, by_yaw = rudder_gain(model.sway_yaw, speed)
    middle, spread = 0.5 * (vv + rr), cmath.sqrt(0.25 * (vv - rr) ** 2 + vr * rv)
    # A pair of complex poles counts with its real part: such a hull is damped.
    divergence, pole = (middle + spread).real, (middle - spread).real
    thrust = vehicle.newtons(vehicle.thrust_at(speed))
    try:
        ur, drift, _ = model.steady_motion(thrust, 0.5 * vehicle.rudder.max_angle)
    except ConfigurationError:
        ur, drift = speed, 0.0
    radius = tightest_turn(vehicle).radius
    turn = TURN_SHARE * speed / radius if vehicle.turning else model.steady_turn(thrust).rate
    settling = -slopes(model.sway_yaw, ur, drift, 0.0)[0][0]
    return FinResponse(
        speed,
        abs(by_yaw),
        divergence,
        turn,
        1.0 / settling if settling > 0.0 else math.inf,
        vv - rv * by_sway / by_yaw,
        pole,
        _course_turn(vehicle, speed, radius),
        # v' = zero v - slip speed r + ..., with the rudder that a yaw rate needs.
        (rr * by_sway / by_yaw - vr) / speed,
    )


def _course_turn(vehicle: Vehicle, speed: float, radius: float) -> float:
    return speed / max(COURSE_TURNS * radius, COURSE_LENGTHS * vehicle.length)
