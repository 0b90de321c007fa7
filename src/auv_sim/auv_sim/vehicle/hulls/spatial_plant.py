"""A hull in six degrees of freedom with rudder, stern planes and propeller."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import dispatched, pure
from auv_msgs_py.values.types import SpatialCommand, SpatialCurrent, SpatialNavigation, SpatialWater
from auv_path_following.vehicle import BuiltInHull, Vehicle
from auv_sim.vehicle.fins.actuator import ServoState, servo_at, servo_of, servo_step
from auv_sim.vehicle.hulls.mss_remus100 import MssRemus100, mss_remus100, mss_remus100_step
from auv_sim.vehicle.hulls.remus_6dof import Remus6dof, remus_6dof_of, remus_6dof_step
from auv_sim.vehicle.hulls.rigid_body import BodyState, angles_of, to_body
from auv_sim.vehicle.remus import MAX_STEP

#: One step of a hull: (configuration, state, `BodyInputs`, dt) -> (state, state).
body_step = dispatched({Remus6dof: remus_6dof_step, MssRemus100: mss_remus100_step})


#: Hulls without coefficients, by the name in a vehicle file.
BUILT_IN: dict[BuiltInHull, Callable[[], Any]] = {"mss_remus100": mss_remus100}


class SpatialPlant(NamedTuple):
    """Configuration of a hull with its fins and propeller.

    Attributes:
        hull: of `body_step`.
        rudder, sternplanes: of `servo_step`.
        thrust_max: N.
        max_step: longest Runge-Kutta step, s.
    """

    hull: Any
    rudder: Any
    sternplanes: Any
    thrust_max: float
    max_step: float = MAX_STEP


class SpatialAfloat(NamedTuple):
    """State of a plant: that of its hull and of its servos."""

    hull: BodyState
    rudder: Any
    sternplanes: Any


#: Command, current (m/s, NED), and the propeller's efficiency: 1 for the thrust as commanded.
SpatialPlantInputs = tuple[SpatialCommand, SpatialCurrent, float]


def spatial_plant_of(vehicle: Vehicle) -> SpatialPlant:
    """Return the configuration of a vehicle whose servos are ideal but for their dead time.

    Raises:
        ConfigurationError: the vehicle file lacks stern planes or coefficients.
    """
    if vehicle.sternplanes is None:
        raise ConfigurationError(f"{vehicle.name}: sternplanes", "nothing", "their largest angle and rate")
    body = (
        BUILT_IN[vehicle.simulated_as]()
        if vehicle.simulated_as is not None
        else remus_6dof_of(vehicle.coefficients)
    )
    return SpatialPlant(
        body, servo_of(vehicle.rudder), servo_of(vehicle.sternplanes), vehicle.newtons(vehicle.thrust_max)
    )


def spatial_plant_at(hull: BodyState, plant: SpatialPlant | None = None) -> SpatialAfloat:
    """Return the state of a plant with its servos in neutral; of one with ideal servos if None."""
    if plant is None:
        return SpatialAfloat(BodyState(*map(float, hull)), ServoState(), ServoState())
    return SpatialAfloat(BodyState(*map(float, hull)), servo_at(plant.rudder), servo_at(plant.sternplanes))


@pure
def spatial_plant_step(
    config: SpatialPlant, state: SpatialAfloat, inputs: SpatialPlantInputs, dt: float
) -> tuple[SpatialAfloat, BodyState]:
    """Advance by `dt` seconds under a held command and current; the output is the hull's motion."""
    hull, rudder, sternplanes = state
    command, current, efficiency = inputs
    largest = config.thrust_max
    thrust = 0.0 if command.thrust < 0.0 else largest if command.thrust > largest else command.thrust
    thrust *= efficiency
    water = (current.Vx, current.Vy, current.Vz)
    substeps = 1 if dt <= config.max_step else math.ceil(dt / config.max_step - 1e-9)
    h = dt / substeps
    for k in range(substeps):
        rudder, first = servo_step(config.rudder, rudder, (command.rudder, k == 0), h)
        sternplanes, second = servo_step(config.sternplanes, sternplanes, (command.sternplanes, k == 0), h)
        hull, _ = body_step(config.hull, hull, (first, second, thrust, water), h)
    return SpatialAfloat(hull, rudder, sternplanes), hull


@pure
def spatial_navigation_of(body: BodyState) -> SpatialNavigation:
    """Return ideal navigation."""
    phi, theta, psi = angles_of(body)
    return SpatialNavigation(body.x, body.y, body.z, phi, theta, psi, body.q, body.r)


@pure
def spatial_water_of(body: BodyState) -> SpatialWater:
    """Return the velocity through the water as an ideal log measures it."""
    return SpatialWater(body.ur, body.vr, body.wr)


@pure
def spatial_ground_velocity(body: BodyState, current: SpatialCurrent) -> tuple[float, float, float]:
    """Return (u, v, w) over ground, m/s, FRD: Eq. (3D-1) in body axes."""
    uc, vc, wc = to_body(body.qw, body.qi, body.qj, body.qk, current.Vx, current.Vy, current.Vz)
    return body.ur + uc, body.vr + vc, body.wr + wc
