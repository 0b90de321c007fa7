"""From a scenario of `closed_loop` to the plain numbers of the batch engine."""

from __future__ import annotations

from auv_msgs_py.errors import ConfigurationError
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.control.hull_model import HullModel
from auv_path_following.control.nism import Nism
from auv_path_following.guidance.approach import Agility, agility_of, turn_radius
from auv_path_following.guidance.current_observer import transition
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_sim.batch.numbers import (
    CONTROLLERS,
    LAWS,
    SWITCHING,
    Autopilot,
    Configured,
    Dynamics,
    Flight,
    Guidance,
    Model,
    Observer,
    Plant,
    numbers_of,
)
from auv_sim.closed_loop import Scenario
from auv_sim.plant.remus import RemusDynamics, RemusPlant


def flight_of(scenario: Scenario) -> Flight:
    """All that decides a flight but its path and its start.

    Raises:
        ConfigurationError: something that a flight cannot be made of: no hull, no thrust.
    """
    c = scenario
    believed = c.controller_vehicle or c.vehicle
    if not c.thrust > 0.0:
        raise ConfigurationError("thrust", f"{c.thrust:g}", "a number greater than 0")
    pilot = HeadingAutopilot(believed, c.autopilot)
    ordered = min(c.thrust, believed.thrust_max)
    nism = pilot.controller.config if isinstance(pilot.controller, Nism) else c.autopilot.nism
    model = HullModel(believed if believed.hull is not None else c.vehicle)
    dt = round(c.step * 1e9) * 1e-9
    return Flight(
        plant=Plant(
            dynamics=Dynamics.of(RemusDynamics(c.vehicle)),
            max_angle=c.vehicle.rudder.max_angle,
            max_rate=c.vehicle.rudder.max_rate,
            max_step=RemusPlant.MAX_STEP,
            thrust=float(min(ordered, c.vehicle.thrust_max)),
        ),
        guidance=_guidance(c.guidance, agility_of(believed, c.thrust)),
        observer=Observer(*transition(c.observer.k_ob1, c.observer.k_ob2, dt)),
        autopilot=Autopilot(
            controller=CONTROLLERS.index(c.autopilot.controller),
            bandwidth=float(c.autopilot.derivative.bandwidth),
            nism=numbers_of(nism),
            pid=numbers_of(c.autopilot.pid),
            smc=numbers_of(c.autopilot.smc),
            shaped=c.autopilot.reference.enabled,
            reference=Configured(numbers_of(c.autopilot.reference)),
            limits=pilot.reference.limits,
            max_angle=believed.rudder.max_angle,
            max_rate=believed.rudder.max_rate,
            model=Model.of(model, ordered),
        ),
        thrust=float(ordered),
        Vx=float(c.current.Vx),
        Vy=float(c.current.Vy),
        dt=dt,
        steps=int(c.time_limit / c.step) + 1,
    )


def _guidance(config: PathFollowerConfig, agility: Agility) -> Guidance:
    return Guidance(
        law=LAWS.index(config.law),
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
        ailos=Configured(numbers_of(config.ailos)),
        ilos=numbers_of(config.ilos),
        los=Configured(numbers_of(config.los)),
    )
