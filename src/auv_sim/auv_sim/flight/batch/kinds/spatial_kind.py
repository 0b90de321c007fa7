"""A step of a flight in three dimensions: what `compiled_flight.fly_one` leaves to the kind of flight."""

from __future__ import annotations

import math
from typing import Any

from auv_msgs_py.values.attitude import attitude_over_the_wire
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import SpatialCommand, SpatialCurrent, SpatialNavigation
from auv_path_following.curves.rows import CORNER, JOINT, JOINT_X, JOINT_Y, JOINT_Z
from auv_path_following.curves.spatial.spatial_rows import SpatialRows
from auv_path_following.guidance.measured import SpatialMeasured
from auv_path_following.guidance.spatial.spatial_follow import SpatialOutput
from auv_path_following.spatial_pilot import SpatialPilot, spatial_pilot
from auv_sim.flight.batch import tally
from auv_sim.flight.batch.flown_cells import pass_cells_in_space
from auv_sim.flight.batch.kinds.nearest import UNTRACKED, Nearest, SpatialOutlines, off_subpath
from auv_sim.flight.batch.kinds.spatial_tally import LAST_Z, PLANES_TRAVEL, count_depth
from auv_sim.flight.path_cells import CORNER_RADIUS, Cells
from auv_sim.vehicle.diving.ideal_diver import SpatialSeen
from auv_sim.vehicle.fins.actuator import servo_begin
from auv_sim.vehicle.hulls.rigid_body import BodyState
from auv_sim.vehicle.hulls.spatial_plant import SpatialAfloat, SpatialPlant


@pure
def spatial_start(
    plant: SpatialPlant, row: Any, water: Any, ring: Any
) -> tuple[SpatialAfloat, SpatialCurrent]:
    """Return the first state of a vehicle, and the constant current.

    Args:
        plant: the vehicle.
        row: shape (13,), fields of `BodyState`.
        water: shape (3,), current, NED, m/s.
        ring: of its servos, half of it for each.
    """
    half = len(ring) // 2
    rudder, _ = servo_begin(plant.rudder, ring[:half], 0.0, 0.0)
    sternplanes, _ = servo_begin(plant.sternplanes, ring[half:], 0.0, 0.0)
    start = BodyState(
        row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9], row[10], row[11],
        row[12],
    )  # fmt: skip
    return SpatialAfloat(start, rudder, sternplanes), SpatialCurrent(water[0], water[1], water[2])


@pure
def spatial_reply(
    config: SpatialPilot, path: SpatialRows, state: Any, seen: SpatialSeen, now: float, dt: float
) -> tuple[Any, SpatialNavigation, SpatialCurrent, SpatialOutput, SpatialCommand]:
    """Answer one measurement, as `planar_answer`."""
    navigation = seen.navigation
    if config.by_wire:
        x, y, z, phi, theta, psi, q, r = navigation
        phi, theta, psi = attitude_over_the_wire(phi, theta, psi)
        navigation = SpatialNavigation(x, y, z, phi, theta, psi, q, r)
    measured = SpatialMeasured(navigation, seen.water, True, False, 0.0, now, seen.altitude)
    state, (estimate, guided, _, command) = spatial_pilot(config, path, state, measured, dt)
    return state, navigation, estimate, guided, command


@pure
def spatial_stop(config: SpatialPilot) -> SpatialCommand:
    """Return the command that stops."""
    return SpatialCommand(0.0, 0.0, 0.0)


@pure
def spatial_largest_angle(config: SpatialPilot) -> float:
    """Return the largest rudder angle, rad."""
    return float(config.autopilot.heading.max_angle)


@pure
def spatial_off(
    path: SpatialRows, outlines: SpatialOutlines, nearest: Nearest, i: int, motion: BodyState, covered: float
) -> tuple[Nearest, float, float]:
    """Return the tracked place on subpath i, the distance, and depth less that of the path there, m."""
    return off_subpath(path, outlines, nearest, i, motion.x, motion.y, motion.z, covered)


@pure
def spatial_beside(
    path: SpatialRows, outlines: SpatialOutlines, i: int, motion: BodyState
) -> tuple[float, float]:
    """Return the distance from the subpaths before and after subpath i, and the depth less theirs, m."""
    closest, below = math.inf, 0.0
    if i > 0:
        _, closest, below = off_subpath(path, outlines, UNTRACKED, i - 1, motion.x, motion.y, motion.z, 0.0)
    if i + 1 < path.plan.n:
        _, ahead, deeper = off_subpath(path, outlines, UNTRACKED, i + 1, motion.x, motion.y, motion.z, 0.0)
        if ahead < closest:
            closest, below = ahead, deeper
    return closest, below


@pure
def spatial_is_finite(motion: BodyState) -> bool:
    """Return whether a state is finite."""
    speeds = motion.ur + motion.vr + motion.wr
    return math.isfinite(motion.x + motion.y + motion.z + motion.qw + motion.qk + speeds)


@pure
def spatial_squared_error(estimate: SpatialCurrent, current: SpatialCurrent) -> float:
    """Return the squared error of the estimated current, m^2/s^2."""
    dx, dy, dz = estimate.Vx - current.Vx, estimate.Vy - current.Vy, estimate.Vz - current.Vz
    return dx * dx + dy * dy + dz * dz


@pure
def spatial_extras(
    path: SpatialRows, whole: Any, subpaths: Any, i: int, elapsed: float, calm: float, motion: BodyState,
    below: float,
) -> bool:  # fmt: skip
    """Count what an odometry says about depth and pitch; return whether the vehicle is at a corner."""
    rows = path.plan.subpath
    is_near = _is_near_joint(rows[i], motion) or (i > 0 and _is_near_joint(rows[i - 1], motion))
    sine = 2.0 * (motion.qw * motion.qj - motion.qk * motion.qi)
    count_depth(whole, subpaths, i, elapsed, calm, below, sine, motion.q, is_near)
    return is_near


@pure
def _is_near_joint(row: Any, motion: BodyState) -> bool:
    """Return whether the vehicle is near the joint at a subpath's end, and that is a corner."""
    dx, dy, dz = motion.x - row[JOINT_X], motion.y - row[JOINT_Y], motion.z - row[JOINT_Z]
    away = math.sqrt(dx * dx + dy * dy + dz * dz)
    return bool(row[JOINT] == CORNER and away <= CORNER_RADIUS)


@pure
def spatial_after(seen: SpatialSeen, before: SpatialSeen, subpaths: Any, i: int, dt: float) -> float:
    """Count the motion since the last measurement; return the distance covered, m."""
    after, first = seen.motion, before.motion
    dx, dy, dz = after.x - first.x, after.y - first.y, after.z - first.z
    covered = math.sqrt(dx * dx + dy * dy + dz * dz)
    tally.count_step(subpaths, i, dt, abs(seen.rudder - before.rudder), covered)
    subpaths[i, PLANES_TRAVEL] += abs(seen.sternplanes - before.sternplanes)
    return covered


@pure
def spatial_pass(
    path: SpatialRows, cells: Cells, flown: Any, s: float, first: BodyState, after: BodyState
) -> None:
    """Mark the cells that a step passes."""
    pass_cells_in_space(cells, flown, s, (first.x, first.y, first.z), (after.x, after.y, after.z))


@pure
def spatial_end(motion: BodyState, end: Any) -> None:
    """Write the last position."""
    end[tally.LAST_X], end[tally.LAST_Y], end[LAST_Z] = motion.x, motion.y, motion.z
