"""Flies many scenarios of `closed_loop` for their figures: the same pilot, many times as fast.

    flights = fly([Scenario(...), Scenario(...), ...])
    print(flights.completed.mean(), flights.rms_distance.max())

A scenario may have its own path, vehicle, gains, current and start. The figures of a flight depend on its own
scenario only, to the last bit: not on the others, their order or the number of threads.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.values.types import Current
from auv_path_following import vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import tally, track_row
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.flight.batch.compiled_flight import (
    Course,
    FlightConfig,
    fly_many,
    fly_one,
    scratch_of,
)
from auv_sim.flight.batch.distance import outlines_of, rows_of
from auv_sim.flight.batch.flight_figures import Flights, figures_of
from auv_sim.flight.batch.judge import judged
from auv_sim.flight.batch.scenarios import Preparation, flight_of
from auv_sim.flight.flown_share import cells_of
from auv_sim.flight.run_record import Run
from auv_sim.flight.scenario import Scenario, start_of
from auv_sim.flight.signals import TRUTH
from auv_sim.vehicle.actuator import ring_size, servo_begin, servo_of
from auv_sim.vehicle.at_sea import at_sea_of
from auv_sim.vehicle.draws import Draws
from auv_sim.vehicle.remus import Afloat, PlantState
from auv_sim.vehicle.sea import Sea

#: Flights of one compiled call.
_CHUNK = 64

Done = Callable[[int], None]


def fly(scenarios: Sequence[Scenario], threads: int = 1, done: Done | None = None) -> Flights:
    """Fly all scenarios.

    Args:
        scenarios: what to fly.
        threads: flights at the same time; more than one is faster where `compiled.COMPILED`.
        done: called with the number of odometries of each flight, after it, from any thread.

    Returns:
        One row for each scenario, in their order.

    Raises:
        ConfigurationError: a scenario that cannot be flown.
    """
    # Errors are found before the first flight.
    chunks = _chunks(scenarios, -(-len(scenarios) // (4 * threads)))

    def one(chunk: _Chunk) -> tuple[Sequence[int], dict[str, Any]]:
        figures = chunk.fly(scenarios)
        for steps in figures["steps"] if done is not None else ():
            done(int(steps))  # type: ignore[misc]
        return chunk.places, figures

    if threads > 1 and COMPILED:
        with ThreadPoolExecutor(threads) as pool:
            parts = list(pool.map(one, chunks))
    else:
        parts = [one(chunk) for chunk in chunks]
    return Flights.joined(parts, len(scenarios))


class _Chunk(NamedTuple):
    """Some flights of one course that one compiled call flies; or one at sea.

    Attributes:
        places: among the scenarios.
        example: a flight of their layout; at sea, the flight.
        course: the path.
        configs, which: rows of numbers, and the row of each flight; not used at sea.
    """

    places: Sequence[int]
    example: FlightConfig
    course: Course
    configs: Any
    which: Any

    def fly(self, scenarios: Sequence[Scenario]) -> dict[str, Any]:
        """Return the figures by the names of `Flights`, one row for each flight."""
        flown = [scenarios[place] for place in self.places]
        if flown[0].sea is not None:
            return _at_sea(flown[0], self.course, self.example)
        n, m = len(flown), self.course.path.n
        starts = np.array([scenario.initial or start_of(scenario.path) for scenario in flown], np.float64)
        currents = np.array([scenario.current for scenario in flown], np.float64)
        whole, ends = np.empty((n, tally.FLIGHT_TALLIES)), np.empty((n, tally.ENDS))
        subpaths = np.empty((n, m, tally.SUBPATH_TALLIES))
        ring = max(ring_size(servo_of(scenario.vehicle.rudder)) for scenario in flown)
        with np.errstate(all="ignore"):  # a state that runs away is a result
            fly_many(
                self.example, self.configs, self.which, starts, currents, self.course,
                scratch_of(self.course, ring), whole, subpaths, ends,
            )  # fmt: skip
        dt = np.array([scenario.dt for scenario in flown])
        return figures_of(ends, whole, subpaths, dt)


def _chunks(scenarios: Sequence[Scenario], largest: int) -> list[_Chunk]:
    """Divide scenarios by course and layout; each shared part is turned into numbers once."""
    preparation = Preparation()
    groups: dict[Any, list[tuple[int, int]]] = {}
    for place, scenario in enumerate(scenarios):
        row, layout = preparation.row_of(scenario)
        key = (layout, id(scenario.path)) if scenario.sea is None else place
        groups.setdefault(key, []).append((place, row))
    courses: dict[int, Course] = {}
    chunks = []
    size = max(1, min(largest, _CHUNK))
    for members in groups.values():
        scenario = scenarios[members[0][0]]
        path = scenario.path
        if id(path) not in courses:
            courses[id(path)] = course_of(path)
        course = courses[id(path)]
        example = preparation.flights[members[0][1]]
        different = sorted({row for _, row in members})
        configs = preparation.rows(different) if scenario.sea is None else None
        which = np.searchsorted(different, [row for _, row in members])
        for first in range(0, len(members), size):
            places = [place for place, _ in members[first : first + size]]
            chunks.append(_Chunk(places, example, course, configs, which[first : first + size]))
    return chunks


def compile_once(at_sea: bool = False) -> None:
    """Compile now what the first flight would, for the processes of a pool.

    Args:
        at_sea: whether for flights at sea; else for those without one.
    """
    line = CompositePath([Line(0.0, 0.0, 10.0, 0.0)])
    water = Sea(name="still") if at_sea else None
    fly([Scenario(path=line, vehicle=vehicle.load("remus100"), thrust=1.0, time_limit=0.1, sea=water)])


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
    if scenario.sea is not None and not COMPILED:
        return closed_loop.fly(scenario).select(slice(None, None, every))
    *_, rows = _flown(scenario, course_of(scenario.path), flight_of(scenario), every)
    t = [(topics.FIRST_STAMP_NS + int(k) * scenario.step_ns) * 1e-9 for k in rows[:, track_row.NUMBER]]
    names = track_row.TRACK if scenario.sea is None else (*track_row.TRACK, *TRUTH)
    return Run.from_columns({"t": t} | {name: rows[:, j] for j, name in enumerate(names, 1)})


def _at_sea(scenario: Scenario, course: Course, flight: FlightConfig) -> dict[str, Any]:
    """Return the figures of one flight at sea, one row of each."""
    if not COMPILED:
        return {
            name: np.array([value]) for name, value in judged(closed_loop.fly(scenario), scenario).items()
        }
    whole, subpaths, end, _ = _flown(scenario, course, flight, 0)
    return figures_of(end[None], whole[None], subpaths[None], np.array([scenario.dt]))


def _flown(scenario: Scenario, course: Course, flight: FlightConfig, every: int) -> tuple[Any, Any, Any, Any]:
    """Fly one scenario; return its tallies, those of its subpaths, its end, and every `every`-th row."""
    start = PlantState(*map(float, scenario.initial or start_of(scenario.path)))
    constant = Current(*map(float, scenario.current))
    whole, end = np.empty(tally.FLIGHT_TALLIES), np.empty(tally.ENDS)
    subpaths = np.empty((course.path.n, tally.SUBPATH_TALLIES))
    steps, scratch = _likely_steps(scenario, flight), scratch_of(course)
    while True:
        steps = min(steps, flight.steps)
        kept = np.empty((math.ceil(steps / every) if every else 0, track_row.TRACK_COLUMNS))
        vehicle: Any = flight.plant
        servo, ring = vehicle.servo, np.zeros(max(ring_size(vehicle.servo), 1))
        state: Any = Afloat(start, servo_begin(servo, ring, 0.0, 0.0)[0])
        if scenario.sea is not None:
            draws = Draws(flight.dt, steps, arrays=True)
            vehicle, state = at_sea_of(scenario.vehicle, start, scenario.sea, scenario.seed, draws)
        with np.errstate(all="ignore"):  # a state that runs away is a result
            fly_one(
                flight._replace(steps=steps), vehicle, state, constant, course, scratch,
                whole, subpaths, end, kept, every,
            )  # fmt: skip
        if steps == flight.steps or end[tally.ODOMETRIES] < steps:
            return whole, subpaths, end, kept[: math.ceil(end[tally.ODOMETRIES] / every)] if every else kept
        steps *= 2  # from the start: the same seed gives the same flight


def _likely_steps(scenario: Scenario, flight: FlightConfig) -> int:
    """Return for how many odometries it pays to draw random numbers."""
    if scenario.sea is None:
        return flight.steps
    seconds = 1.1 * scenario.path.length / scenario.vehicle.speed_at(scenario.thrust) + 60.0
    return math.ceil(seconds / flight.dt)


def course_of(path: CompositePath) -> Course:
    """Return a path as compiled code reads it."""
    return Course(rows_of(path), outlines_of(path), cells_of(path))
