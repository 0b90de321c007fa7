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
from auv_path_following import vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import tally, track_row
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.flight.batch.compiled_flight import (
    Course,
    FlightConfig,
    fly_alone,
    fly_many,
    scratch_of,
)
from auv_sim.flight.batch.config_rows import flat
from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.flight.batch.judge import judged
from auv_sim.flight.batch.kinds.chosen import start_from
from auv_sim.flight.batch.kinds.kind_figures import figures_by, tallies_of
from auv_sim.flight.batch.scenarios import (
    Courses,
    Preparation,
    current_row,
    flight_of,
    rings_of,
    start_row,
)
from auv_sim.flight.run_record import Run
from auv_sim.flight.scenario import Scenario
from auv_sim.flight.signals import SPATIAL_TRUTH, TRUTH
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
from auv_sim.vehicle.draws import Draws
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.simulated import SimulatedVehicle

#: Flights of one compiled call.
_CHUNK = 64
#: Odometries of one compiled call, about: Ctrl-C waits for the end of a call.
_ODOMETRIES = 100_000
_NO_TRACK = np.empty((0, 0))

Done = Callable[[int], None]


def fly(
    scenarios: Sequence[Scenario], threads: int = 1, done: Done | None = None, courses: Courses | None = None
) -> Flights:
    """Fly all scenarios.

    Args:
        scenarios: what to fly.
        threads: flights at the same time; more than one is faster where `compiled.COMPILED`.
        done: called with the number of odometries of each flight, after it, from any thread.
        courses: of earlier calls, for paths that are flown again.

    Returns:
        One row for each scenario, in their order.

    Raises:
        ConfigurationError: a scenario that cannot be flown; before the first flight.
    """
    chunks = _chunks(scenarios, -(-len(scenarios) // (4 * threads)), courses or Courses())

    def one(chunk: _Chunk) -> tuple[Sequence[int], dict[str, Any]]:
        figures = chunk.fly(scenarios)
        for steps in figures["steps"] if done is not None else ():
            done(int(steps))  # type: ignore[misc]
        return chunk.places, figures

    if threads > 1 and COMPILED:
        pool = ThreadPoolExecutor(threads)
        try:
            parts = list(pool.map(one, chunks))
        finally:  # a thread that compiles cannot be stopped: Ctrl-C does not wait for it
            pool.shutdown(wait=False, cancel_futures=True)
    else:
        parts = [one(chunk) for chunk in chunks]
    return Flights.joined(parts, len(scenarios))


class _Chunk(NamedTuple):
    """Some flights of one course that one compiled call flies; or one at sea.

    Attributes:
        places: among the scenarios.
        example: a flight of their layout; at sea, the flight.
        path, course: what they follow, and as compiled code reads it.
        configs, which: rows of numbers, and the row of each flight; not used at sea.
    """

    places: Sequence[int]
    example: FlightConfig
    path: CompositePath | SpatialPath
    course: Course
    configs: Any
    which: Any

    def fly(self, scenarios: Sequence[Scenario]) -> dict[str, Any]:
        """Return the figures by the names of `Flights`, one row for each flight."""
        flown = [scenarios[place] for place in self.places]
        if flown[0].sea is not None:
            return _at_sea(flown[0], self.path, self.course, self.example)
        starts = np.array([start_row(scenario, self.path) for scenario in flown])
        currents = np.array([current_row(scenario) for scenario in flown])
        whole, subpaths, ends = tallies_of(len(flown), self.path)
        ring = max(rings_of(scenario) for scenario in flown)
        with np.errstate(all="ignore"):  # a state that runs away is a result
            fly_many(
                self.example, self.configs, self.which, starts, currents, self.course,
                scratch_of(self.course, ring), whole, subpaths, ends, _NO_TRACK, 0,
            )  # fmt: skip
        dt = np.array([scenario.dt for scenario in flown])
        return figures_by(self.path)(ends, whole, subpaths, dt)


def _chunks(scenarios: Sequence[Scenario], largest: int, courses: Courses) -> list[_Chunk]:
    """Divide scenarios by course and layout; each shared part is turned into numbers once."""
    preparation = Preparation()
    groups: dict[Any, list[tuple[int, int]]] = {}
    for place, scenario in enumerate(scenarios):
        row, layout = preparation.row_of(scenario)
        course, _ = courses.of(scenario)
        key = (layout, id(course)) if scenario.sea is None else place
        groups.setdefault(key, []).append((place, row))
    chunks = []
    for members in groups.values():
        scenario = scenarios[members[0][0]]
        course, path = courses.of(scenario)
        example = preparation.flights[members[0][1]]
        different = sorted({row for _, row in members})
        configs = preparation.rows(different) if scenario.sea is None else None
        longest = max(preparation.flights[row].steps for row in different)
        size = max(1, min(largest, _CHUNK, _ODOMETRIES // longest))
        which = np.searchsorted(different, [row for _, row in members])
        for first in range(0, len(members), size):
            places = [place for place, _ in members[first : first + size]]
            chunks.append(_Chunk(places, example, path, course, configs, which[first : first + size]))
    return chunks


def compile_once(at_sea: bool = False, dives: bool = False) -> None:
    """Compile now what the first flight would, for the processes of a pool.

    Args:
        at_sea: whether for flights at sea; else for those without one.
        dives: whether for vehicles that dive.
    """
    line = CompositePath([Line(0.0, 0.0, 10.0, 0.0)])
    water = Sea(name="still") if at_sea else None
    hull = vehicle.load("remus100_6dof" if dives else "remus100")
    fly([Scenario(path=line, vehicle=hull, thrust=6.48, time_limit=0.1, sea=water)])


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
    course, path = Courses().of(scenario)
    _, rows = _flown(scenario, path, course, flight_of(scenario), every)
    t = [(topics.FIRST_STAMP_NS + int(k) * scenario.step_ns) * 1e-9 for k in rows[:, track_row.NUMBER]]
    names: tuple[str, ...] = track_row.TRACK
    truth: tuple[str, ...] = TRUTH
    if scenario.vehicle.dives:
        names, truth = track_row.SPATIAL_TRACK, SPATIAL_TRUTH
    kept = names if scenario.sea is None else (*names, *truth)
    return Run.from_columns({"t": t} | {name: rows[:, j] for j, name in enumerate(kept, 1)})


def _at_sea(
    scenario: Scenario, path: CompositePath | SpatialPath, course: Course, flight: FlightConfig
) -> dict[str, Any]:
    """Return the figures of one flight at sea, one row of each."""
    if not COMPILED:
        return {
            name: np.array([value]) for name, value in judged(closed_loop.fly(scenario), scenario).items()
        }
    (whole, subpaths, ends), _ = _flown(scenario, path, course, flight, 0)
    return figures_by(path)(ends, whole, subpaths, np.array([scenario.dt]))


def _flown(
    scenario: Scenario, path: CompositePath | SpatialPath, course: Course, flight: FlightConfig, every: int
) -> tuple[Any, Any]:
    """Fly one scenario; return its tallies as `tallies_of`, and every `every`-th row."""
    tallies = tallies_of(1, path)
    whole, subpaths, end = (one[0] for one in tallies)
    row, water = start_row(scenario, path), current_row(scenario)
    columns = track_row.SPATIAL_TRACK_COLUMNS if scenario.vehicle.dives else track_row.TRACK_COLUMNS
    kind = SimulatedDiver.kind if scenario.vehicle.dives else SimulatedVehicle.kind
    steps, scratch = _likely_steps(scenario, flight), scratch_of(course, rings_of(scenario))
    while True:
        steps = min(steps, flight.steps)
        kept = np.empty((math.ceil(steps / every) if every else 0, columns))
        with np.errstate(all="ignore"):  # a state that runs away is a result
            if scenario.sea is None:
                fly_many(
                    flight, np.array([flat(flight)]), np.zeros(1, np.int64), np.array([row]),
                    np.array([water]), course, scratch, *tallies, kept, every,
                )  # fmt: skip
            else:
                state, constant = start_from(flight.plant, row, water, scratch.ring)
                vehicle, state = kind.at_sea_of(
                    scenario.plant_vehicle, state.hull, scenario.sea, scenario.seed,
                    Draws(flight.dt, steps, arrays=True),
                )  # fmt: skip
                fly_alone(
                    flight._replace(steps=steps), vehicle, state, constant, course, scratch,
                    whole, subpaths, end, kept, every,
                )  # fmt: skip
        if steps == flight.steps or end[tally.ODOMETRIES] < steps:
            return tallies, kept[: math.ceil(end[tally.ODOMETRIES] / every)] if every else kept
        steps *= 2  # from the start: the same seed gives the same flight


def _likely_steps(scenario: Scenario, flight: FlightConfig) -> int:
    """Return for how many odometries it pays to draw random numbers."""
    if scenario.sea is None:
        return flight.steps
    seconds = 1.1 * scenario.path.length / scenario.vehicle.speed_at(scenario.thrust) + 60.0
    return math.ceil(seconds / flight.dt)
