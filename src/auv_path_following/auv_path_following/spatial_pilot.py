"""The pilot of a vehicle that dives: observer, guidance, and an autopilot for each plane, in their order."""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.values.attitude import level_of
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import SpatialCommand, SpatialCurrent, SpatialReference, WaterVelocity
from auv_path_following.control import diving_autopilot
from auv_path_following.control.diving_autopilot import DivingAutopilot, DivingAutopilotState, steer_both
from auv_path_following.curves.spatial.spatial_rows import SpatialRows
from auv_path_following.guidance import guide as guidance
from auv_path_following.guidance.guide import Guide, GuideState, guide
from auv_path_following.guidance.measured import SpatialMeasured
from auv_path_following.guidance.spatial.spatial_follow import SpatialOutput
from auv_path_following.navigation.current_observer import Observer
from auv_path_following.navigation.levelled import levelled
from auv_path_following.navigation.spatial_observer import (
    UNOBSERVED,
    SpatialObserverState,
    observe_spatial,
    spatial_estimate,
    spatially_relocated,
)


class SpatialPilot(NamedTuple):
    """Configuration.

    Attributes:
        observer, guide: of the parts.
        autopilot: of both planes.
        longest_gap: a longer gap between measurements resets the autopilots, s.
        by_wire: whether psi_d is rounded as on the wire.
    """

    observer: Observer
    guide: Guide
    autopilot: DivingAutopilot
    longest_gap: float
    by_wire: bool


class SpatialPilotState(NamedTuple):
    """States of the parts."""

    observer: SpatialObserverState
    guide: GuideState
    autopilot: DivingAutopilotState


#: The estimated current (NED, m/s), the result of guidance, the reference for the autopilots, the command.
SpatialPilotOutput = tuple[SpatialCurrent, SpatialOutput, SpatialReference, SpatialCommand]


@pure
def spatial_first_state(config: SpatialPilot, approach: Any) -> SpatialPilotState:
    """Return the state of a pilot before its mission; `approach` as of `approach.empty_approach`."""
    return SpatialPilotState(
        UNOBSERVED,
        guidance.first_state(config.guide, approach),
        diving_autopilot.first_state(config.autopilot),
    )


@pure
def spatial_begun(config: SpatialPilot, approach: Any) -> SpatialPilotState:
    """Return the state of a pilot whose mission has just been started; `approach` as above."""
    observer, guiding, steering = spatial_first_state(config, approach)
    return SpatialPilotState(observer, guidance.start(config.guide, guiding), steering)


@pure
def spatial_pilot(
    config: SpatialPilot, path: SpatialRows, state: SpatialPilotState, measured: SpatialMeasured, dt: float
) -> tuple[SpatialPilotState, SpatialPilotOutput]:
    """Answer one measurement with a command.

    Args:
        config: of the parts.
        path: as rows.
        state: of the parts.
        measured: the measurement.
        dt: seconds since the last one (0 on the first one).
    """
    navigation, water, has_water, moved, _, _, _ = measured
    observer, guiding, steering = state
    level, flow = level_of(navigation), levelled(water, navigation.phi, navigation.theta)
    if moved:
        observer = spatially_relocated(observer)
    across = WaterVelocity(flow.ahead, flow.starboard)
    observer = observe_spatial(
        config.observer, observer, level, navigation.z, across, flow.down, has_water, dt
    )
    current = spatial_estimate(observer)
    guiding, output, thrust, _ = guide(config.guide, path, guiding, measured, current, dt)
    psi_d = flip_yaw(flip_yaw(output.psi_d)) if config.by_wire else output.psi_d
    reference = SpatialReference(psi_d, output.r_d, output.theta_d, output.q_d, thrust)
    if moved or dt > config.longest_gap:
        steering = diving_autopilot.first_state(config.autopilot)
    steering, command = steer_both(config.autopilot, steering, navigation, reference, dt)
    return SpatialPilotState(observer, guiding, steering), (current, output, reference, command)
