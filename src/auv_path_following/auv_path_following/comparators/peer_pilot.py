"""The law of MSS as the pilot of a planar flight along straight legs, in place of the suite's."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.contract.frames import navigation_over_the_wire
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import NO_CURRENT, Command, Current, Navigation, SpatialNavigation
from auv_path_following.comparators.mss_pilot import (
    MssPilot,
    MssPilotState,
    ObservedAngle,
    is_reached,
    mss_leg,
)
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.rows import PathRows, evaluate
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.vehicle import Vehicle


class PeerPilot(NamedTuple):
    """Configuration.

    Attributes:
        law: gains.
        thrust: of the mission, N.
        max_angle: of the rudder, rad.
        by_wire: whether the heading is rounded as on the wire.
    """

    law: MssPilot
    thrust: float
    max_angle: float
    by_wire: bool


class PeerPilotState(NamedTuple):
    """Whether the law has begun, and its state."""

    has_begun: bool
    law: MssPilotState


def prepare(law: MssPilot, vehicle: Vehicle, thrust: float, by_wire: bool) -> PeerPilot:
    """Return the configuration.

    Args:
        law: gains.
        vehicle: whose rudder and thruster limit the command.
        thrust: N.
        by_wire: whether the heading is rounded as on the wire.
    """
    most = float(min(thrust, vehicle.thrust_max))
    return PeerPilot(law, most, float(vehicle.rudder.max_angle), by_wire)


def check_legs(path: CompositePath, dives: bool) -> None:
    """Check that a path has straight legs only, and is flown in the plane.

    Raises:
        ConfigurationError: it has other subpaths, or its vehicle dives.
    """
    if dives:
        raise ConfigurationError("the law of MSS", "a vehicle that dives", "its planar part")
    for number, segment in enumerate(path.segments, start=1):
        if not isinstance(segment, Line):
            kind = type(segment).__name__
            raise ConfigurationError(f"the law of MSS: subpath {number}", kind, "straight legs alone")


@pure
def peer_begun(config: PeerPilot, approach: Any) -> PeerPilotState:
    """Return the state before the first measurement; `approach` is not used."""
    rest = ObservedAngle(0.0, 0.0)
    return PeerPilotState(False, MssPilotState(0, 0.0, 0.0, rest, rest, 0.0, 0.0))


@pure
def peer_step(
    config: PeerPilot, path: PathRows, state: PeerPilotState, navigation: Navigation, dt: float
) -> tuple[PeerPilotState, GuidanceOutput, Command]:
    """Answer one measurement on the legs of a path.

    Args:
        config: gains and limits.
        path: as rows, all of them straight.
        state: of the last step.
        navigation: measured pose, NED.
        dt: seconds since the last measurement (0 on the first one).

    Returns:
        The state; the result as the suite's guidance has it, with the smoothed heading as psi_d; the command.
    """
    has_begun, law = state
    x, y, psi, r = navigation
    if not has_begun:
        law = MssPilotState(0, 0.0, 0.0, ObservedAngle(psi, 0.0), ObservedAngle(0.0, 0.0), 0.0, 0.0)
    level = SpatialNavigation(x, y, 0.0, 0.0, 0.0, psi, 0.0, r)
    leg, last = law.leg, path.n - 1
    if leg < last and is_reached(config.law, _end(path, leg, 1.0), level):
        leg += 1
    a, b = _end(path, leg, 0.0), _end(path, leg, 1.0)
    law, out = mss_leg(config.law, a, b, leg, leg == last, law, level, config.thrust, dt)
    share = min(max(out.share, 0.0), 1.0 if out.finished else 1.0 - 1e-9)
    heading, chi_p = law.heading, math.atan2(b[1] - a[1], b[0] - a[0])
    x_p, y_p = a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
    guided = GuidanceOutput(
        wrap(heading.angle), heading.rate, 0.0, out.ye, wrap(psi - heading.angle), leg + share, leg, x_p, y_p,
        chi_p, 0.0, 0.0, 0.0, -math.atan(out.ye / config.law.lookahead), -law.crab, 0.0, 0.0, False,
        out.finished,
    )  # fmt: skip
    return (
        PeerPilotState(True, law),
        guided,
        Command(bounded(out.command.rudder, config.max_angle), config.thrust),
    )


@pure
def _end(path: PathRows, leg: int, t: float) -> tuple[float, float, float]:
    """Return the start (t = 0) or the end (t = 1) of a leg: north, east, down, m."""
    x, y, _, _, _, _ = evaluate(path, path.subpath[leg], t)
    return x, y, 0.0


@pure
def peer_reply(
    config: PeerPilot, path: PathRows, state: PeerPilotState, seen: Any, now: float, dt: float
) -> tuple[PeerPilotState, Navigation, Current, GuidanceOutput, Command]:
    """Answer what the simulated vehicle measured, as `planar_answer`; the law estimates no current."""
    navigation = seen.navigation
    if config.by_wire:
        navigation = navigation_over_the_wire(navigation)
    state, guided, command = peer_step(config, path, state, navigation, dt)
    return state, navigation, NO_CURRENT, guided, command


@pure
def peer_stop(config: PeerPilot) -> Command:
    """Return the command that stops."""
    return Command(0.0, 0.0)


@pure
def peer_largest_angle(config: PeerPilot) -> float:
    """Return the largest rudder angle, rad."""
    return config.max_angle
