"""Recordings of simulated manoeuvres as the identification reads them, and the truth behind them."""

from __future__ import annotations

import numpy as np

from auv_path_following.vehicle import Hull
from auv_sim.own_vehicle.identify.dive.dive_data import Coupling, DiveData
from auv_sim.own_vehicle.identify.dive.vertical_motion import VerticalMotion, vertical_loads_of
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import Manoeuvred
from auv_sim.vehicle.draws import Draws
from auv_sim.vehicle.noise import noise_of
from auv_sim.vehicle.sea import Sea


def planar_data(flown: Manoeuvred, name: str = "simulated", diving: Hull | None = None) -> PlanarData:
    """Return manoeuvres of `simulate` as a recording; of a hull that dives with heave, roll and pitch."""
    t = flown.t
    return PlanarData(
        name, t, flown.r, flown.water_t, flown.water_u, flown.water_v, t, flown.rudder, t, flown.thrust,
        flown.psi, flown.u, flown.v, np.asarray(flown.leg), _vertical(flown, diving),
    )  # fmt: skip


def _vertical(flown: Manoeuvred, hull: Hull | None) -> VerticalMotion | None:
    if hull is None or hull.vertical is None:
        return None
    loads = vertical_loads_of(hull, hull.vertical)
    return VerticalMotion(flown.t, flown.phi, flown.theta, flown.q, flown.water_t, flown.water_w, loads)


def dive_data(flown: Manoeuvred, coupling: Coupling, name: str = "simulated") -> DiveData:
    """Return the vertical motion of `simulate` as a recording."""
    t, water = flown.t, (flown.water_t, flown.water_u, flown.water_v, flown.water_w)
    fins = t, flown.sternplanes, t, flown.thrust
    return DiveData(name, t, flown.q, flown.theta, flown.phi, flown.r, *water, *fins, coupling)


def thrust_share(sea: Sea, seed: int, step: float = 0.05) -> float:
    """Return the mean efficiency of the propeller in a run of `simulate`: 1 and its bias."""
    propeller, _ = noise_of(sea.thrust, (seed, 1), Draws(step, 1))
    return 1.0 + propeller.bias
