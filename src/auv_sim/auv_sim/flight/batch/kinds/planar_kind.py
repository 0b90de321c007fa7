"""A step of a flight in the plane: what `compiled_flight.fly_one` leaves to the kind of flight."""

from __future__ import annotations

import math
from typing import Any

from auv_msgs_py.contract.frames import navigation_over_the_wire
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import Command, Current, Navigation
from auv_path_following.curves.rows import CORNER, JOINT, JOINT_X, JOINT_Y, PathRows
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.guidance.measured import Measured
from auv_path_following.pilot import Pilot, pilot
from auv_sim.flight.batch import tally
from auv_sim.flight.batch.distance import Outlines, distance_to
from auv_sim.flight.batch.flown_cells import pass_cells
from auv_sim.flight.batch.kinds.nearest import Nearest
from auv_sim.flight.path_cells import CORNER_RADIUS, Cells
from auv_sim.vehicle.at_sea import Seen
from auv_sim.vehicle.fins.actuator import servo_begin
from auv_sim.vehicle.remus import Afloat, Plant, PlantState


@pure
def planar_start(plant: Plant, row: Any, water: Any, ring: Any) -> tuple[Afloat, Current]:
    """Return the first state of a vehicle, and the constant current.

    Args:
        plant: the vehicle.
        row: shape (6,), fields of `PlantState`.
        water: shape (2,), current, NED, m/s.
        ring: of its servo.
    """
    servo, _ = servo_begin(plant.servo, ring, 0.0, 0.0)
    start = PlantState(row[0], row[1], row[2], row[3], row[4], row[5])
    return Afloat(start, servo), Current(water[0], water[1])


@pure
def planar_answer(
    config: Pilot, path: PathRows, state: Any, seen: Seen, now: float, dt: float
) -> tuple[Any, Navigation, Current, GuidanceOutput, Command]:
    """Answer one measurement; return the pilot's state, what it measured and estimated, and its outputs."""
    navigation = seen.navigation
    if config.by_wire:
        navigation = navigation_over_the_wire(navigation)
    measured = Measured(navigation, seen.water, True, False, 0.0, now)
    state, (estimate, guided, _, command) = pilot(config, path, state, measured, dt)
    return state, navigation, estimate, guided, command


@pure
def planar_stop(config: Pilot) -> Command:
    """Return the command that stops."""
    return Command(0.0, 0.0)


@pure
def planar_largest_angle(config: Pilot) -> float:
    """Return the largest rudder angle, rad."""
    return float(config.autopilot.max_angle)


@pure
def planar_off(
    path: PathRows, outlines: Outlines, nearest: Nearest, i: int, motion: PlantState, covered: float
) -> tuple[Nearest, float, float]:
    """Return the distance from subpath i, m; the rest is for three dimensions."""
    return nearest, distance_to(path, outlines, i, motion.x, motion.y), 0.0


@pure
def planar_beside(path: PathRows, outlines: Outlines, i: int, motion: PlantState) -> tuple[float, float]:
    """Return the distance from the subpaths before and after subpath i, m, and 0."""
    closest = math.inf
    if i > 0:
        closest = distance_to(path, outlines, i - 1, motion.x, motion.y)
    if i + 1 < path.n:
        closest = min(closest, distance_to(path, outlines, i + 1, motion.x, motion.y))
    return closest, 0.0


@pure
def planar_is_finite(motion: PlantState) -> bool:
    """Return whether a state is finite."""
    return math.isfinite(motion.x + motion.y + motion.psi + motion.ur + motion.vr)


@pure
def planar_squared_error(estimate: Current, current: Current) -> float:
    """Return the squared error of the estimated current, m^2/s^2."""
    dx, dy = estimate.Vx - current.Vx, estimate.Vy - current.Vy
    return dx * dx + dy * dy


@pure
def planar_extras(
    path: PathRows, whole: Any, subpaths: Any, i: int, elapsed: float, calm: float, motion: PlantState,
    below: float,
) -> bool:  # fmt: skip
    """Return whether the vehicle is at a corner; count nothing more."""
    x, y = motion.x, motion.y
    return is_near_joint(path.subpath[i], x, y) or (i > 0 and is_near_joint(path.subpath[i - 1], x, y))


@pure
def is_near_joint(row: Any, x: float, y: float) -> bool:
    """Return whether a place is near the joint at a subpath's end, and that is a corner."""
    dx, dy = x - row[JOINT_X], y - row[JOINT_Y]
    return bool(row[JOINT] == CORNER and math.sqrt(dx * dx + dy * dy) <= CORNER_RADIUS)


@pure
def planar_after(seen: Seen, before: Seen, subpaths: Any, i: int, dt: float) -> float:
    """Count the motion since the last measurement; return the distance covered, m."""
    after, first = seen.motion, before.motion
    covered = math.sqrt((after.x - first.x) ** 2 + (after.y - first.y) ** 2)
    tally.count_step(subpaths, i, dt, abs(seen.rudder - before.rudder), covered)
    return covered


@pure
def planar_pass(
    path: PathRows, cells: Cells, flown: Any, s: float, first: PlantState, after: PlantState
) -> None:
    """Mark the cells that a step passes."""
    pass_cells(cells, flown, s, first.x, first.y, after.x, after.y)


@pure
def planar_end(motion: PlantState, end: Any) -> None:
    """Write the last position."""
    end[tally.LAST_X], end[tally.LAST_Y] = motion.x, motion.y
