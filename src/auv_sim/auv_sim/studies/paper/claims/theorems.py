"""Theorems 1, 2, 3: each system alone, started off its equilibrium, and the rate at which it returns."""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np

from auv_msgs_py.values.types import Current, Navigation, Reference, WaterVelocity
from auv_path_following.control.autopilot import AutopilotConfig, HeadingAutopilot
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.path_follower import PathFollower, PathFollowerConfig
from auv_path_following.navigation.current_observer import CurrentObserver, CurrentObserverConfig
from auv_path_following.vehicle import Vehicle
from auv_sim.studies.paper.claims.measures import Decay, decay
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

_STEP = 0.02
_SPEED = 2.0


class Checked(NamedTuple):
    """A fitted decay beside the slowest eigenvalue that theory gives (1/s)."""

    measured: Decay
    theory: float


def guidance_rate(Delta: float, Ur: float, across: float) -> float:
    """Return the rate at which ye decays near the path, 1/s.

    From Eqs. (30), (32): Ur / sqrt(Delta^2 + alpha^2) at ye = 0.

    Args:
        Delta: look-ahead, m.
        Ur: speed through the water, m/s.
        across: current across the path, m/s.
    """
    theta_n = across / Ur
    alpha = theta_n * Delta / math.sqrt(1.0 - theta_n * theta_n)
    return Ur / math.hypot(Delta, alpha)


def theorem_1(config: PathFollowerConfig, current: Current) -> dict[str, Checked]:
    """Check guidance with a perfect heading and a known current, along a straight line to the north."""
    path = CompositePath([Line(0.0, 0.0, 400.0, 0.0)])
    follower = PathFollower(path, config)
    water = WaterVelocity(_SPEED, 0.0)
    x, y, rows = 5.0, 4.0, []
    # P starts at the line's beginning: xe = 5 m (k xe is not saturated) and ye = 4 m decay side by side.
    for k in range(int(60.0 / _STEP)):
        psi = 0.0
        for dt in (_STEP if k else 0.0, 0.0):  # psi_d does not depend on psi: the second one has psi = psi_d
            g = PathFollower.update(follower, Navigation(x, y, psi, 0.0), water, current, dt)
            psi = g.psi_d
        rows.append((k * _STEP, abs(g.xe), abs(g.ye)))
        x += (_SPEED * math.cos(psi) + current.Vx) * _STEP
        y += (_SPEED * math.sin(psi) + current.Vy) * _STEP
    t, xe, ye = np.array(rows).T
    rate = guidance_rate(config.ailos.lookahead, _SPEED, current.Vy)
    return {
        "xe": Checked(decay(t, xe, 10.0, 1e-3), config.virtual_point.k),
        "ye": Checked(decay(t, ye, 1.0, 1e-3), rate),
    }


def theorem_2(config: CurrentObserverConfig, current: Current) -> Checked:
    """Check the observer on a vehicle that turns, from an estimate of zero.

    With complex poles the error swings; along the left eigenvector of Eq. (36) it is a pure exponential.
    """
    observer = CurrentObserver(config)
    pole = 0.5 * (-config.k_ob2 + cmath.sqrt(config.k_ob2**2 - 4.0 * config.k_ob1))
    x = y = psi = 0.0
    rows = []
    for k in range(int(30.0 / _STEP)):
        out = observer.update(Navigation(x, y, psi, 0.1), WaterVelocity(_SPEED, 0.0), _STEP if k else 0.0)
        gap = (out.current.Vx - current.Vx, out.current.Vy - current.Vy)
        size = math.hypot(abs(-pole * out.ex + gap[0]), abs(-pole * out.ey + gap[1]))
        rows.append((k * _STEP, size))
        # The observer takes the mean of both ends for the velocity in between: move likewise.
        turned = psi + 0.1 * _STEP
        x += (0.5 * _SPEED * (math.cos(psi) + math.cos(turned)) + current.Vx) * _STEP
        y += (0.5 * _SPEED * (math.sin(psi) + math.sin(turned)) + current.Vy) * _STEP
        psi = turned
    t, size = np.array(rows).T
    return Checked(decay(t, size, 0.2, 1e-6), -max(pole.real, pole.conjugate().real))


def theorem_3(config: AutopilotConfig, vehicle: Vehicle, thrust: float) -> Checked:
    """Check NISM on the simulated hull with 0.1 rad, small enough that the rudder's rate is no bound."""
    plant = SimulatedVehicle(vehicle, PlantState(0.0, 0.0, 0.1, _SPEED, 0.0, 0.0))
    autopilot = HeadingAutopilot(vehicle, config)
    rows = []
    for k in range(int(20.0 / _STEP)):
        out = autopilot.update(plant.navigation, Reference(0.0, 0.0, thrust), _STEP if k else 0.0)
        rows.append((k * _STEP, abs(out.psi_e)))
        plant.advance(out.command, _STEP)
    t, error = np.array(rows).T
    g = config.nism
    # On sigma_2 = 0: sigma_1' = -k3 k4 sigma_1; on sigma_1 = 0: psi_e' = -k1 k2 psi_e.
    return Checked(decay(t, error, 0.02, 2e-4), min(g.k1 * g.k2, g.k3 * g.k4))
