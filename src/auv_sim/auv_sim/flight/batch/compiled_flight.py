"""Whole flights in compiled code: pilot and plant of `closed_loop.fly`, many flights a call."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_msgs_py.contract.frames import heading_over_the_wire
from auv_msgs_py.values.types import Command, Current, Navigation
from auv_path_following.curves.rows import PathRows
from auv_path_following.guidance.approach import empty_approach
from auv_path_following.guidance.measured import Measured
from auv_path_following.pilot import Pilot, begun, pilot
from auv_sim.flight.batch import same_bits, tally  # noqa: F401 - before anything is compiled
from auv_sim.flight.batch.compiled import compiled, take_over_pure
from auv_sim.flight.batch.config_rows import unpack
from auv_sim.flight.batch.distance import Outlines, distance_to
from auv_sim.flight.batch.flown_cells import pass_cells
from auv_sim.flight.batch.track_row import TRACK_COLUMNS, fill_row
from auv_sim.flight.flown_share import Cells
from auv_sim.vehicle.actuator import servo_begin
from auv_sim.vehicle.remus import Afloat, PlantState
from auv_sim.vehicle.simulated import vehicle_measure, vehicle_step

take_over_pure()

Array = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]


class FlightConfig(NamedTuple):
    """Configuration of a flight, without its path, its start and its current.

    Attributes:
        pilot: observer, guidance, autopilot.
        plant: the simulated vehicle.
        dt: between two odometries, s.
        steps: at most this many odometries.
    """

    pilot: Pilot
    plant: Any
    dt: float
    steps: int


class Course(NamedTuple):
    """A path as compiled code reads it: rows, outlines for distances, and cells for the flown share."""

    path: PathRows
    outlines: Outlines
    cells: Cells


class Scratch(NamedTuple):
    """Tables that a flight writes.

    Attributes:
        approach: rows of its approach.
        flown: whether each cell was flown, shape (cells,).
        ring: of its servo.
    """

    approach: Array
    flown: Flags
    ring: Array


def scratch_of(course: Course, ring: int = 0) -> Scratch:
    """Return tables for flights of a course whose servos have rings of at most `ring` numbers."""
    cells = np.zeros(len(course.cells.cells), np.bool_)
    return Scratch(np.array(empty_approach()), cells, np.zeros(max(ring, 1)))


@compiled
def fly_many(
    example: FlightConfig, configs: Array, which: Array, starts: Array, currents: Array,
    course: Course, scratch: Scratch, whole: Array, subpaths: Array, ends: Array,
) -> None:  # fmt: skip
    """Fly n flights of one course.

    Args:
        example: a flight of the same layout.
        configs: shape (k, numbers), `rows.flat` of different flights.
        which: shape (n,), each flight's row in `configs`.
        starts: shape (n, 6), first states of the hulls.
        currents: shape (n, 2), NED, m/s.
        course: the path.
        scratch: used by each flight in turn.
        whole, subpaths, ends: written; shapes (n, FLIGHT_TALLIES), (n, m, SUBPATH_TALLIES), (n, ENDS).
    """
    none = np.empty((0, TRACK_COLUMNS))
    for k in range(len(which)):
        flight = unpack(example, configs[which[k]])
        row = starts[k]  # the fields of PlantState
        servo, _ = servo_begin(flight.plant.servo, scratch.ring, 0.0, 0.0)
        start = Afloat(PlantState(row[0], row[1], row[2], row[3], row[4], row[5]), servo)
        current = Current(currents[k, 0], currents[k, 1])
        fly_one(
            flight, flight.plant, start, current, course, scratch, whole[k], subpaths[k], ends[k], none, 0
        )


@compiled
def fly_one(
    c: FlightConfig, vehicle: Any, afloat: Any, constant: Current, course: Course, scratch: Scratch,
    whole: Array, subpaths: Array, end: Array, track: Array, every: int,
) -> None:  # fmt: skip
    """Fly until the end of the path, the last step, or a state that is not finite.

    Args:
        c, course: what is flown.
        vehicle, afloat: configuration and first state of the vehicle, of `vehicle_step`.
        constant: current, NED, m/s.
        scratch: written.
        whole, subpaths, end: tallies, shapes (FLIGHT_TALLIES,), (m, SUBPATH_TALLIES) and (ENDS,); written.
        track: shape (rows, TRACK_COLUMNS), every `every`-th odometry; written; `every` 0 for none.
    """
    path, outlines, cells = course
    flown = scratch.flown
    flown[:] = False
    tally.begin(whole, subpaths)
    flying = begun(c.pilot, scratch.approach)
    commanded = 0.0
    i, clear, s, finite = -1, 0.0, 0.0, True
    odometries = c.steps
    afloat, seen = vehicle_measure(vehicle, afloat, (Command(0.0, 0.0), constant, 1.0), 0.0)
    for k in range(c.steps):
        since = c.dt if k > 0 else 0.0
        navigation, state, current = seen.navigation, seen.motion, seen.current
        if c.pilot.by_wire:
            x, y, psi, r = navigation
            navigation = Navigation(x, y, heading_over_the_wire(psi), r)
        measured = Measured(navigation, seen.water, True, False, 0.0, k * c.dt)
        flying, (estimate, guided, _, (command, thrust)) = pilot(c.pilot, path, flying, measured, since)
        finished, s = guided.finished, guided.s
        if guided.i != i:
            i, clear = guided.i, 0.0
        distance = distance_to(path, outlines, i, state.x, state.y)
        if distance > clear:
            clear = _clearance(path, outlines, i, state.x, state.y)
            distance = min(distance, clear)
        finite = math.isfinite(command) and math.isfinite(state.x + state.y + state.psi + state.ur + state.vr)
        if finite:
            off = estimate.Vx - current.Vx, estimate.Vy - current.Vy
            tally.count(whole, subpaths, i, s, k * c.dt, distance, guided.psi_e, off[0], off[1])
        if every > 0 and k % every == 0:
            fill_row(track[k // every], k, navigation, seen, guided, estimate, command, thrust)
        if finished or not finite:
            odometries = k + 1
            break
        if k > 0:
            is_at_stop = abs(command) >= c.pilot.autopilot.max_angle - 1e-12
            tally.count_command(whole, (command - commanded) / c.dt, is_at_stop)
        commanded = command
        rudder = seen.rudder
        if k + 1 == c.steps:  # motion after the last odometry is not attributed to a subpath
            break
        afloat, seen = vehicle_step(vehicle, afloat, ((command, thrust), constant, 1.0), c.dt)
        after = seen.motion
        covered = math.sqrt((after.x - state.x) ** 2 + (after.y - state.y) ** 2)
        clear -= covered
        tally.count_step(subpaths, i, c.dt, abs(seen.rudder - rudder), covered)
        pass_cells(cells, flown, s, state.x, state.y, after.x, after.y)
    end[tally.ODOMETRIES], end[tally.S], end[tally.FINITE] = odometries, s, 1.0 if finite else 0.0
    end[tally.SHARE] = np.mean(flown)
    end[tally.LAST_X], end[tally.LAST_Y] = seen.motion.x, seen.motion.y


@compiled
def _clearance(curve: PathRows, outlines: Outlines, i: int, x: float, y: float) -> float:
    """Closest distance to the subpaths before and after subpath i, m.

    The distance of a track includes them (`CompositePath.distance`), but they are seldom nearer: reduced by
    the distance covered since, this bounds how far the vehicle can go before they must be evaluated again.
    """
    closest = math.inf
    if i > 0:
        closest = distance_to(curve, outlines, i - 1, x, y)
    if i + 1 < curve.n:
        closest = min(closest, distance_to(curve, outlines, i + 1, x, y))
    return closest
