"""The law of the manoeuvres: one step from navigation to commands.

Every leg is fed back. Most torpedoes are unstable in yaw and hold neither a course nor a pitch with neutral
fins. Heading and pitch are therefore held by proportional loops wherever a leg does not deflect that fin, and
zig-zags are reversed by the measured angle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import SPATIAL_STOP, SpatialCommand, SpatialNavigation
from auv_sim.own_vehicle.manoeuvres.legs import (
    CIRCLE,
    DEPTH_ZIGZAG,
    PITCH_ZIGZAG,
    PLANE_STEP,
    SUBMERGE,
    ZIGZAG,
    Leg,
    Manoeuvres,
)

#: Desired pitch for each m of depth error (rad/m), and its largest (rad); the trim's rate (rad/(m s)), and
#: its largest (rad).
PER_DEPTH, STEEPEST, TRIM_RATE, LARGEST_TRIM = 0.06, math.radians(20.0), 0.004, math.radians(10.0)
#: The way to the depth is over within this distance (m) and pitch (rad).
_AT_DEPTH, _LEVEL = 0.5, math.radians(5.0)
#: Deviation beyond a zig-zag's limit from which its rudder or planes go to their stop, rad.
_ASTRAY, _STEEP = math.radians(60.0), math.radians(10.0)


class Flown(NamedTuple):
    """State of a program.

    Attributes:
        leg: number of the present leg; the number of legs when all are over.
        time: since the leg began, s.
        side: 1, or -1 while the fin is at the opposite of its first angle.
        reversals: of this leg.
        course: held heading, rad.
        turned: change of the heading in this leg, rad.
        psi: last heading, rad.
        pitch: where a plane step began, rad.
        home_x, home_y, home_psi: where the program began, m and rad.
        depth: held, m.
        trim: pitch that holds the depth, rad.
    """

    leg: int
    time: float
    side: float
    reversals: int
    course: float
    turned: float
    psi: float
    pitch: float
    home_x: float
    home_y: float
    home_psi: float
    depth: float
    trim: float


@pure
def manoeuvring_begins(navigation: SpatialNavigation, depth: float) -> Flown:
    """Return the state before the first step.

    Args:
        navigation: where the program begins; its heading is the course 0.
        depth: to be held, m.
    """
    n = navigation
    return Flown(0, 0.0, 1.0, 0, n.psi, 0.0, n.psi, n.theta, n.x, n.y, n.psi, depth, 0.0)


@pure
def manoeuvre(
    config: Manoeuvres, state: Flown, navigation: SpatialNavigation, dt: float
) -> tuple[Flown, SpatialCommand]:
    """Return the next state and the commands; all zero when every leg is over.

    Args:
        config: of the vehicle.
        state: of the program.
        navigation: reported by the vehicle, NED; in the plane with z, theta and q 0.
        dt: since the last step, s; 0 for the first.
    """
    n = navigation
    state = state._replace(time=state.time + dt, turned=state.turned + wrap(n.psi - state.psi), psi=n.psi)
    if state.leg < len(config.legs) and _is_over(config.legs[state.leg], state, n):
        state = _next(state, n)
    if state.leg >= len(config.legs):
        return state, SPATIAL_STOP
    leg = config.legs[state.leg]
    if state.time == 0.0:
        state = _begin(leg, state, n)
    state = _reversed(leg, state, n)
    state, planes = _planes(leg, state, n, config.max_planes, dt)
    rudder = _rudder(leg, state, n, config.max_rudder)
    return state, SpatialCommand(rudder, planes, leg.thrust)


@pure
def _is_over(leg: Leg, state: Flown, n: SpatialNavigation) -> bool:
    if state.time >= leg.seconds - 1e-9:
        return True
    if leg.kind == CIRCLE:
        return abs(state.turned) >= leg.limit
    if leg.kind == PLANE_STEP:
        return abs(n.theta - state.pitch) >= leg.limit
    return leg.kind == SUBMERGE and is_at_depth(state, n)


@pure
def is_at_depth(state: Flown, n: SpatialNavigation) -> bool:
    """Return whether the way to the held depth is over: the vehicle is there, and level."""
    return abs(n.z - state.depth) < _AT_DEPTH and abs(n.theta) < _LEVEL


@pure
def _next(state: Flown, n: SpatialNavigation) -> Flown:
    return state._replace(leg=state.leg + 1, time=0.0, side=1.0, reversals=0, turned=0.0, pitch=n.theta)


@pure
def _begin(leg: Leg, state: Flown, n: SpatialNavigation) -> Flown:
    course = state.course
    if leg.homeward:
        course = math.atan2(state.home_y - n.y, state.home_x - n.x)
    elif not math.isnan(leg.course):
        course = wrap(state.home_psi + leg.course)
    return state._replace(course=course, depth=state.depth + leg.depth_step)


@pure
def _reversed(leg: Leg, state: Flown, n: SpatialNavigation) -> Flown:
    """Return the state with the fin reversed where the deviation says so."""
    fin = state.side * leg.fin
    if leg.kind == ZIGZAG:
        deviation = -wrap(n.psi - state.course)
    elif leg.kind == PITCH_ZIGZAG:
        deviation = _desired_pitch(state, n) - n.theta
    elif leg.kind == DEPTH_ZIGZAG:
        deviation = state.depth - n.z
    else:
        return state
    # A positive fin makes the deviation grow.
    if fin * deviation > 0.0 and abs(deviation) >= leg.limit:
        return state._replace(side=-state.side, reversals=state.reversals + 1)
    return state


@pure
def _rudder(leg: Leg, state: Flown, n: SpatialNavigation, largest: float) -> float:
    fin, error = state.side * leg.fin, wrap(n.psi - state.course)
    if leg.kind == CIRCLE:
        return bounded(fin, largest)
    if leg.kind == ZIGZAG:
        # A hull that turns on in spite of the rudder is caught with all of it.
        astray = fin * error > 0.0 and abs(error) > leg.limit + _ASTRAY
        return math.copysign(largest, fin) if astray else bounded(fin, largest)
    return bounded(leg.per_heading * error + leg.per_yaw_rate * n.r, largest)


@pure
def _desired_pitch(state: Flown, n: SpatialNavigation) -> float:
    return bounded(PER_DEPTH * (n.z - state.depth), STEEPEST) + state.trim


@pure
def _planes(leg: Leg, state: Flown, n: SpatialNavigation, largest: float, dt: float) -> tuple[Flown, float]:
    if largest == 0.0:
        return state, 0.0
    fin, desired = state.side * leg.fin, _desired_pitch(state, n)
    if leg.kind == PLANE_STEP:
        return state, bounded(fin, largest)
    if leg.kind == PITCH_ZIGZAG:
        error = n.theta - desired
        astray = fin * error > 0.0 and abs(error) > leg.limit + _STEEP
        return state, math.copysign(largest, fin) if astray else bounded(fin, largest)
    if leg.kind == DEPTH_ZIGZAG:
        desired = fin + state.trim
    elif abs(n.z - state.depth) < 2.0:
        state = state._replace(trim=bounded(state.trim + TRIM_RATE * (n.z - state.depth) * dt, LARGEST_TRIM))
    return state, bounded(leg.per_pitch * (n.theta - desired) + leg.per_pitch_rate * n.q, largest)
