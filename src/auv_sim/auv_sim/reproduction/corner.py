"""How near to a corner can this hull with this rudder stay at all? A search over rudder programmes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from auv_msgs_py.types import Command
from auv_path_following.vehicle import Vehicle
from auv_sim.plant.remus import PlantState, RemusPlant

_KNOTS = 7
_STEP = 0.05


@dataclass(frozen=True)
class Bound:
    """The best programme found: largest distance to the two legs (m), and where the rudder first "
    "moved (m before the corner)."""

    deviation: float
    lead: float


def best(vehicle: Vehicle, angle: float, thrust: float, *, early: bool, effort: int = 700) -> Bound:
    """Smallest largest distance found at a corner, with the rudder's rate and angle as its only limits.

    The programme knows the hull and the corner beforehand, which no feedback law does; afterwards the vehicle
    is on the second leg, with its course, turning no more. It is the best of a direct search, so the true
    bound may be a little lower still.

    Args:
        vehicle: hull and rudder.
        angle: course change, rad, to starboard.
        thrust: N.
        early: whether the rudder may move before the corner is reached.
        effort: programmes tried from each of the two first guesses.
    """
    speed = math.sqrt(thrust / -vehicle.hull.Xuu)
    largest = vehicle.rudder.max_angle
    found = Bound(math.inf, 0.0)
    for duration, push in ((0.75, 0.4), (0.95, 0.3)):
        program = np.zeros(_KNOTS)
        program[:2], program[3:5] = -push, 0.6 * push
        lead = speed * duration * 2.0 if early else 0.0
        guess = np.concatenate([[duration, lead], program])
        found_here = minimize(
            lambda v: _cost(vehicle, angle, thrust, speed, early, v, largest),
            guess,
            method="Nelder-Mead",
            options={"maxfev": effort, "xatol": 1e-3, "fatol": 1e-4, "adaptive": True},
        ).x
        deviation = _cost(vehicle, angle, thrust, speed, early, found_here, largest)
        if deviation < found.deviation:
            found = Bound(deviation, float(found_here[1]) if early else 0.0)
    return found


def _cost(
    vehicle: Vehicle,
    angle: float,
    thrust: float,
    speed: float,
    early: bool,
    v: NDArray[np.float64],
    largest: float,
) -> float:
    """Largest distance to the legs, plus what is still wrong at the end: 1 m, 0.2 rad or 0.1 rad/s "
    "cost a metre."""
    duration, lead = float(np.clip(v[0], 0.3, 1.5)), float(np.clip(v[1], 0.0, 15.0)) if early else 0.0
    plant = RemusPlant(vehicle, PlantState(-lead, 0.0, 0.0, speed, 0.0, 0.0))
    cos, sin = math.cos(angle), math.sin(angle)
    worst = 0.0
    steps = max(1, round(duration / _STEP))
    for knot in [*np.clip(v[2:], -1.0, 1.0).tolist(), 0.0]:
        for _ in range(steps):
            plant.advance(Command(knot * largest, thrust), _STEP)
            x, y = plant.state.x, plant.state.y
            first = math.hypot(max(x, 0.0), y)
            along = max(x * cos + y * sin, 0.0)
            second = math.hypot(x - along * cos, y - along * sin)
            worst = max(worst, min(first, second))
    x, y, psi, ur, vr, r = plant.state
    off = abs(-x * sin + y * cos)
    course = abs(psi + math.atan2(vr, ur) - angle)
    return worst + max(off - worst, 0.0) + max(course - 0.02, 0.0) / 0.2 + max(abs(r) - 0.03, 0.0) / 0.1
