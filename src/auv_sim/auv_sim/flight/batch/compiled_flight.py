"""Whole flights in compiled code: pilot and plant of `closed_loop.fly`, many flights a call."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.guidance.approach import empty_approach
from auv_sim.flight.batch import same_bits, tally  # noqa: F401 - before anything is compiled
from auv_sim.flight.batch.compiled import compiled, inlined, take_over_pure
from auv_sim.flight.batch.config_rows import unpack
from auv_sim.flight.batch.kinds.chosen import (
    at_rest,
    begins,
    count_extras,
    count_motion,
    is_finite,
    largest_angle,
    mark_cells,
    off_beside,
    off_followed,
    reply,
    squared_error,
    start_from,
    write_end,
    write_row,
)
from auv_sim.flight.batch.kinds.nearest import UNTRACKED
from auv_sim.flight.path_cells import Cells
from auv_sim.vehicle.simulated import vehicle_measure, vehicle_step

take_over_pure()

Array = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]


class FlightConfig(NamedTuple):
    """Configuration of a flight, without its path, its start and its current.

    Attributes:
        pilot: `Pilot`, `SpatialPilot` for a vehicle that dives, or `PeerPilot`.
        plant: the simulated vehicle.
        dt: between two odometries, s.
        steps: at most this many odometries.
        calm: time from which rates of yaw and pitch count, s.
    """

    pilot: Any
    plant: Any
    dt: float
    steps: int
    calm: float


class Course(NamedTuple):
    """A path as compiled code reads it: rows, outlines for distances, and cells for the flown share."""

    path: Any
    outlines: Any
    cells: Cells


class Scratch(NamedTuple):
    """Tables that a flight writes.

    Attributes:
        approach: rows of its approach.
        flown: whether each cell was flown, shape (cells,).
        ring: of its servos.
    """

    approach: Array
    flown: Flags
    ring: Array


def scratch_of(course: Course, ring: int = 0) -> Scratch:
    """Return tables for flights of a course whose servos have rings of at most `ring` numbers."""
    cells = np.zeros(len(course.cells.cells), np.bool_)
    return Scratch(np.array(empty_approach()), cells, np.zeros(2 * max(ring, 1)))


@inlined
def fly_one(
    c: FlightConfig, vehicle: Any, afloat: Any, constant: Any, course: Course, scratch: Scratch,
    whole: Array, subpaths: Array, end: Array, track: Array, every: int,
) -> None:  # fmt: skip
    """Fly until the end of the path, the last step, or a state that is not finite.

    Args:
        c, course: what is flown.
        vehicle, afloat: configuration and first state of the vehicle, of `vehicle_step`.
        constant: current, NED, m/s: `Current`, or `SpatialCurrent`.
        scratch: written.
        whole, subpaths, end: tallies, shapes (FLIGHT_TALLIES,), (m, SUBPATH_TALLIES) and (ENDS,), or those of
            `spatial_tally`; written.
        track: shape (rows, TRACK_COLUMNS) or (rows, SPATIAL_TRACK_COLUMNS), every `every`-th odometry;
            written; `every` 0 for none.
    """
    path, outlines, cells = course
    flown = scratch.flown
    flown[:] = False
    tally.begin(whole, subpaths)
    flying = begins(c.pilot, scratch.approach)
    commanded, stop = 0.0, largest_angle(c.pilot)
    i, clear, s, finite, nearest, covered = -1, 0.0, 0.0, True, UNTRACKED, 0.0
    odometries = c.steps
    afloat, seen = vehicle_measure(vehicle, afloat, (at_rest(c.pilot), constant, 1.0), 0.0)
    for k in range(c.steps):
        since = c.dt if k > 0 else 0.0
        state = seen.motion
        flying, navigation, estimate, guided, command = reply(c.pilot, path, flying, seen, k * c.dt, since)
        finished, s = guided.finished, guided.s
        if guided.i != i:
            i, clear, nearest = guided.i, 0.0, UNTRACKED
        nearest, distance, below = off_followed(path, outlines, nearest, i, state, covered)
        if distance > clear:
            # A track's distance includes the subpaths before and after i, but they are seldom nearer: reduced
            # by what is covered since, this bounds how far the vehicle can go until they must be evaluated.
            clear, beside = off_beside(path, outlines, i, state)
            if clear < distance:
                distance, below = clear, beside
        finite = math.isfinite(command.rudder) and is_finite(state)
        if finite:
            error = squared_error(estimate, seen.current)
            tally.count(whole, subpaths, i, s, k * c.dt, distance, guided.psi_e, error)
            is_near = count_extras(path, whole, subpaths, i, k * c.dt, c.calm, state, below)
            tally.count_steadiness(whole, k * c.dt, c.calm, distance, navigation.r, is_near)
        if every > 0 and k % every == 0:
            write_row(navigation, track[k // every], k, seen, guided, estimate, command)
        if finished or not finite:
            odometries = k + 1
            break
        if k > 0:
            is_at_stop = abs(command.rudder) >= stop - 1e-12
            tally.count_command(whole, (command.rudder - commanded) / c.dt, is_at_stop)
        commanded, before = command.rudder, seen
        if k + 1 == c.steps:  # motion after the last odometry is not attributed to a subpath
            break
        afloat, seen = vehicle_step(vehicle, afloat, (command, constant, 1.0), c.dt)
        covered = count_motion(seen, before, subpaths, i, c.dt)
        clear -= covered
        mark_cells(path, cells, flown, s, state, seen.motion)
    end[tally.ODOMETRIES], end[tally.S], end[tally.FINITE] = odometries, s, 1.0 if finite else 0.0
    end[tally.SHARE] = np.mean(flown)
    write_end(seen.motion, end)


#: `fly_one` for calls from Python: flights at sea, each of which has its own vehicle.
fly_alone = compiled(fly_one)


@compiled
def fly_many(
    example: FlightConfig, configs: Array, which: Array, starts: Array, currents: Array,
    course: Course, scratch: Scratch, whole: Array, subpaths: Array, ends: Array, track: Array, every: int,
) -> None:  # fmt: skip
    """Fly n flights of one course without a sea.

    Args:
        example: a flight of the same layout.
        configs: shape (k, numbers), `rows.flat` of different flights.
        which: shape (n,), each flight's row in `configs`.
        starts: shape (n, 6) or (n, 13), first states of the hulls.
        currents: shape (n, 2) or (n, 3), NED, m/s.
        course: the path.
        scratch: used by each flight in turn.
        whole, subpaths, ends: written; a row of each for each flight, see `fly_one`.
        track, every: as of `fly_one`, for the last flight.
    """
    for k in range(len(which)):
        flight = unpack(example, configs[which[k]])
        start, current = start_from(flight.plant, starts[k], currents[k], scratch.ring)
        fly_one(
            flight, flight.plant, start, current, course, scratch, whole[k], subpaths[k], ends[k], track,
            every,
        )  # fmt: skip
