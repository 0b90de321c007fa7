"""What `closed_loop` wires, in the plane and in three dimensions: pilot, path, vehicle, one step's answer."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from auv_msgs_py.contract.frames import navigation_over_the_wire
from auv_msgs_py.values.attitude import attitude_over_the_wire
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SpatialCurrent, SpatialNavigation
from auv_path_following import pilots
from auv_path_following.comparators import peer_pilot
from auv_path_following.comparators.peer_pilot import PeerPilot, check_legs, peer_begun, peer_reply
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_rows import spatial_rows
from auv_path_following.guidance import guide
from auv_path_following.guidance.approach import agility_of, empty_approach
from auv_path_following.guidance.measured import Measured, SpatialMeasured
from auv_path_following.guidance.spatial.flown_path import flown_path
from auv_path_following.navigation import current_observer
from auv_path_following.pilot import Pilot, pilot
from auv_path_following.spatial_pilot import SpatialPilot, spatial_pilot
from auv_sim.flight.scenario import Scenario, spatial_start_of, start_of
from auv_sim.flight.signals import SPATIAL_TRUTH, TRUTH
from auv_sim.vehicle.diving.ideal_diver import SpatialSeen
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
from auv_sim.vehicle.hulls.rigid_body import angles_of
from auv_sim.vehicle.simulated import SimulatedVehicle


class Loop(NamedTuple):
    """One flight, wired.

    Attributes:
        pilot: configuration.
        state: first one of the pilot.
        path: as rows.
        vehicle: simulated.
        answer: (pilot, path, state, seen, at_sea, now, dt) -> (state, command, s, finished, row).
        columns: names of the row.
    """

    pilot: Any
    state: Any
    path: Any
    vehicle: Any
    answer: Callable[..., Any]
    columns: tuple[str, ...]


#: Columns of a step's row: navigation, water, command, guidance, estimated and true current, servo.
_COLUMNS = (
    "x", "y", "psi", "r", "ur", "vr", "rudder_cmd", "thrust_cmd", "psi_d", "r_d", "xe", "ye", "psi_e", "s",
    "Vx_est", "Vy_est", "Vx_true", "Vy_true", "rudder",
)  # fmt: skip
_SPATIAL_COLUMNS = (
    "x", "y", "z", "phi", "theta", "psi", "q", "r", "ur", "vr", "wr", "rudder_cmd", "sternplanes_cmd",
    "thrust_cmd", "psi_d", "r_d", "theta_d", "q_d", "xe", "ye", "ze", "psi_e", "theta_e", "s", "Vx_est",
    "Vy_est", "Vz_est", "Vx_true", "Vy_true", "Vz_true", "rudder", "sternplanes", "depth_d", "altitude",
)  # fmt: skip


def pilot_of(scenario: Scenario) -> Pilot | SpatialPilot | PeerPilot:
    """Return the pilot of a scenario: no limits, no holds, over the wire's last bits only at sea.

    Raises:
        ConfigurationError: a law or gain needs a key that the vehicle's file lacks, or the peer's law has
            other subpaths than straight legs.
    """
    c = scenario
    hull = c.controller_vehicle or c.vehicle
    if c.peer is not None:
        check_legs(c.path, c.vehicle.dives)
        return peer_pilot.prepare(c.peer, hull, c.thrust, c.sea is not None)
    if c.vehicle.dives:
        guiding = guide.prepare_spatial(c.guidance, hull, c.thrust, c.mode)
    else:
        guiding = guide.prepare(c.guidance, agility_of(hull, c.thrust), c.thrust)
    observer = current_observer.prepare(c.observer, c.dt)
    return pilots.prepare(observer, guiding, c.autopilot, c.pitch, hull, math.inf, c.sea is not None)


def followed_path(scenario: Scenario) -> CompositePath | SpatialPath:
    """Return the path that a scenario's vehicle follows, in its own kind of space.

    Raises:
        ConfigurationError: a vehicle in the plane and a path with depths; otherwise as
            `flown_path`.
    """
    check_kind(scenario)
    c = scenario
    return flown_path(c.path, c.spatial, c.vehicle, c.thrust) if c.vehicle.dives else c.path


def check_kind(scenario: Scenario) -> None:
    """Check that a vehicle has stern planes where its path has depths.

    Raises:
        ConfigurationError: it has none.
    """
    if scenario.spatial is not None and not scenario.vehicle.dives:
        expected = "stern planes, or a mission without depth"
        raise ConfigurationError(f"{scenario.vehicle.name}: sternplanes", "a path with depth", expected)


def loop_of(scenario: Scenario) -> Loop:
    """Return a flight, wired.

    Raises:
        ConfigurationError: what the path or the gains need is not in the vehicle's file.
    """
    c = scenario
    path = followed_path(c)
    if not isinstance(path, SpatialPath):
        start: Any = c.initial or start_of(c.path)
        vehicle: Any = SimulatedVehicle(c.plant_vehicle, start, c.sea, c.seed, c.current, c.dt)  # type: ignore[arg-type]
        names: tuple[str, ...] = (*_COLUMNS, *TRUTH) if c.sea else _COLUMNS
        pilot_config = pilot_of(c)
        if isinstance(pilot_config, PeerPilot):
            begun = peer_begun(pilot_config, None)
            return Loop(pilot_config, begun, path.rows, vehicle, peer_answer, names)
        begun = pilots.pilot_begins(pilot_config, empty_approach())
        return Loop(pilot_config, begun, path.rows, vehicle, answer, names)
    start = c.initial or spatial_start_of(path, c.vehicle)
    current = SpatialCurrent(*c.current, *(0.0,) * (3 - len(c.current)))
    vehicle = SimulatedDiver(c.plant_vehicle, start, c.sea, c.seed, current, c.dt)
    names = (*_SPATIAL_COLUMNS, *SPATIAL_TRUTH) if c.sea else _SPATIAL_COLUMNS
    diving = pilot_of(c)
    begun = pilots.pilot_begins(diving, empty_approach())
    return Loop(diving, begun, spatial_rows(path), vehicle, spatial_answer, names)


def answer(
    config: Pilot, path: Any, state: Any, seen: Any, at_sea: bool, now: float, dt: float
) -> tuple[Any, Any, float, bool, tuple[float, ...]]:
    """Answer one measurement of a planar vehicle; see `Loop`."""
    navigation, water, _, _, _, motion, rudder, current = seen
    if at_sea:
        navigation = navigation_over_the_wire(navigation)
    measured = Measured(navigation, water, True, False, 0.0, now)
    state, (estimate, g, _, command) = pilot(config, path, state, measured, dt)
    # g begins with psi_d, r_d, xe, ye, psi_e, s: see `GuidanceOutput`.
    row = (*navigation, *water, *command, *g[:6], *estimate, *current, rudder)
    return state, command, g.s, g.finished, (row + motion[:3] if at_sea else row)


def peer_answer(
    config: PeerPilot, path: Any, state: Any, seen: Any, at_sea: bool, now: float, dt: float
) -> tuple[Any, Any, float, bool, tuple[float, ...]]:
    """Answer one measurement by the law of MSS; see `Loop`."""
    state, navigation, estimate, g, command = peer_reply(config, path, state, seen, now, dt)
    row = (*navigation, *seen.water, *command, *g[:6], *estimate, *seen.current, seen.rudder)
    return state, command, g.s, g.finished, (row + seen.motion[:3] if at_sea else row)


def spatial_answer(
    config: SpatialPilot, path: Any, state: Any, seen: SpatialSeen, at_sea: bool, now: float, dt: float
) -> tuple[Any, Any, float, bool, tuple[float, ...]]:
    """Answer one measurement of a vehicle that dives; see `Loop`."""
    navigation, water, altitude = seen.navigation, seen.water, seen.altitude
    if at_sea:
        x, y, z, phi, theta, psi, q, r = navigation
        phi, theta, psi = attitude_over_the_wire(phi, theta, psi)
        navigation = SpatialNavigation(x, y, z, phi, theta, psi, q, r)
    measured = SpatialMeasured(navigation, water, True, False, 0.0, now, altitude)
    state, (estimate, g, _, command) = spatial_pilot(config, path, state, measured, dt)
    # g begins with psi_d, r_d, theta_d, q_d, xe, ye, ze, psi_e, theta_e, s: see `SpatialOutput`.
    row: tuple[float, ...] = (
        *navigation, *water, *command, *g[:10], *estimate, *seen.current, seen.rudder, seen.sternplanes,
        g.depth, altitude,
    )  # fmt: skip
    if at_sea:
        motion = seen.motion
        row += (motion.x, motion.y, motion.z, *angles_of(motion))
    return state, command, g.s, g.finished, row
