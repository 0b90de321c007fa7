"""Guidance and autopilots of the REMUS 100 demonstration of MSS, for straight legs between waypoints.

Adaptive line of sight in both planes learns the crab angles instead of estimating the current; an observer
smooths its references; a PID law moves the stern planes, an integral sliding mode law the rudder.
Elevation and pitch are positive up, z down. The signs of the fins are those of this suite.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import SpatialCommand, SpatialNavigation


class MssPilot(NamedTuple):
    """Configuration, with the published gains.

    Attributes:
        pitch_inertia: moment of inertia in pitch with added mass, kg m^2; scales the gains of the planes.
        lookahead: in both planes, m.
        adaptation: of the crab angles, rad/(m s).
        largest_crab: rad.
        switching: distance in three dimensions to a waypoint at which the next leg begins, m.
        observer: gain of the references' observer, 1/s.
        largest_rate: of the heading's reference, rad/s.
        pitch_frequency, pitch_damping: of the PID law (1/s).
        yaw_gain, yaw_time: of the Nomoto model of the hull (1/s, s).
        slope: of the sliding surface, 1/s.
        boundary: layer of the sliding surface, rad/s.
        switching_gain: of the sliding mode law, rad/s^2.
    """

    pitch_inertia: float
    lookahead: float = 20.0
    adaptation: float = 0.001
    largest_crab: float = math.radians(20.0)
    switching: float = 5.0
    observer: float = 0.5
    largest_rate: float = math.radians(5.0)
    pitch_frequency: float = 0.8
    pitch_damping: float = 0.8
    yaw_gain: float = 5.0 / 20.0
    yaw_time: float = 1.0
    slope: float = 1.0
    boundary: float = 0.1
    switching_gain: float = 0.05


class ObservedAngle(NamedTuple):
    """A smoothed reference (rad) and its rate (rad/s)."""

    angle: float = 0.0
    rate: float = 0.0


class MssPilotState(NamedTuple):
    """State.

    Attributes:
        leg: number of the leg, from 0.
        crab, attack: learnt crab angles of the two planes, rad.
        heading, pitch: the smoothed references.
        heading_integral, pitch_integral: of the errors, rad s.
    """

    leg: int = 0
    crab: float = 0.0
    attack: float = 0.0
    heading: ObservedAngle = ObservedAngle()
    pitch: ObservedAngle = ObservedAngle()
    heading_integral: float = 0.0
    pitch_integral: float = 0.0


class MssPilotOutput(NamedTuple):
    """The answer.

    Attributes:
        command: of both fins and the thruster.
        ye, ze: errors across the leg, m; ze positive below it.
        psi_ref, theta_ref: references, rad.
        finished: whether the course has ended.
        xe, share: distance along the leg, m, and over its length.
    """

    command: SpatialCommand
    ye: float
    ze: float
    psi_ref: float
    theta_ref: float
    finished: bool
    xe: float
    share: float


def mss_begun(navigation: SpatialNavigation) -> MssPilotState:
    """Return the first state of a vehicle with this attitude."""
    return MssPilotState(heading=ObservedAngle(navigation.psi), pitch=ObservedAngle(navigation.theta))


@pure
def mss_pilot(
    config: MssPilot,
    waypoints: Sequence[Any],
    state: MssPilotState,
    navigation: SpatialNavigation,
    thrust: float,
    dt: float,
) -> tuple[MssPilotState, MssPilotOutput]:
    """Answer one measurement with a command.

    Args:
        config: gains.
        waypoints: north, east, down, m.
        state: of the last step.
        navigation: measured pose, NED.
        thrust: N, passed on.
        dt: seconds since the last measurement (0 on the first one).
    """
    leg, last = state.leg, len(waypoints) - 2
    if leg < last and is_reached(config, waypoints[leg + 1], navigation):
        leg += 1
    return mss_leg(
        config, waypoints[leg], waypoints[leg + 1], leg, leg == last, state, navigation, thrust, dt
    )


@pure
def is_reached(config: MssPilot, waypoint: Any, navigation: SpatialNavigation) -> bool:
    """Return whether a waypoint (north, east, down, m) is so near that the next leg begins."""
    north, east = waypoint[0] - navigation.x, waypoint[1] - navigation.y
    return math.hypot(math.hypot(north, east), waypoint[2] - navigation.z) < config.switching


@pure
def mss_leg(
    config: MssPilot, a: Any, b: Any, leg: int, is_last: bool, state: MssPilotState,
    navigation: SpatialNavigation, thrust: float, dt: float,
) -> tuple[MssPilotState, MssPilotOutput]:  # fmt: skip
    """Answer one measurement on a leg.

    Args:
        a, b: its ends: north, east, down, m.
        leg: its number, from 0.
        is_last: whether the course ends with it.
        config, state, navigation, thrust, dt: as in `mss_pilot`.
    """
    _, crab, attack, heading, pitch, heading_integral, pitch_integral = state
    x, y, z = navigation.x, navigation.y, navigation.z
    xe, ye, ze, length, azimuth, elevation = leg_errors(a, b, x, y, z)
    psi_ref = azimuth - crab - math.atan(ye / config.lookahead)
    theta_ref = elevation + attack + math.atan(ze / config.lookahead)
    crab = bounded(crab + dt * learnt(config, ye), config.largest_crab)
    attack = bounded(attack + dt * learnt(config, ze), config.largest_crab)
    heading = observed(config.observer, heading, psi_ref, dt)
    pitch = observed(config.observer, pitch, theta_ref, dt)
    r_d = bounded(heading.rate, config.largest_rate)
    psi_e, theta_e = wrap(navigation.psi - heading.angle), navigation.theta - pitch.angle
    rudder = sliding_rudder(config, psi_e, navigation.r, r_d, heading_integral)
    planes = pid_planes(config, theta_e, navigation.q, pitch_integral)
    state = MssPilotState(
        leg, crab, attack, heading, pitch, heading_integral + dt * psi_e, pitch_integral + dt * theta_e
    )
    command = SpatialCommand(rudder, planes, thrust)
    finished = is_last and xe >= length
    return state, MssPilotOutput(command, ye, ze, psi_ref, theta_ref, finished, xe, xe / length)


@pure
def leg_errors(
    a: Any, b: Any, x: float, y: float, z: float
) -> tuple[float, float, float, float, float, float]:
    """Return xe, ye, ze and the leg's length (m), its azimuth and elevation (rad)."""
    north, east, down = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    flat = math.hypot(north, east)
    azimuth, elevation = math.atan2(east, north), math.atan2(-down, flat)
    along = (x - a[0]) * math.cos(azimuth) + (y - a[1]) * math.sin(azimuth)
    ye = -(x - a[0]) * math.sin(azimuth) + (y - a[1]) * math.cos(azimuth)
    xe = math.cos(elevation) * along - math.sin(elevation) * (z - a[2])
    ze = math.sin(elevation) * along + math.cos(elevation) * (z - a[2])
    return xe, ye, ze, math.hypot(flat, down), azimuth, elevation


