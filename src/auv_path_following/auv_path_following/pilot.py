"""The pilot: observer, guidance and autopilot in their order. Each of the three nodes runs one part."""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import NO_CURRENT, Command, Current, Reference
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import Autopilot, AutopilotState, steer
from auv_path_following.curves.rows import PathRows
from auv_path_following.guidance import guide as guidance
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.guidance.guide import Guide, GuideState, guide
from auv_path_following.guidance.measured import Measured
from auv_path_following.navigation.current_observer import (
    ObserverState,
    observe,
    relocated,
)


class Pilot(NamedTuple):
    """Configuration.

    Attributes:
        observer, guide, autopilot: of the three parts.
        longest_gap: a longer gap between measurements resets the autopilot, s.
        by_wire: whether psi_d is rounded as on the wire.
    """

    observer: Any
    guide: Guide
    autopilot: Autopilot
    longest_gap: float
    by_wire: bool


class PilotState(NamedTuple):
    """States of the three parts."""

    observer: ObserverState
    guide: GuideState
    autopilot: AutopilotState


#: The estimated current (NED, m/s), the result of guidance, the reference for the autopilot, the command.
PilotOutput = tuple[Current, GuidanceOutput, Reference, Command]


@pure
def first_state(config: Pilot, approach: Any) -> PilotState:
    """Return the state of a pilot before its mission; `approach` as of `approach.empty_approach`."""
    observer = ObserverState(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, NO_CURRENT)
    return PilotState(
        observer, guidance.first_state(config.guide, approach), autopilot.first_state(config.autopilot)
    )


@pure
def begun(config: Pilot, approach: Any) -> PilotState:
    """Return the state of a pilot whose mission has just been started; `approach` as in `first_state`."""
    observer, guiding, steering = first_state(config, approach)
    return PilotState(observer, guidance.start(config.guide, guiding), steering)


@pure
def pilot(
    config: Pilot, path: PathRows, state: PilotState, measured: Measured, dt: float
) -> tuple[PilotState, PilotOutput]:
    """Answer one measurement with a command.

    Args:
        config: of the three parts.
        path: as rows.
        state: of the three parts.
        measured: the measurement.
        dt: seconds since the last one (0 on the first one).
    """
    navigation, water, has_water, moved, _, _ = measured
    observer, guiding, steering = state
    if moved:
        observer = relocated(observer)
    observer = observe(config.observer, observer, navigation, water, has_water, dt)
    current = observer.current
    guiding, output, thrust, _ = guide(config.guide, path, guiding, measured, current, dt)
    psi_d = flip_yaw(flip_yaw(output.psi_d)) if config.by_wire else output.psi_d
    reference = Reference(psi_d, output.r_d, thrust)
    if moved or dt > config.longest_gap:
        steering = autopilot.first_state(config.autopilot)
    steering, command, _ = steer(config.autopilot, steering, navigation, reference, dt)
    return PilotState(observer, guiding, steering), (current, output, reference, command)
