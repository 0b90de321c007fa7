"""The suite in three dimensions wired without ROS: pilot and plant of a vehicle that dives, without a sea."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import NO_SPATIAL_CURRENT, SpatialCurrent
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.nism import NismConfig
from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_path_following.control.reference_model import ReferenceConfig
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_point import tangent_of
from auv_path_following.curves.spatial.spatial_rows import spatial_rows
from auv_path_following.guidance import follow, path_follower
from auv_path_following.guidance.approach import agility_of, empty_approach
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.spatial_follow import SpatialFollower
from auv_path_following.guidance.spatial_laws import VerticalLaw
from auv_path_following.navigation import current_observer
from auv_path_following.navigation.current_observer import CurrentObserverConfig, ObserverState
from auv_path_following.navigation.spatial_observer import SpatialObserverState
from auv_path_following.spatial_pilot import SpatialPilot, SpatialPilotState, spatial_pilot
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.actuator import ServoState
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.hulls.spatial_plant import (
    SpatialAfloat,
    SpatialPlant,
    spatial_navigation_of,
    spatial_plant_of,
    spatial_plant_step,
    spatial_water_of,
)


def pitch_gains() -> AutopilotConfig:
    """Return the gains of the pitch autopilot that suit the REMUS 100."""
    gains = NismConfig(k1=0.4, k3=0.4, kp_from_rudder=True)
    return AutopilotConfig(nism=gains, reference=ReferenceConfig(enabled=True, bandwidth=1.0))


@dataclass(frozen=True, kw_only=True)
class SpatialScenario:
    """One flight in three dimensions.

    Attributes:
        path: what to follow.
        vehicle: hull and fins, of plant and autopilots alike.
        thrust: N, while the mission runs.
        initial: the plant's first state; on the path's start, along it, at `speed` if None.
        speed: through the water at the start, m/s.
        current: constant, m/s, NED, or a function of time in s.
        step: time between odometries, s.
        guidance, observer, heading, pitch: laws and gains.
        lookahead: Delta_v in the vertical plane, m.
        plant: another plant than the vehicle's.
        time_limit: the flight ends here at the latest, s.
    """

    path: SpatialPath
    vehicle: Vehicle
    thrust: float
    initial: BodyState | None = None
    speed: float = 1.9
    current: SpatialCurrent | Callable[[float], SpatialCurrent] = NO_SPATIAL_CURRENT
    step: float = 0.05
    guidance: PathFollowerConfig = field(default_factory=PathFollowerConfig)
    observer: CurrentObserverConfig = field(default_factory=CurrentObserverConfig)
    heading: AutopilotConfig = field(default_factory=AutopilotConfig)
    pitch: AutopilotConfig = field(default_factory=pitch_gains)
    lookahead: float = 5.2
    plant: SpatialPlant | None = None
    time_limit: float = 3600.0


#: Signals of a flight, by name: time and pose, errors, fins and estimate (s, m, rad, m/s; NED).
COLUMNS = (
    "t", "x", "y", "z", "phi", "theta", "psi", "s", "xe", "ye", "ze", "psi_d", "theta_d", "rudder",
    "sternplanes", "Vx_est", "Vy_est", "Vz_est",
)  # fmt: skip


def spatial_pilot_of(scenario: SpatialScenario) -> SpatialPilot:
    """Return the pilot of a scenario.

    Raises:
        ConfigurationError: the vehicle file lacks what a vehicle that dives needs, or it cannot go so deep or
            so slowly.
    """
    c = scenario
    _check(c)
    agility = agility_of(c.vehicle, c.thrust)
    plane = path_follower.prepare(c.guidance, agility)
    side = pitch_plane_of(c.vehicle)
    pitch = autopilot.prepare(c.pitch, side)
    vertical = VerticalLaw(c.lookahead, 0.95, plane.minimum_speed)
    follower = SpatialFollower(
        plane, vertical, c.vehicle.depth.max_pitch, agility_of(side, c.thrust).turn_rate
    )
    observer = current_observer.prepare(c.observer, c.step)
    return SpatialPilot(observer, follower, autopilot.prepare(c.heading, c.vehicle), pitch, float(c.thrust))


def _check(scenario: SpatialScenario) -> None:
    """Hold depths and speed of a flight against the vehicle's range."""
    vehicle, knots = scenario.vehicle, scenario.path.knots
    allowed = vehicle.depth
    for number, (way, depth) in enumerate(knots):
        least = 0.0 if number in (0, len(knots) - 1) else allowed.surface
        if not least <= depth <= allowed.max:
            found, expected = f"{depth:g} m at {way:g} m of path", f"{least:g} to {allowed.max:g} m"
            raise ConfigurationError(f"{vehicle.name}: depth_profile.knots[{number}]", found, expected)
    speed = vehicle.speed_at(scenario.thrust)
    if speed < allowed.minimum_speed:
        expected = f"at least {allowed.minimum_speed:g} m/s, below which the planes hold no depth"
        raise ConfigurationError(
            f"{vehicle.name}: thrust", f"{scenario.thrust:g} N, {speed:.2f} m/s", expected
        )


def fly(scenario: SpatialScenario) -> dict[str, NDArray[np.float64]]:
    """Fly until the end of the path or the time limit.

    Returns:
        A row per step: name of `COLUMNS` -> array of shape (n,).
    """
    c, dt = scenario, scenario.step
    config, path, plant = spatial_pilot_of(c), spatial_rows(c.path), c.plant or spatial_plant_of(c.vehicle)
    start, along = c.path.evaluate(0, 0.0), tangent_of(c.path.evaluate(0, 0.0))
    initial = c.initial or body_at(start.x, start.y, start.z, 0.0, along.gamma, along.chi, c.speed)
    afloat = SpatialAfloat(initial, ServoState(), ServoState())
    state = SpatialPilotState(
        SpatialObserverState(ObserverState(), ObserverState()),
        follow.first_state(config.follower.plane, empty_approach()),
        autopilot.first_state(config.heading),
        autopilot.first_state(config.pitch),
    )
    rows: list[tuple[float, ...]] = []
    for k in range(int(c.time_limit / dt) + 1):
        navigation = spatial_navigation_of(afloat.hull)
        water = spatial_water_of(afloat.hull)
        state, (estimate, g, command) = spatial_pilot(
            config, path, state, navigation, water, dt if k else 0.0
        )
        errors = (g.s, g.xe, g.ye, g.ze, g.psi_d, g.theta_d)
        rows.append((k * dt, *navigation[:6], *errors, command.rudder, command.sternplanes, *estimate))
        if g.finished:
            break
        drift = c.current(k * dt) if callable(c.current) else c.current
        afloat, _ = spatial_plant_step(plant, afloat, (command, drift, 1.0), dt)
    return dict(zip(COLUMNS, np.array(rows).T, strict=True))
