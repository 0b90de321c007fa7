"""Whether found gains replace the rule's: only after courses, starts and seas that the search never saw."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.own_vehicle.tune.gain_space import GainSet, Vector
from auv_sim.own_vehicle.tune.objective import LIMIT_CYCLE, CostTerms, Ratios, ratios_of, terms_of
from auv_sim.own_vehicle.tune.sampled_loop import Margins
from auv_sim.own_vehicle.tune.search import Found, Problem, lacking, margins_asked, margins_of
from auv_sim.own_vehicle.tune.trial_flights import HELD_OUT, Amount, draw_flights, fly_all

#: Shares of the way from the rule's gains to those found; the first that is accepted counts. Each has flights
#: of its own.
SHARES = (1.0, 0.6, 0.3)
#: Largest travel of the rudder over that of the rule, mean of the held-out flights.
MOST_TRAVEL = 3.0


class Held(NamedTuple):
    """Held-out flights of one hull, with gains and with the rule's.

    Attributes:
        terms: the objective's parts.
        ratios: to the rule.
        unrest, ruled_unrest: largest late rms yaw rate on lines, deg/s.
        flights: how many.
        lost: how many did not complete their course.
    """

    terms: CostTerms
    ratios: Ratios
    unrest: float
    ruled_unrest: float
    flights: int
    lost: int


class GainVerdict(NamedTuple):
    """What the held-out flights say.

    Attributes:
        accepted: whether the gains replace the rule's.
        share: of the way from the rule's gains to those found; 0 where nothing is accepted.
        point: the gains; the rule's where nothing is accepted.
        why: reasons against the gains found, in words; empty for none.
        held: of each hull.
        margins: of the vehicle itself, with the gains found and with the rule's.
    """

    accepted: bool
    share: float
    point: Vector
    why: tuple[str, ...]
    held: tuple[Held, ...]
    margins: Margins
    ruled_margins: Margins


def judge(problem: Problem, found: Found, threads: int, amount: Amount = HELD_OUT) -> GainVerdict:
    """Fly the held-out flights with the gains found, or with a share of the way to them."""
    space, vehicle = problem.space, problem.space.vehicle
    reasons: list[str] = []
    held: tuple[Held, ...] = ()
    ruled = margins_of(space.rule(), vehicle, vehicle, problem.conditions)
    for attempt, share in enumerate(SHARES):
        point = space.first + share * (found.point - space.first)
        gains = space.gains(point)
        own = tuple(hold_out(problem, gains, (1, attempt), threads, amount))
        against = reasons_against(own)
        if not reasons or not against:
            held = own
        margins = margins_of(gains, vehicle, vehicle, problem.conditions)
        if not against:
            return GainVerdict(True, share, point, tuple(reasons), held, margins, ruled)
        reasons.extend(f"{100 * share:.0f} % of the way: {reason}" for reason in against)
    return GainVerdict(False, 0.0, space.first, tuple(reasons), held, ruled, ruled)


def hold_out(
    problem: Problem, gains: GainSet, stream: Sequence[int], threads: int, amount: Amount
) -> list[Held]:
    """Fly one set of held-out flights on each hull."""
    space, courses, held = problem.space, Courses(), []
    for k, hull in enumerate(problem.hulls):
        random = np.random.default_rng([problem.seed, *stream, k])
        flights = draw_flights(hull, problem.conditions, amount, random)
        is_line = np.array([flight.is_line for flight in flights])
        flown, ruled = fly_all(flights, [gains, space.rule()], space.vehicle, threads, courses)
        asked = margins_asked(space, hull, problem.conditions)
        terms = terms_of(flown, ruled, is_line, lacking(asked, gains, space.vehicle))
        lost = int(np.sum(~is_line & ~flown.completed))
        held.append(
            Held(
                terms,
                ratios_of(flown, ruled, is_line),
                unrest(flown, is_line),
                unrest(ruled, is_line),
                len(flights),
                lost,
            )
        )
    return held


def unrest(flown: Flights, is_line: np.ndarray) -> float:
    """Return the largest late rms yaw rate on lines, deg/s; infinite where a flight ended before."""
    rates = flown.late_rms_yaw_rate[is_line]
    return float(np.max(np.where(np.isfinite(rates), rates, math.inf), initial=0.0))


def reasons_against(held: Sequence[Held]) -> list[str]:
    """Return why gains are not accepted, from held-out flights of each hull; empty where they are."""
    reasons = []
    worst = max(held, key=lambda one: one.unrest)
    if worst.unrest > LIMIT_CYCLE:
        reasons.append(f"a limit cycle of {worst.unrest:.2f} deg/s on a straight line")
    lost = sum(one.lost for one in held)
    if lost:
        reasons.append(f"{lost} flights that did not complete their course")
    if any(one.terms.margins > 0.0 for one in held):
        reasons.append("margins of the linear loop below those asked for")
    travel = max(one.ratios.travel for one in held)
    if travel > MOST_TRAVEL:
        reasons.append(f"{travel:.1f} times the rudder travel of the rule, more than {MOST_TRAVEL:g}")
    distance = max(one.terms.distance for one in held)
    if distance >= 0.0 and not _cures(held):
        reasons.append("no less distance than with the rule")
    return reasons


def _cures(held: Sequence[Held]) -> bool:
    """Return whether the gains remove a limit cycle that the rule has: then distance may be the price."""
    ruled, own = max(one.ruled_unrest for one in held), max(one.unrest for one in held)
    return ruled > LIMIT_CYCLE >= own
