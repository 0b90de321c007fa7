"""Flies many scenarios of `closed_loop` and keeps their figures: the same laws, many times as fast.

    flights = fly([Scenario(...), Scenario(...), ...])
    print(flights.completed.mean(), flights.rms_distance.max())

A scenario may have its own path, vehicle, gains, current and start. What a flight gives depends on its own
scenario only, to the last bit: not on the others, their order or the number of threads. One at sea
(`Scenario.sea`) is flown by `closed_loop` itself, with instruments and navigator, at that one's speed:
docs/performance.md tells them apart.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np

from auv_msgs_py import topics
from auv_path_following import vehicle
from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.line import Line
from auv_path_following.paths.rows import PathRows
from auv_sim import closed_loop
from auv_sim.analysis.flown_share import Cells, cells_of, share_of
from auv_sim.analysis.run import Run
from auv_sim.batch import tally
from auv_sim.batch.compiled import COMPILED
from auv_sim.batch.distance import Outlines, outlines_of, rows_of
from auv_sim.batch.flight import TRACK_COLUMNS, End, fly_one
from auv_sim.batch.flights import Flights, figures_of
from auv_sim.batch.judge import judged
from auv_sim.batch.scenarios import flight_of
from auv_sim.closed_loop import Scenario, start_of
from auv_sim.plant.remus import PlantState, plant_at

_TRACK = ("x", "y", "psi", "r", "ur", "vr", "rudder", "rudder_cmd", "thrust_cmd", "psi_d", "r_d",
          "xe", "ye", "psi_e", "s", "Vx_est", "Vy_est")  # fmt: skip


def fly(
    scenarios: Sequence[Scenario],
    threads: int = 1,
    done: Callable[[int], None] | None = None,
) -> Flights:
    """Fly them all.

    Args:
        scenarios: what to fly.
        threads: how many fly at the same time; more than one helps where `compiled.COMPILED`.
        done: called with the number of odometries after each flight, from any thread.

    Returns:
        One row for each scenario, in their order.

    Raises:
        ConfigurationError: a scenario that cannot be flown.
    """
    # Mistakes come before the first flight. What several scenarios share is turned into numbers once.
    flights: dict[int, Any] = {}
    courses: dict[int, _Course] = {}
    for scenario in scenarios:
        if id(scenario) not in flights:
            flights[id(scenario)] = flight_of(scenario)
        if scenario.sea is None and id(scenario.path) not in courses:
            courses[id(scenario.path)] = _Course.of(scenario.path)

    def one(scenario: Scenario) -> dict[str, Any]:
        if scenario.sea is None:
            flight = flights[id(scenario)]
            course = courses[id(scenario.path)]
            end, whole, subpaths, flown, _ = _flown(flight, scenario, course, 0)
            figures = figures_of(end, whole, subpaths, share_of(course.cells, flown).share, flight.dt)
        else:
            figures = judged(closed_loop.fly(scenario), scenario)
        if done is not None:
            done(figures["steps"])
        return figures

    if threads > 1 and COMPILED:
        with ThreadPoolExecutor(threads) as pool:
            rows = list(pool.map(one, scenarios))
    else:
        rows = [one(scenario) for scenario in scenarios]
    return Flights.from_rows(rows)


def compile_once() -> None:
    """Compile now what the first flight would: a pool's processes then find it done."""
    line = CompositePath([Line(0.0, 0.0, 10.0, 0.0)])
    fly([Scenario(path=line, vehicle=vehicle.load("remus100"), thrust=1.0, time_limit=0.1)])


def track(scenario: Scenario, every: int = 1) -> Run:
    """Fly one scenario and keep its track.

    Args:
        scenario: what to fly.
        every: keep every n-th odometry, from the first one on.

    Returns:
        What `closed_loop.fly` returns, to rounding.

    Raises:
        ConfigurationError: a scenario that cannot be flown.
    """
    flight = flight_of(scenario)
    if scenario.sea is not None:
        return closed_loop.fly(scenario).select(slice(None, None, every))
    *_, rows = _flown(flight, scenario, _Course.of(scenario.path), every)
    step_ns = round(scenario.step * 1e9)
    t = [(topics.FIRST_STAMP_NS + int(k) * step_ns) * 1e-9 for k in rows[:, 0]]
    columns = {"t": t} | {name: rows[:, j] for j, name in enumerate(_TRACK, 1)}
    true = {"Vx_true": np.full(len(t), flight.Vx), "Vy_true": np.full(len(t), flight.Vy)}
    return Run.from_columns(columns | true)


class _Course(NamedTuple):
    """A path as compiled code reads it."""

    curve: PathRows
    outlines: Outlines
    cells: Cells

    @classmethod
    def of(cls, path: CompositePath) -> _Course:
        return cls(rows_of(path), outlines_of(path), cells_of(path))


def _flown(flight: Any, scenario: Scenario, course: _Course, every: int) -> tuple[End, Any, Any, Any, Any]:
    start = PlantState(*map(float, scenario.initial or start_of(scenario.path)))
    whole = np.empty(tally.FLIGHT_TALLIES)
    subpaths = np.empty((len(course.curve.subpath), tally.SUBPATH_TALLIES))
    flown = np.empty(len(course.cells.cells), np.bool_)
    rows = math.ceil(flight.steps / every) if every else 0
    kept = np.empty((rows, TRACK_COLUMNS))
    with np.errstate(all="ignore"):  # a state that runs away is a result
        end = fly_one(flight, *course, plant_at(start), whole, subpaths, flown, kept, every)
    return end, whole, subpaths, flown, kept[: math.ceil(end.rows / every)] if every else kept
