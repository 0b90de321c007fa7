"""What a mission's plan is checked for: what the simulator cannot do, and what the vehicle cannot fly."""

from __future__ import annotations

from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.settings.schema import Pair
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import NO_SPATIAL_CURRENT, SpatialCurrent
from auv_path_following.mission_check.flyable import Findings, check, require_planes
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.launch.node_settings import NodeSettings
from auv_sim.launch.options import Options
from auv_sim.vehicle import sea


def check_simulated(options: Options, hull: Vehicle, file: Path) -> None:
    """Refuse what the simulator cannot do with a vehicle: no hull, a depth or an upwelling in the plane."""
    if (options.simulator or options.emulator) and hull.hull is None and hull.simulated_as is None:
        expected = "the hull's coefficients, or --no-sim: the simulator needs them"
        raise ConfigurationError(f"{file}: hull", "nothing", expected)
    require_planes(hull, {"--depth": options.depth, "--upwelling": options.upwelling})
    if options.depth is not None and options.depth > hull.depth.max:
        expected = f"at most {hull.depth.max:g} m, depth.max of {hull.name}"
        raise ConfigurationError("--depth", f"{options.depth:g} m", expected)


def check_altimeter(options: Options, mission: Mission, settings: NodeSettings) -> None:
    """Refuse an altitude that the simulated vehicle cannot measure."""
    if mission.altitude is None or not options.simulator:
        return
    plant = settings[topics.PLANT]
    if not plant.sea or not sea.load(plant.sea).sensors.altimeter.fitted:
        found = f"{plant.sea or 'no sea'}, without an altimeter"
        expected = "--sea with a sea whose sensors.altimeter is fitted"
        raise ConfigurationError(f"{mission.source}: altitude", found, expected)


def check_flight(
    options: Options, mission: Mission, hull: Vehicle, settings: NodeSettings, mean: Pair
) -> Findings:
    """Check whether the mission can be flown in the current that is configured (m/s, NED)."""
    current = NO_SPATIAL_CURRENT
    if options.simulator or options.emulator:
        constant = settings[topics.PLANT].current.spatial_value
        current = SpatialCurrent(constant.Vx + mean[0], constant.Vy + mean[1], constant.Vz)
    guidance = settings[topics.GUIDANCE].guidance
    return check(mission, hull, current, guidance.switching, guidance.lookahead)
