"""From a scenario of `closed_loop` to the plain numbers of the batch engine."""

from __future__ import annotations

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.pure import numbers_of
from auv_path_following.control import autopilot
from auv_path_following.guidance import path_follower
from auv_path_following.guidance.approach import agility_of
from auv_sim.batch.numbers import Flight
from auv_sim.closed_loop import Scenario
from auv_sim.plant.remus import plant_of


def flight_of(scenario: Scenario) -> Flight:
    """Return all that decides a flight but its path and its start.

    Raises:
        ConfigurationError: something that a flight cannot be made of: no hull, no thrust.
    """
    c = scenario
    assumed = c.controller_vehicle or c.vehicle
    if not c.thrust > 0.0:
        raise ConfigurationError("thrust", f"{c.thrust:g}", "a number greater than 0")
    return Flight(
        plant=plant_of(c.vehicle),
        guidance=path_follower.prepare(c.guidance, agility_of(assumed, c.thrust)),
        observer=numbers_of(c.observer),
        autopilot=autopilot.prepare(c.autopilot, assumed),
        thrust=float(c.thrust),
        Vx=float(c.current.Vx),
        Vy=float(c.current.Vy),
        dt=round(c.step * 1e9) * 1e-9,
        steps=int(c.time_limit / c.step) + 1,
    )
