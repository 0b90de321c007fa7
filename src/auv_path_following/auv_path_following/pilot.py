"""The pilot: observer, guidance and autopilot in their order. The three nodes each run their part of it."""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_msgs_py.frames import flip_yaw
from auv_msgs_py.pure import pure
from auv_msgs_py.types import NO_CURRENT, Command, Current, Navigation, Reference, WaterVelocity
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import Autopilot, AutopilotInputs, AutopilotState, steer
from auv_path_following.guidance import guide as guidance
from auv_path_following.guidance.current_observer import (
    ObserverInputs,
    ObserverState,
    observe,
    relocated,
)
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.guidance.guide import Guide, GuideInputs, GuideState, guide
from auv_path_following.paths.rows import PathRows


class Pilot(NamedTuple):
    """Configuration.

    Attributes:
        observer, guide, autopilot: of the three parts.
        longest_gap: after a longer gap between measurements the autopilot starts anew, s.
        by_wire: whether headings have the last bits that they have after their way over the wire.
    """

    observer: Any
    guide: Guide
    autopilot: Autopilot
    longest_gap: float
    by_wire: bool


class PilotInputs(NamedTuple):
    """One measurement, as in `GuideInputs`."""

    navigation: Navigation
    water: WaterVelocity
    has_water: bool
    moved: bool
    to_go: float
    now: float


class PilotState(NamedTuple):
    """States of the three parts."""

    observer: ObserverState
    guide: GuideState
    autopilot: AutopilotState


class PilotOutput(NamedTuple):
    """The estimated current (NED, m/s), the result of guidance, its request to the autopilot, the command."""

    current: Current
    guidance: GuidanceOutput
    reference: Reference
    command: Command


@pure
def first_state(config: Pilot, approach: Any) -> PilotState:
    """Return the state of a pilot before its mission; `approach` as of `approach.empty_approach`."""
    observer = ObserverState(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, NO_CURRENT)
    return PilotState(
        observer, guidance.first_state(config.guide, approach), autopilot.first_state(config.autopilot)
    )


@pure
def pilot(
    config: Pilot, path: PathRows, state: PilotState, inputs: PilotInputs, dt: float
) -> tuple[PilotState, PilotOutput]:
    """Answer one measurement with a command.

    Args:
        config: of the three parts.
        path: as rows.
        state: of the three parts.
        inputs: the measurement.
        dt: seconds since the last one (0 on the first one).
    """
    navigation, water, has_water, moved, to_go, now = inputs
    observer, guide_state, steering = state
    if moved:
        observer = relocated(observer)
    observer, seen = observe(config.observer, observer, ObserverInputs(navigation, water, has_water), dt)
    measured = GuideInputs(navigation, water, has_water, moved, seen.current, to_go, now)
    guide_state, (output, thrust, _) = guide(config.guide, path, guide_state, measured, dt)
    psi_d = flip_yaw(flip_yaw(output.psi_d)) if config.by_wire else output.psi_d
    reference = Reference(psi_d, output.r_d, thrust)
    if moved or dt > config.longest_gap:
        steering = autopilot.first_state(config.autopilot)
    steering, steered = steer(config.autopilot, steering, AutopilotInputs(navigation, reference), dt)
    return (
        PilotState(observer, guide_state, steering),
        PilotOutput(seen.current, output, reference, steered.command),
    )
