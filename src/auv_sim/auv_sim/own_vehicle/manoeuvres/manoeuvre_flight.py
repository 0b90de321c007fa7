"""A program of manoeuvres flown on the simulated vehicle without ROS: what a recording of it would hold."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.values.attitude import attitude_over_the_wire
from auv_msgs_py.values.types import NO_CURRENT, Command, Current, SpatialNavigation
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.manoeuvres.legs import manoeuvres_of
from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import DEPTH, in_space
from auv_sim.own_vehicle.manoeuvres.manoeuvring import manoeuvre, manoeuvring_begins
from auv_sim.own_vehicle.manoeuvres.program_file import Program
from auv_sim.vehicle.diving.simulated_diver import simulated_vehicle
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.sea import Sea

Column = NDArray[np.float64]


class Manoeuvred(NamedTuple):
    """Recording of a program, NED and FRD; rows of n odometries, and m measurements of the log.

    Attributes:
        t: stamps of the odometries, s, shape (n,).
        x, y, z: reported position, m.
        phi, theta, psi: reported attitude, rad; psi in [-pi, pi).
        q, r: reported pitch and yaw rate, rad/s.
        u, v, w: reported velocity over ground, m/s; NaN without bottom lock.
        rudder, sternplanes, thrust: commands that answered the odometry, rad, rad, N.
        leg: number of the manoeuvre that was under way; of a vehicle that dives 0 is the way to the depth.
        water_t: stamps of the odometries with which a new measurement of the log came, s, shape (m,).
        water_u, water_v, water_w: velocity through the water, m/s, as it was `water_latency` before.
        water_latency: age of those measurements, s.
        current: true current at each odometry, m/s, NED, shape (n, 3); for judging alone.
    """

    t: Column
    x: Column
    y: Column
    z: Column
    phi: Column
    theta: Column
    psi: Column
    q: Column
    r: Column
    u: Column
    v: Column
    w: Column
    rudder: Column
    sternplanes: Column
    thrust: Column
    leg: Column
    water_t: Column
    water_u: Column
    water_v: Column
    water_w: Column
    water_latency: float
    current: Column


def simulate(
    vehicle: Vehicle,
    sea: Sea | None,
    program: Program,
    seed: int = 0,
    *,
    step: float = 0.05,
    current: Current = NO_CURRENT,
    depth: float = DEPTH,
) -> Manoeuvred:
    """Fly a program on the simulated vehicle, from rest towards north; a sea adds to the fins' dead time.

    Args:
        vehicle, sea: the hull, with its delay as `rudder.dead_time`; imperfections, or None.
        program: of manoeuvres.
        seed: of the sea's random numbers.
        step: time between odometries, s.
        current: constant, m/s, NED, added to the sea's own.
        depth: that a vehicle which dives begins at and holds, m.

    Raises:
        ConfigurationError: the vehicle has no coefficients, or lacks what the program needs.
    """
    config, dt = manoeuvres_of(program, vehicle), round(step * 1e9) * 1e-9
    simulated: Any = simulated_vehicle(vehicle, _start(vehicle, depth), sea, seed, current, dt)
    rows: list[tuple[float, ...]] = []
    water: list[tuple[float, ...]] = []
    state = manoeuvring_begins(_reported(simulated.seen.navigation), depth if vehicle.dives else 0.0)
    for k in range(math.ceil(config.duration / dt) + 1):
        seen, t = simulated.seen, topics.FIRST_STAMP_NS * 1e-9 + k * dt
        navigation = _reported(seen.navigation)
        state, command = manoeuvre(config, state, navigation, dt if k else 0.0)
        if state.leg >= len(config.legs):
            break
        ground, through = _in_space(simulated.ground_velocity), _in_space(seen.water)
        rows.append((t, *navigation, *ground, *command, state.leg, *_in_space(seen.current)))
        if seen.water_lock and (not water or through != water[-1][1:]):
            water.append((t, *through))
        simulated.advance(command if vehicle.dives else Command(command.rudder, command.thrust), dt)
    return _columns(rows, water, 0.0 if sea is None else sea.sensors.water_track.latency)


def _start(vehicle: Vehicle, depth: float) -> PlantState | BodyState:
    if vehicle.dives:
        return body_at(0.0, 0.0, depth, 0.0, 0.0, 0.0, 0.0)
    return PlantState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def _in_space(vector: tuple[float, ...]) -> tuple[float, ...]:
    """Return a vector with three components; that of a vehicle in the plane has none down."""
    return (*vector, 0.0)[:3]


def _reported(navigation: Any) -> SpatialNavigation:
    """Return navigation as it arrives over the wire, with an attitude in [-pi, pi)."""
    x, y, z, phi, theta, psi, q, r = in_space(navigation)
    return SpatialNavigation(x, y, z, *attitude_over_the_wire(phi, theta, psi), q, r)


def _columns(rows: list[tuple[float, ...]], water: list[tuple[float, ...]], latency: float) -> Manoeuvred:
    table, log = np.array(rows, dtype=float), np.array(water, dtype=float).reshape(-1, 4)
    columns: list[Any] = [*table[:, :16].T, *log.T, latency, table[:, 16:]]
    return Manoeuvred(*columns)