@pure
def learnt(config: MssPilot, error: float) -> float:
    """Return the rate of a learnt crab angle, rad/s."""
    return config.adaptation * config.lookahead * error / math.hypot(config.lookahead, error)


@pure
def observed(gain: float, state: ObservedAngle, reference: float, dt: float) -> ObservedAngle:
    """Follow a reference (rad): x' = rate + gain (reference - x), with the rate from a high-pass of x."""
    time = 1.0 / (gain + 2.0 * math.sqrt(gain) + 1.0)
    low = state.angle - time * state.rate
    angle = state.angle + dt * (state.rate + gain * wrap(reference - state.angle))
    share = math.exp(-dt / time)
    low = share * low + (1.0 - share) * angle
    return ObservedAngle(angle, (angle - low) / time)


@pure
def sliding_rudder(config: MssPilot, psi_e: float, r: float, r_d: float, integral: float) -> float:
    """Return the rudder of the integral sliding mode law of a Nomoto model, rad, positive to port."""
    slope = config.slope
    reference = r_d - 2.0 * slope * psi_e - slope * slope * integral
    reference_rate = -2.0 * slope * (r - r_d) - slope * slope * psi_e
    sigma = r - reference
    switch = bounded(sigma / config.boundary, 1.0)
    drive = config.yaw_time * reference_rate + reference - config.switching_gain * switch
    return -drive / config.yaw_gain


@pure
def pid_planes(config: MssPilot, theta_e: float, q: float, integral: float) -> float:
    """Return the stern planes of the PID law, rad, positive bow down."""
    w = config.pitch_frequency
    kp = config.pitch_inertia * w * w
    kd = 2.0 * config.pitch_inertia * config.pitch_damping * w
    return kp * theta_e + kd * q + 0.1 * w * kp * integral
