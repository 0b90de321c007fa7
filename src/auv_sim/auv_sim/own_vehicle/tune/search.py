"""The search: CMA-ES over the dimensionless gains, with flights drawn anew in each generation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.own_vehicle.tune.gain_space import GainSet, Vector
from auv_sim.own_vehicle.tune.objective import CostTerms, reference_of, terms_of, worst
from auv_sim.own_vehicle.tune.trial_flights import Amount
from auv_sim.own_vehicle.tune.tuning_problem import Problem, lacking, margins_asked

#: First step of the search, in logarithms of the ratios.
FIRST_STEP = 0.25
#: Candidates of a generation.
POPULATION = 14
#: Streams of the draws: generations, and the flights that choose where the search begins.
_GENERATIONS, _BEGINNING = 0, 4
#: Hulls of an ensemble that a generation flies besides the vehicle itself; others follow in the next ones.
DRAWN_HULLS = 2


class Budget(NamedTuple):
    """Size of a search: generations, candidates of each, threads."""

    generations: int
    population: int = POPULATION
    threads: int = 2


class Found(NamedTuple):
    """The result of a search.

    Attributes:
        point: mean of the last generation.
        history: mean objective of the better half of each generation.
    """

    point: Vector
    history: tuple[float, ...]


def assess(
    problem: Problem, candidates: Sequence[GainSet], amount: Amount, stream: Sequence[int],
    hulls: Sequence[Vehicle], threads: int, courses: Courses,
) -> list[list[CostTerms]]:  # fmt: skip
    """Fly candidates on hulls, with flights of their own draw; return the terms by candidate and hull.

    Args:
        problem: what is tuned.
        candidates: gains.
        amount: of flights.
        stream: place of the draw: the same place draws the same flights.
        hulls: plants.
        threads: flights at the same time.
        courses: for paths that are flown again.
    """
    rule = problem.space.rule()
    others = [rule] if problem.present is None else [rule, problem.present]
    terms: list[list[CostTerms]] = [[] for _ in candidates]
    for k, hull in enumerate(hulls):
        found, is_line, _ = problem.fly(hull, amount, (*stream, k), [*candidates, *others], threads, courses)
        flown, (ruled, *present) = found[: len(candidates)], found[len(candidates) :]
        with_present = present[0] if present else None
        reference = reference_of(ruled, with_present)
        asked = margins_asked(problem, hull)
        for own, candidate, figures in zip(terms, candidates, flown, strict=True):
            lacks = lacking(problem, asked, candidate)
            own.append(terms_of(figures, reference, is_line, lacks, with_present))
    return terms


def search(problem: Problem, budget: Budget, done: Callable[[float], Any] | None = None) -> Found:
    """Search from the rule's gains, or from the present ones where those are better.

    Args:
        problem: what is tuned.
        budget: how long.
        done: called with the objective of each generation.
    """
    import cma

    space, begin = problem.space, beginning(problem, budget.threads)
    low, high = space.bounds()
    options = {
        "bounds": [(low - begin).tolist(), (high - begin).tolist()],
        "popsize": budget.population, "seed": problem.seed + 1, "verbose": -9, "verb_disp": 0, "verb_log": 0,
        "maxiter": budget.generations, "tolfun": 0.0, "tolfunhist": 0.0, "tolx": 0.0, "tolstagnation": 10**9,
        "tolflatfitness": 10**9,
    }  # fmt: skip
    strategy = cma.CMAEvolutionStrategy(np.zeros(len(low)), FIRST_STEP, options)
    history = []
    for generation in range(budget.generations):
        points = strategy.ask()
        gains = [space.gains(begin + point) for point in points]
        hulls = hulls_of(problem, generation)
        # Courses are drawn anew: those of earlier generations are not kept.
        stream = (_GENERATIONS, generation)
        terms = assess(problem, gains, problem.amount, stream, hulls, budget.threads, Courses())
        costs = [worst([one.total for one in own]) for own in terms]
        strategy.tell(points, costs)
        history.append(float(np.mean(sorted(costs)[: max(len(costs) // 2, 1)])))
        if done is not None:
            done(history[-1])
    mean = np.asarray(strategy.result.xfavorite, float)
    return Found(begin + (mean if np.isfinite(mean).all() else 0.0), tuple(history))


def beginning(problem: Problem, threads: int) -> Vector:
    """Return where the search begins: the best of the rule's point, that of the present gains, and between.

    Present gains of another law than NISM have no point.
    """
    space, present = problem.space, problem.present
    if present is None or problem.plane.steering(present).controller != "nism":
        return space.first
    other = space.point_of(present)
    points = [space.first, 0.5 * (space.first + other), other]
    gains = [space.gains(point) for point in points]
    terms = assess(problem, gains, problem.amount, (_BEGINNING,), [space.model], threads, Courses())
    return points[int(np.argmin([worst([one.total for one in own]) for own in terms]))]


def hulls_of(problem: Problem, generation: int) -> list[Vehicle]:
    """Return the hulls that a generation flies: the vehicle itself, and some of the others in turn."""
    first, *others = problem.hulls
    if not others:
        return [first]
    n = min(DRAWN_HULLS, len(others))
    begin = generation * n % len(others)
    return [first, *[others[(begin + k) % len(others)] for k in range(n)]]
