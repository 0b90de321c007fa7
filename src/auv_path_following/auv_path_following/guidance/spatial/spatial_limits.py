"""How steeply and how slowly a vehicle may dive: Eq. (3D-29)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_path_following.vehicle import Vehicle
from auv_path_following.vertical_hull import reversal_speed

#: Share of the stern planes' moment that may hold the restoring moment.
PLANE_SHARE = 0.6
#: Share of the thrust that the buoyancy may take on the way down.
THRUST_SHARE = 0.35


class Steepness(NamedTuple):
    """Configuration: the bounds of theta_max(u).

    Attributes:
        largest: at any speed, rad.
        planes: sine of the pitch that the stern planes hold at 1 m/s; infinite where it is not known.
        thrust: pitch down to which the thrust overcomes the buoyancy, rad.
        reversal: u_rev, below which lowered planes raise the vehicle, so that no pitch is requested, m/s; 0
            where it is not known.
    """

    largest: float
    planes: float
    thrust: float
    reversal: float


@pure
def steepest_at(config: Steepness, Ur: float) -> float:
    """Return theta_max at a speed through the water (m/s), rad: Eq. (3D-29); 0 below the reversal speed."""
    if Ur < config.reversal:
        return 0.0
    sine = config.planes * Ur * Ur
    bound = math.asin(sine) if sine < 1.0 else 0.5 * math.pi
    return min(config.largest, bound, config.thrust)


def steepest_of(vehicle: Vehicle, thrust: float) -> Steepness:
    """Return the bounds of a vehicle's pitch.

    Args:
        vehicle: with stern planes; its measured climb takes precedence over its coefficients.
        thrust: of the mission, N.
    """
    hull, planes = vehicle.hull, vehicle.sternplanes
    vertical = None if hull is None else hull.vertical
    largest, reach, by_thrust, reversal = vehicle.depth.max_pitch, math.inf, math.inf, 0.0
    if vertical is not None and planes is not None:
        reach = abs(vertical.Muud) * planes.max_angle / (vertical.zg * vertical.W)
        spare = abs(vertical.B - vertical.W)
        by_thrust = THRUST_SHARE * vehicle.newtons(thrust) / spare if spare > 0.0 else math.inf
        reversal = reversal_speed(vertical)
    if vehicle.pitching is not None:
        speed = vehicle.top_speed if vehicle.cruise is None else vehicle.cruise.speed
        reach = math.sin(math.radians(vehicle.pitching.climb_deg)) / speed**2
    bound = math.asin(by_thrust) if by_thrust < 1.0 else 0.5 * math.pi
    return Steepness(largest, PLANE_SHARE * reach, bound, reversal)
