"""Radius of the circle of acceptance, Eq. (44), from corner, hull and current."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.control.hull_model import measured_effect, tightest_turn
from auv_path_following.control.nism import NismConfig, kp_of
from auv_path_following.control.reference_model import ReferenceConfig, ReferenceLimits, limits_of
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.rows import CHI_IN, CHI_OUT, WIDEST
from auv_path_following.vehicle import Vehicle

#: Largest ratio of the current across a leg to the speed through the water.
_LARGEST_SHARE = 0.95
#: Largest change of heading that counts, rad: the formula was fitted up to it.
_SHARPEST = math.radians(135.0)
#: Exponent of tan(change/2): with 1 the turn ends on the new leg, with less it overshoots the leg by about
#: the distance by which it cuts the corner. Fitted, like the share of Delta, to the best radii at corners of
#: 30 to 120 deg.
_SHARPNESS = 0.85
#: Upper bound of tan(change/2)^0.85, which is 2.12 at the largest change.
_MOST_TURN = 2.5
#: Share of Delta by which line of sight turns late at a shallow corner, and early at a sharp one.
_LOOKAHEAD_SHARE = 0.17
#: Lag of the heading behind its reference, s.
_LAG = 0.05
#: Lead of a vehicle without a hull in its file, s; all shipped hulls have about the same.
_USUAL_LEAD = 1.0


class Cornering(NamedTuple):
    """Turning ability at a corner.

    Attributes:
        rate: largest yaw rate, rad/s.
        lead: time by which limits of acceleration and jerk advance the start of a turn, s.
    """

    rate: float
    lead: float


def cornering_of(vehicle: Vehicle) -> Cornering:
    """Return the turning ability that hull and rudder allow: the limits of `limits_of` at settings of 0.

    Raises:
        ConfigurationError: no turn of the hull is steady, and none was measured.
    """
    if vehicle.hull is None and measured_effect(vehicle) is None:
        return Cornering(vehicle.top_speed / tightest_turn(vehicle).radius, _USUAL_LEAD)
    rudder_rate = kp_of(NismConfig(kp_from_rudder=True), vehicle)
    return cornering_within(limits_of(ReferenceConfig(), vehicle, rudder_rate))


def cornering_within(limits: ReferenceLimits) -> Cornering:
    """Return the turning ability of a vehicle whose heading reference has these limits."""
    rate, acceleration, jerk = limits
    return Cornering(rate, 0.5 * rate / acceleration + 0.5 * acceleration / jerk + _LAG)


class JointCorner(NamedTuple):
    """A joint: courses of both legs there (rad), and the widest circle (m)."""

    chi_in: float
    chi_out: float
    widest: float


def corner_of(path: CompositePath, i: int) -> JointCorner:
    """Return the corner at the end of subpath `i` (from 0); its circle takes half the shorter leg at most."""
    row = path.rows.subpath[i]
    return JointCorner(row[CHI_IN], row[CHI_OUT], row[WIDEST])


@pure
def acceptance_radius(
    cornering: Cornering, corner: JointCorner, lookahead: float, Ur: float, current: Current = NO_CURRENT
) -> float:
    """Return Rk, m: distance from the corner at which the turn to the next leg begins.

        Rk = Ug lead + (Ug / rate) tan(change / 2)^0.85 + 0.17 Delta cos(change)

    Ug is the speed over ground on the leg in. The change is that of the heading, so it includes the crab
    angles on both legs.

    Args:
        cornering: of the vehicle.
        corner: the joint.
        lookahead: Delta, m.
        Ur: speed through the water, m/s.
        current: m/s, NED.
    """
    if not Ur > 0.0:
        return 0.0
    crab_in, crab_out = crab_angle(corner.chi_in, Ur, current), crab_angle(corner.chi_out, Ur, current)
    step = wrap((corner.chi_out + crab_out) - (corner.chi_in + crab_in))
    change = min(abs(step), _SHARPEST)
    along = math.cos(corner.chi_in) * current.Vx + math.sin(corner.chi_in) * current.Vy
    Ug = max(along + Ur * math.cos(crab_in), 0.0)
    turn = Ug / cornering.rate * math.pow(math.tan(0.5 * change), _SHARPNESS)
    radius = Ug * cornering.lead + turn + _LOOKAHEAD_SHARE * lookahead * math.cos(change)
    return min(max(radius, 0.0), corner.widest)


@pure
def reach(cornering: Cornering, lookahead: float, Ur: float, current: Current) -> float:
    """Return an upper bound of `acceptance_radius` over all corners, m.

    Each of the three terms is at its largest, with the current from astern.

    Args:
        cornering: of the vehicle.
        lookahead: Delta, m.
        Ur: speed through the water, m/s.
        current: m/s, NED.
    """
    Ug = Ur + math.hypot(current.Vx, current.Vy)
    return Ug * (cornering.lead + _MOST_TURN / cornering.rate) + _LOOKAHEAD_SHARE * lookahead


@pure
def crab_angle(chi: float, Ur: float, current: Current) -> float:
    """Return the crab angle (heading less course) on a course `chi`, rad; its sine is theta_n of Eq. (31)."""
    across = (-math.sin(chi) * current.Vx + math.cos(chi) * current.Vy) / Ur
    return -math.asin(min(max(across, -_LARGEST_SHARE), _LARGEST_SHARE))
