"""What a vehicle can do by its combinations: speed, effect of the rudder, yaw pole, turning radius."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.control.hull_model import HullModel
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.identify.combinations import Combinations, Numbers, hull_with
from auv_sim.own_vehicle.identify.intervals import Covariances, gradient_of
from auv_sim.own_vehicle.identify.unknowns import typed


class Ability(NamedTuple):
    """One figure: name, value, unit, statistical and systematic standard deviation."""

    name: str
    value: float
    unit: str
    statistical: float
    systematic: float

    @property
    def deviation(self) -> float:
        """Standard deviation with both parts."""
        return math.hypot(self.statistical, self.systematic)


def speed_of(c: Combinations, thrust: float) -> float:
    """Return the steady speed straight ahead, m/s."""
    return math.sqrt(max(c.X1 * thrust / -c.Xuu, 0.0)) if c.Xuu < 0.0 else math.nan


def pole_of(c: Combinations, speed: float) -> float:
    """Return the fastest growth of a deviation from straight ahead, rudder neutral, 1/s."""
    matrix = np.array([[c.Yuv, c.Yur], [c.Nuv, c.Nur]]) * speed
    return float(np.linalg.eigvals(matrix).real.max())


def radius_of(c: Combinations, vehicle: Vehicle, share: float) -> float:
    """Return the radius of a steady turn with a share of the rudder, m; NaN where there is none."""
    model = HullModel(dataclasses.replace(vehicle, hull=hull_with(c, vehicle.coefficients)))
    try:
        ur, vr, r = model.steady_motion(vehicle.thrust_max, share * vehicle.rudder.max_angle)
    except ConfigurationError:
        return math.nan
    return math.hypot(ur, vr) / r


def abilities_of(physical: Numbers, spread: Covariances, vehicle: Vehicle) -> list[Ability]:
    """Return what matters to guidance and control, at full thrust.

    Args:
        physical: the unknowns.
        spread: their uncertainty.
        vehicle: in the plane, by coefficients, thrust in N: limits and masses.
    """
    thrust = vehicle.thrust_max

    def speed(p: Numbers) -> float:
        return speed_of(typed(p), thrust)

    functions: list[tuple[str, str, Callable[[Numbers], float]]] = [
        ("speed", "m/s", speed),
        ("effect of the rudder b", "1/s^2", lambda p: abs(typed(p).Nuud) * speed(p) ** 2),
        ("yaw pole", "1/s", lambda p: pole_of(typed(p), speed(p))),
        ("radius, full rudder", "m", lambda p: radius_of(typed(p), vehicle, 1.0)),
        ("radius, 0.3 of the rudder", "m", lambda p: radius_of(typed(p), vehicle, 0.3)),
    ]
    found = []
    for name, unit, function in functions:
        gradient = gradient_of(function, physical, spread)
        value = function(physical)
        found.append(Ability(name, value, unit, spread.statistical(gradient), spread.unseen(gradient)))
    return found
