"""One whole flight in compiled code: `closed_loop.fly` over plain numbers."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from auv_msgs_py.types import NO_CURRENT, Current, Reference, WaterVelocity
from auv_path_following.control.autopilot import AutopilotInputs, first_state, steer
from auv_path_following.guidance.approach import LEGS
from auv_path_following.guidance.current_observer import ObserverInputs, ObserverState, observe
from auv_path_following.guidance.follow import FollowerInputs, follow
from auv_path_following.guidance.follow import first_state as first_follower_state
from auv_path_following.paths.rows import COLUMNS, PathRows
from auv_sim.analysis.flown_share import Cells
from auv_sim.batch import tally
from auv_sim.batch.compiled import compiled, take_over_pure
from auv_sim.batch.distance import Outlines, distance_to
from auv_sim.batch.flown_cells import pass_cells
from auv_sim.batch.numbers import Flight
from auv_sim.plant.remus import Afloat, PlantInputs, PlantState, navigation_of, plant_step

take_over_pure()

Array = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

#: Columns of a track, in the order of `closed_loop`'s, the stamp first and without the constant true current.
TRACK_COLUMNS = 18


class End(NamedTuple):
    """How a flight ended.

    Attributes:
        rows: odometries.
        s: of Eq. (1).
        finite: whether the state stayed finite.
        state: the last one.
    """

    rows: int
    s: float
    finite: bool
    state: PlantState


@compiled
def fly_one(
    c: Flight,
    curve: PathRows,
    outlines: Outlines,
    cells: Cells,
    afloat: Afloat,
    whole: Array,
    subpaths: Array,
    flown: Flags,
    track: Array,
    every: int,
) -> End:
    """Fly until the end of the path, the last step, or a state that is not finite.

    Args:
        c, curve, outlines, cells: what is flown; the path as rows, as outlines and as cells.
        afloat: the plant's first state.
        whole, subpaths: tallies, shape (FLIGHT_TALLIES,) and (n, SUBPATH_TALLIES); written.
        flown: shape (cells,), which cells were flown; written.
        track: shape (rows, TRACK_COLUMNS), every `every`-th odometry; written; `every` 0 for none.
    """
    current = Current(c.Vx, c.Vy)
    observer = ObserverState(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, NO_CURRENT)
    follower = first_follower_state(c.guidance, np.zeros((LEGS, COLUMNS)))
    pilot = first_state(c.autopilot)
    commanded = 0.0
    i, clear = -1, 0.0
    flown[:] = False
    tally.begin(whole, subpaths)
    for k in range(c.steps):
        since = c.dt if k > 0 else 0.0
        state, rudder = afloat.hull, afloat.servo.angle
        navigation = navigation_of(state)
        water = WaterVelocity(state.ur, state.vr)
        observer, seen = observe(c.observer, observer, ObserverInputs(navigation, water, True), since)
        estimate = seen.current
        follower, guided = follow(
            c.guidance, curve, follower, FollowerInputs(navigation, water, estimate), since
        )
        finished = guided.finished
        reference = Reference(guided.psi_d, guided.r_d, 0.0 if finished else c.thrust)
        pilot, steered = steer(c.autopilot, pilot, AutopilotInputs(navigation, reference), since)
        psi_e = steered.psi_e
        command, thrust = steered.command
        s = guided.s
        if guided.i != i:
            i, clear = guided.i, 0.0
        distance = distance_to(curve, outlines, i, state.x, state.y)
        if distance > clear:
            clear = _clearance(curve, outlines, i, state.x, state.y)
            distance = min(distance, clear)
        finite = math.isfinite(command) and math.isfinite(state.x + state.y + state.psi + state.ur + state.vr)
        if finite:
            tally.count(
                whole, subpaths, i, s, k * c.dt, distance, psi_e, estimate.Vx - c.Vx, estimate.Vy - c.Vy
            )
        if every > 0 and k % every == 0:
            row = track[k // every]
            row[0], row[1], row[2], row[3] = k, state.x, state.y, state.psi
            row[4], row[5], row[6], row[7] = state.r, state.ur, state.vr, rudder
            row[8], row[9] = command, thrust
            row[10], row[11] = guided.psi_d, guided.r_d
            row[12], row[13], row[14] = guided.xe, guided.ye, psi_e
            row[15], row[16], row[17] = s, estimate.Vx, estimate.Vy
        if finished or not finite:
            return End(k + 1, s, finite, state)
        if k > 0:
            tally.count_command(
                whole, (command - commanded) / c.dt, abs(command) >= c.autopilot.max_angle - 1e-12
            )
        commanded = command
        afloat, motion = plant_step(c.plant, afloat, PlantInputs(steered.command, current, 1.0), c.dt)
        dx, dy = motion.x - state.x, motion.y - state.y
        covered = math.sqrt(dx * dx + dy * dy)
        clear -= covered
        if k + 1 < c.steps:
            tally.count_step(subpaths, i, c.dt, abs(afloat.servo.angle - rudder), covered)
            pass_cells(cells, flown, s, state.x, state.y, motion.x, motion.y)
    return End(c.steps, s, finite, state)  # the way after the last odometry is nobody's


@compiled
def _clearance(curve: PathRows, outlines: Outlines, i: int, x: float, y: float) -> float:
    """Closest distance to the subpaths before and after subpath i, m.

    The distance of a track counts them, too (`CompositePath.distance`), but they are seldom nearer: less the
    way covered since, this says for how long nobody needs to look.
    """
    closest = math.inf
    if i > 0:
        closest = distance_to(curve, outlines, i - 1, x, y)
    if i + 1 < curve.n:
        closest = min(closest, distance_to(curve, outlines, i + 1, x, y))
    return closest
