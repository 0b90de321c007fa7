"""The pilot of a vehicle that dives: observer, guidance, and an autopilot for each plane, in their order."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import (
    Navigation,
    Reference,
    SpatialCommand,
    SpatialCurrent,
    SpatialNavigation,
    SpatialWater,
    WaterVelocity,
)
from auv_path_following.control.autopilot import Autopilot, AutopilotState, steer
from auv_path_following.curves.spatial.spatial_rows import SpatialRows
from auv_path_following.guidance.follow import FollowerState
from auv_path_following.guidance.spatial_follow import (
    SpatialFollower,
    SpatialOutput,
    follow_spatial,
    level_of,
)
from auv_path_following.guidance.spatial_laws import euler_rates, levelled
from auv_path_following.navigation.current_observer import Observer
from auv_path_following.navigation.spatial_observer import (
    SpatialObserverState,
    observe_spatial,
    spatial_estimate,
)


class SpatialPilot(NamedTuple):
    """Configuration.

    Attributes:
        observer, follower: of the parts.
        heading, pitch: the autopilots of the two planes; they are of one kind.
        thrust: while the mission runs, N.
    """

    observer: Observer
    follower: SpatialFollower
    heading: Autopilot
    pitch: Autopilot
    thrust: float


class SpatialPilotState(NamedTuple):
    """States of the parts."""

    observer: SpatialObserverState
    follower: FollowerState
    heading: AutopilotState
    pitch: AutopilotState


#: The estimated current (NED, m/s), the result of guidance, the command.
SpatialPilotOutput = tuple[SpatialCurrent, SpatialOutput, SpatialCommand]


@pure
def spatial_pilot(
    config: SpatialPilot,
    path: SpatialRows,
    state: SpatialPilotState,
    navigation: SpatialNavigation,
    water: SpatialWater,
    dt: float,
) -> tuple[SpatialPilotState, SpatialPilotOutput]:
    """Answer one measurement with a command.

    Args:
        config: of the parts.
        path: as rows.
        state: of the parts.
        navigation: measured pose, NED.
        water: measured velocity through the water, FRD.
        dt: seconds since the last measurement (0 on the first one).
    """
    level, flow = level_of(navigation), levelled(water, navigation.phi, navigation.theta)
    across = WaterVelocity(flow.ahead, flow.starboard)
    observer = observe_spatial(
        config.observer, state.observer, level, navigation.z, across, flow.down, True, dt
    )
    current = spatial_estimate(observer)
    follower, output = follow_spatial(config.follower, path, state.follower, navigation, water, current, dt)
    thrust = 0.0 if output.finished else config.thrust
    turning = Reference(output.psi_d, output.r_d, thrust)
    heading, turned, _ = steer(config.heading, state.heading, level, turning, dt)
    _, theta_rate = euler_rates(navigation.phi, navigation.theta, navigation.q, navigation.r)
    pitched, pitching = (
        Navigation(0.0, 0.0, navigation.theta, theta_rate),
        Reference(output.theta_d, output.q_d, thrust),
    )
    pitch, tilted, _ = steer(config.pitch, state.pitch, pitched, pitching, dt)
    command = SpatialCommand(turned.rudder, tilted.rudder, turned.thrust)
    return SpatialPilotState(observer, follower, heading, pitch), (current, output, command)
