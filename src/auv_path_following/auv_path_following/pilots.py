"""The pilot of a planar vehicle or of one that dives, chosen by its configuration."""

from __future__ import annotations

from auv_msgs_py.values.pure import dispatched
from auv_path_following.control import autopilot, diving_autopilot
from auv_path_following.control.autopilot import Autopilot, AutopilotConfig
from auv_path_following.control.diving_autopilot import DivingAutopilot
from auv_path_following.guidance.guide import Guide
from auv_path_following.guidance.spatial.spatial_follower import SpatialFollower
from auv_path_following.navigation.current_observer import Observer
from auv_path_following.pilot import Pilot, begun, first_state, pilot
from auv_path_following.spatial_pilot import SpatialPilot, spatial_begun, spatial_first_state, spatial_pilot
from auv_path_following.vehicle import Vehicle

#: (configuration, path as rows, state, measured, dt) -> (state, output).
pilot_step = dispatched({Pilot: pilot, SpatialPilot: spatial_pilot})
#: State before a mission, and of a mission that has just been started: (configuration, approach) -> state.
pilot_waits = dispatched({Pilot: first_state, SpatialPilot: spatial_first_state})
pilot_begins = dispatched({Pilot: begun, SpatialPilot: spatial_begun})

#: (configuration of the autopilot, its state) -> its state for the configuration.
autopilot_kept = dispatched({Autopilot: autopilot.kept, DivingAutopilot: diving_autopilot.both_kept})


def prepare(
    observer: Observer, guiding: Guide, heading: AutopilotConfig, pitch: AutopilotConfig, vehicle: Vehicle,
    longest_gap: float, by_wire: bool,
) -> Pilot | SpatialPilot:  # fmt: skip
    """Return the configuration of a pilot, of the kind of its guidance.

    Args:
        observer, guiding: configurations.
        heading, pitch: controllers and gains; `pitch` for a vehicle that dives.
        vehicle: the hull that the autopilots assume.
        longest_gap, by_wire: as in `Pilot`.

    Raises:
        ConfigurationError: the gains need values that the vehicle's file does not have.
    """
    if isinstance(guiding.follower, SpatialFollower):
        both = diving_autopilot.prepare(heading, pitch, vehicle)
        return SpatialPilot(observer, guiding, both, longest_gap, by_wire)
    return Pilot(observer, guiding, autopilot.prepare(heading, vehicle), longest_gap, by_wire)
