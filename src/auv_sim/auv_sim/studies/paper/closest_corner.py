"""Searches rudder programmes for the smallest deviation at a corner that hull and rudder allow."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.values.types import Command
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

#: Rudder commands of a programme, and how long each is held, s.
_KNOTS, _KNOT = 12, 0.5
_STEP = 0.05
_POPULATION, _ELITE = 40, 8


@dataclass(frozen=True)
class Bound:
    """The best programme found.

    Attributes:
        deviation: largest distance to the two legs, m.
        lead: where the rudder first moved, m before the corner.
    """

    deviation: float
    lead: float


def best(vehicle: Vehicle, angle: float, thrust: float, *, early: bool, effort: int = 1600) -> Bound:
    """Search for the smallest deviation at a corner, with the rudder's rate and angle as its only limits.

    The programme is made for this hull and corner, which no feedback law is; afterwards the vehicle
    is on the second leg, with its course, turning no more. It is the best of a direct search, so the true
    bound may be a little lower still.

    Args:
        vehicle: hull and rudder.
        angle: course change, rad, to starboard.
        thrust: N.
        early: whether the rudder may move before the corner is reached.
        effort: programmes tried, at least.
    """
    speed = math.sqrt(thrust / -vehicle.coefficients.Xuu)
    rng = np.random.default_rng(0)
    mean = np.concatenate([[4.0 if early else 0.0], [-0.8, -0.8, -0.4, 0.4, 0.4, 0.2], np.zeros(_KNOTS - 6)])
    spread = np.concatenate([[1.0 if early else 0.0], np.full(_KNOTS, 0.4)])
    best_cost, best_lead = math.inf, 0.0
    for _ in range(max(1, effort // _POPULATION)):
        tried = mean + spread * rng.standard_normal((_POPULATION, _KNOTS + 1))
        tried[:, 1:] = np.clip(tried[:, 1:], -1.0, 1.0)
        costs = np.array([_cost(vehicle, angle, thrust, speed, program) for program in tried])
        elite = tried[np.argsort(costs)[:_ELITE]]
        # The spread shrinks with the elite's, but not so fast that the search stands still too early.
        mean, spread = elite.mean(axis=0), 0.3 * spread + 0.7 * elite.std(axis=0)
        if costs.min() < best_cost:
            best_cost, best_lead = float(costs.min()), float(elite[0, 0])
    return Bound(best_cost, best_lead)


def _cost(vehicle: Vehicle, angle: float, thrust: float, speed: float, program: NDArray[np.float64]) -> float:
    """Return the largest distance to the legs, plus 1 m for each 0.2 rad off the final course beyond 0.1 rad.

    Args:
        vehicle, angle, thrust: as for `best`.
        speed: at the beginning, m/s.
        program: shape (_KNOTS + 1,): where it begins, m before the corner, then shares of the largest angle.
    """
    plant = SimulatedVehicle(vehicle, PlantState(-max(float(program[0]), 0.0), 0.0, 0.0, speed, 0.0, 0.0))
    cos, sin = math.cos(angle), math.sin(angle)
    worst = 0.0
    for share in program[1:].tolist():
        for _ in range(round(_KNOT / _STEP)):
            plant.advance(Command(share * vehicle.rudder.max_angle, thrust), _STEP)
            x, y = plant.motion[:2]
            first = math.hypot(max(x, 0.0), y)
            along = max(x * cos + y * sin, 0.0)
            second = math.hypot(x - along * cos, y - along * sin)
            worst = max(worst, min(first, second))
    x, y, psi, ur, vr, r = plant.motion
    off = abs(-x * sin + y * cos)
    course = abs(psi + math.atan2(vr, ur) - angle)
    return max(worst, off) + max(course - 0.1, 0.0) / 0.2 + max(abs(r) - 0.1, 0.0) / 0.1
