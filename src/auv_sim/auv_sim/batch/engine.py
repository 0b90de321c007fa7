"""Flies many scenarios of `closed_loop` and keeps their figures: the same laws, some hundred times as fast.

    flights = fly([Scenario(...), Scenario(...), ...])
    print(flights.completed.mean(), flights.rms_distance.max())

A scenario may have its own path, vehicle, gains, current and start. What a flight gives depends on its own
scenario only, to the last bit: not on the others, their order or the number of threads.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from auv_msgs_py import topics
from auv_sim.analysis.run import Run
from auv_sim.batch import tally
from auv_sim.batch.compiled import COMPILED
from auv_sim.batch.curve import Curve, curve_of
from auv_sim.batch.flight import TRACK_COLUMNS, End, fly_one
from auv_sim.batch.flights import Flights, figures_of
from auv_sim.batch.scenarios import flight_of
from auv_sim.closed_loop import Scenario, start_of
from auv_sim.plant.remus import PlantState

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
    curves = _Curves()
    prepared = [(_prepared(scenario), curves.of(scenario)) for scenario in scenarios]

    def one(job: tuple[Any, Curve]) -> dict[str, Any]:
        (flight, start), curve = job
        end, whole, subpaths, _ = _flown(flight, start, curve, 0)
        if done is not None:
            done(end.rows)
        return figures_of(end, whole, subpaths, flight.dt)

    if threads > 1 and COMPILED:
        with ThreadPoolExecutor(threads) as pool:
            rows = list(pool.map(one, prepared))
    else:
        rows = [one(job) for job in prepared]
    return Flights.from_rows(rows)


def track(scenario: Scenario, every: int = 1) -> Run:
    """Fly one scenario and keep its track.

    Args:
        scenario: what to fly.
        every: keep every so-manieth odometry, from the first one on.

    Returns:
        What `closed_loop.fly` returns, to rounding.

    Raises:
        ConfigurationError: a scenario that cannot be flown.
    """
    flight, start = _prepared(scenario)
    *_, rows = _flown(flight, start, curve_of(scenario.path), every)
    step_ns = round(scenario.step * 1e9)
    t = [(topics.FIRST_STAMP_NS + int(k) * step_ns) * 1e-9 for k in rows[:, 0]]
    columns = {"t": t} | {name: rows[:, j] for j, name in enumerate(_TRACK, 1)}
    true = {"Vx_true": np.full(len(t), flight.Vx), "Vy_true": np.full(len(t), flight.Vy)}
    return Run.from_columns(columns | true)


class _Curves:
    """Every path is turned into numbers once, however many scenarios share it."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[Any, Curve]] = {}

    def of(self, scenario: Scenario) -> Curve:
        path = scenario.path
        if id(path) not in self._known:
            self._known[id(path)] = path, curve_of(path)  # the path too, so that its id stays its own
        return self._known[id(path)][1]


def _prepared(scenario: Scenario) -> tuple[Any, PlantState]:
    start = scenario.initial or start_of(scenario.path)
    return flight_of(scenario), PlantState(*map(float, start))


def _flown(flight: Any, start: PlantState, curve: Curve, every: int) -> tuple[End, Any, Any, Any]:
    whole = np.empty(tally.FLIGHT_TALLIES)
    subpaths = np.empty((len(curve.subpath), tally.SUBPATH_TALLIES))
    rows = math.ceil(flight.steps / every) if every else 0
    kept = np.empty((rows, TRACK_COLUMNS))
    with np.errstate(all="ignore"):  # a state that runs away is a result
        end = fly_one(flight, curve, start, whole, subpaths, kept, every)
    return end, whole, subpaths, kept[: math.ceil(end.rows / every)] if every else kept
