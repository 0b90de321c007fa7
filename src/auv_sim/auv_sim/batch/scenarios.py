"""From a scenario of `closed_loop` to the plain numbers of the batch engine."""

from __future__ import annotations

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.pure import numbers_of
from auv_path_following.control import autopilot
from auv_path_following.guidance.approach import Agility, agility_of, turn_radius
from auv_path_following.guidance.laws import LAWS
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.registry import law_of
from auv_sim.batch.numbers import SWITCHING, Flight, Guidance
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
        guidance=_guidance(c.guidance, agility_of(assumed, c.thrust)),
        observer=numbers_of(c.observer),
        autopilot=autopilot.prepare(c.autopilot, assumed),
        thrust=float(c.thrust),
        Vx=float(c.current.Vx),
        Vy=float(c.current.Vy),
        dt=round(c.step * 1e9) * 1e-9,
        steps=int(c.time_limit / c.step) + 1,
    )


def _guidance(config: PathFollowerConfig, agility: Agility) -> Guidance:
    law = law_of(LAWS, config.law)
    return Guidance(
        law=law.prepare(getattr(config, law.name), None),
        law_begins=law.initial,
        compensate_current=config.compensate_current,
        minimum_speed=float(config.minimum_speed),
        k=float(config.virtual_point.k),
        saturation=float(config.virtual_point.saturation),
        approach_radius=float(turn_radius(config.approach, agility, config.lookahead)),
        turn_rate=float(agility.turn_rate),
        switching=SWITCHING.index(config.switching.mode),
        radius=float(config.switching.radius),
        cornering=agility.cornering,
        lookahead=float(config.lookahead),
    )
