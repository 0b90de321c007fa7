"""What is tuned: gains of one plane, hulls and conditions that they are for, margins that they must have."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.own_vehicle.tune import sampled_loop
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace
from auv_sim.own_vehicle.tune.objective import LEAST_DELAY, LEAST_GAIN
from auv_sim.own_vehicle.tune.sampled_loop import LinearPlane, Margins
from auv_sim.own_vehicle.tune.trial_flights import (
    SEARCHED,
    Amount,
    Conditions,
    Flight,
    draw_flights,
    fly_all,
)


class TunedPlane(NamedTuple):
    """The plane in which a vehicle is tuned, seen so that one objective serves both.

    Attributes:
        draw: flights of a hull, see `trial_flights.draw_flights`.
        figures: flights with the figures of the plane in place of the horizontal ones.
        side: the vehicle with the plane's fin as its rudder.
        steering: the plane's autopilot.
    """

    draw: Callable[[Vehicle, Conditions, Amount, np.random.Generator], list[Flight]]
    figures: Callable[[Flights], Flights]
    side: Callable[[Vehicle], Vehicle]
    steering: Callable[[GainSet], AutopilotConfig]


#: Heading, by the rudder.
HEADING = TunedPlane(
    draw_flights, lambda flights: flights, lambda vehicle: vehicle, lambda gains: gains.autopilot
)


class FlownSets(NamedTuple):
    """The same flights with several sets of gains.

    Attributes:
        figures: of each set.
        is_line: which flights are along a line, shape (n,).
        kinds: of the courses, flight by flight, in words; empty on lines.
    """

    figures: list[Flights]
    is_line: npt.NDArray[np.bool_]
    kinds: tuple[str, ...]


class Problem(NamedTuple):
    """What is tuned.

    Attributes:
        space: the gains.
        hulls: the vehicle, and others that it may be.
        conditions: delay, rates, sea.
        seed: of all draws.
        present: gains that the vehicle has, with which found ones are compared too; None without any.
        plane: heading or pitch.
        amount: flights of a generation.
    """

    space: GainSpace
    hulls: Sequence[Vehicle]
    conditions: Conditions
    seed: int
    present: GainSet | None = None
    plane: TunedPlane = HEADING
    amount: Amount = SEARCHED

    def fly(
        self, hull: Vehicle, amount: Amount, stream: Sequence[int], sets: Sequence[GainSet], threads: int,
        courses: Courses,
    ) -> FlownSets:  # fmt: skip
        """Fly one draw on a hull with each of several sets of gains."""
        random = np.random.default_rng([self.seed, *stream])
        flights = self.plane.draw(hull, self.conditions, amount, random)
        found = fly_all(flights, sets, self.space.model, threads, courses)
        return FlownSets(
            [self.plane.figures(figures) for figures in found],
            np.array([flight.is_line for flight in flights]),
            tuple(flight.kind for flight in flights),
        )


class MarginsAsked(NamedTuple):
    """The margins that a candidate must have on one hull; see `objective`."""

    plane: LinearPlane
    delay: float
    step: float
    up: float
    down: float
    later: float


def margins_of(problem: Problem, flown: GainSet, hull: Vehicle) -> Margins:
    """Return the margins of gains on a hull, at the slowest rate."""
    return _margins(problem.space, problem.plane, problem.conditions, flown, hull)


def _margins(
    space: GainSpace, plane: TunedPlane, conditions: Conditions, flown: GainSet, hull: Vehicle
) -> Margins:
    step, side = max(conditions.steps), plane.side(hull)
    delay = conditions.delay + side.rudder.dead_time
    return sampled_loop.margins(sampled_loop.yaw_plane(side), _loop(space, plane, flown, step), step, delay)


@functools.lru_cache(maxsize=64)
def _ruled_margins(space: GainSpace, plane: TunedPlane, conditions: Conditions, hull: Vehicle) -> Margins:
    """Return the margins of the rule's gains: a search asks for them in every generation."""
    return _margins(space, plane, conditions, space.rule(), hull)


def _loop(space: GainSpace, plane: TunedPlane, flown: GainSet, step: float) -> sampled_loop.SampledLoop:
    return sampled_loop.loop_of(plane.steering(flown), plane.side(space.model), step)


def margins_asked(problem: Problem, hull: Vehicle) -> MarginsAsked:
    """Return the margins to ask for: `LEAST_GAIN` and `LEAST_DELAY`, less where the rule has less."""
    step, side = max(problem.conditions.steps), problem.plane.side(hull)
    has = _ruled_margins(problem.space, problem.plane, problem.conditions, hull)
    delay = problem.conditions.delay + side.rudder.dead_time
    return MarginsAsked(
        sampled_loop.yaw_plane(side), delay, step,
        min(LEAST_GAIN, max(0.95 * has.up, 1.0)), min(LEAST_GAIN, max(0.95 * has.down, 1.0)),
        min(LEAST_DELAY * (delay + 0.5 * step), 0.9 * has.delay),
    )  # fmt: skip


def lacking(problem: Problem, asked: MarginsAsked, flown: GainSet) -> float:
    """Return the share of three margins (up, down, delay) that a candidate lacks."""
    loop = _loop(problem.space, problem.plane, flown, asked.step)
    cases = (
        (asked.delay, asked.up),
        (asked.delay, 1.0 / asked.down),
        (asked.delay + asked.later, 1.0),
    )
    failed = [not sampled_loop.is_stable(asked.plane, loop, asked.step, *case) for case in cases]
    return sum(failed) / len(cases)
