"""Which gains a vehicle gets: found ones only after courses, starts and seas that the search never saw."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.own_vehicle.tune.gain_space import GainSet, Vector
from auv_sim.own_vehicle.tune.objective import (
    LIMIT_CYCLE,
    CostTerms,
    Ratios,
    off_by_kind,
    ratios_of,
    terms_of,
)
from auv_sim.own_vehicle.tune.sampled_loop import Margins
from auv_sim.own_vehicle.tune.search import Found
from auv_sim.own_vehicle.tune.trial_flights import HELD_OUT, Amount
from auv_sim.own_vehicle.tune.tuning_problem import Problem, lacking, margins_asked, margins_of

#: Where the gains found are not accepted, mixtures are tried in turn, each on flights of its own: a share of
#: the way from them to the present gains, then shares of the way from the rule's gains to them.
BACK, SHARES = 0.5, (0.85, 0.6, 0.3)
#: Largest travel of the rudder over that of the rule and over that of the present gains, whichever is more,
#: mean of the held-out flights.
MOST_TRAVEL = 1.5
#: Largest distance away from corners over that of the present gains, of each kind of course.
MOST_BEHIND = 1.05
#: Where the gains of a verdict come from.
FOUND, PRESENT, RULE = "found", "present", "rule"


class Held(NamedTuple):
    """Held-out flights of one hull, with gains, with the rule's and with those that the vehicle has.

    Attributes:
        terms: the objective's parts, against the rule.
        ratios: to the rule.
        unrest, ruled_unrest: largest late rms yaw rate on lines, deg/s.
        flights: how many.
        lost: how many did not complete their course.
        present: the present gains; None without any.
    """

    terms: CostTerms
    ratios: Ratios
    unrest: float
    ruled_unrest: float
    flights: int
    lost: int
    present: HeldPresent | None = None


class HeldPresent(NamedTuple):
    """The same flights with the present gains.

    Attributes:
        terms: the parts of the objective of the present gains, against the rule.
        ratios: of the gains to the present ones.
        unrest: as of `Held`.
        by_kind: ratios off corners of the gains to the present ones, of each kind of course.
    """

    terms: CostTerms
    ratios: Ratios
    unrest: float
    by_kind: Mapping[str, float]

    @property
    def worst_kind(self) -> tuple[float, str]:
        """The largest ratio off corners, and its kind of course."""
        return max(((ratio, kind) for kind, ratio in self.by_kind.items()), default=(0.0, ""))

    @property
    def holds(self) -> bool:
        """Whether the present gains keep all conditions: no limit cycle, all courses completed, margins."""
        return self.unrest <= LIMIT_CYCLE and self.terms.lost == 0.0 and self.terms.margins == 0.0


class GainVerdict(NamedTuple):
    """What the held-out flights say.

    Attributes:
        source: `FOUND`, `PRESENT` or `RULE`.
        gains: what the vehicle gets.
        mixed: the mixture that was accepted, in words; empty for the gains as found, and where none is.
        point: of the gains found; the rule's where they are not accepted.
        why: reasons against the gains found, in words; empty for none.
        held: of each hull, with the gains found.
        margins: of the vehicle itself, with `gains`.
    """

    source: str
    gains: GainSet
    mixed: str
    point: Vector
    why: tuple[str, ...]
    held: tuple[Held, ...]
    margins: Margins

    @property
    def accepted(self) -> bool:
        """Whether the vehicle gets gains that were found."""
        return self.source == FOUND


def judge(problem: Problem, found: Found, threads: int, amount: Amount = HELD_OUT) -> GainVerdict:
    """Fly the held-out flights with the gains found, then with mixtures of them; see `BACK` and `SHARES`.

    Gains that are behind the present ones are accepted only where those do not keep the conditions.
    """
    space, vehicle = problem.space, problem.space.model
    reasons: list[str] = []
    flown: list[tuple[Held, ...]] = []
    behind: list[GainVerdict] = []
    for attempt, (mixed, point) in enumerate(_attempts(problem, found.point)):
        gains = space.gains(point)
        flown.append(tuple(hold_out(problem, gains, (1, attempt), threads, amount)))
        against, lag = reasons_against(flown[-1]), reasons_behind(flown[-1])
        margins = margins_of(problem, gains, vehicle)
        verdict = GainVerdict(FOUND, gains, mixed, point, tuple(reasons), flown[-1], margins)
        if not against and not lag:
            return verdict
        if not against:
            behind.append(verdict)
        reasons.extend(f"{mixed or 'as found'}: {reason}" for reason in against + lag)
    present = flown[0][0].present
    may_stay = all(one.present is not None and one.present.holds for one in flown[0])
    if behind and not may_stay:
        return min(behind, key=_off_present)._replace(why=tuple(reasons))
    stays, gains = RULE, space.rule()
    if may_stay and problem.present is not None and present is not None and present.terms.distance < 0.0:
        stays, gains = PRESENT, problem.present
    margins = margins_of(problem, gains, vehicle)
    return GainVerdict(stays, gains, "", space.first, tuple(reasons), flown[0], margins)


def _attempts(problem: Problem, found: Vector) -> Iterator[tuple[str, Vector]]:
    """Yield the points to try in turn, each with the words of `GainVerdict.mixed`."""
    space, present = problem.space, problem.present
    yield "", found
    if present is not None and problem.plane.steering(present).controller == "nism":
        yield (
            f"{100 * BACK:.0f} % of the way back to the present gains",
            found + BACK * (space.point_of(present) - found),
        )
    for share in SHARES:
        yield f"{100 * share:.0f} % of the way from the rule", space.first + share * (found - space.first)


def _off_present(verdict: GainVerdict) -> float:
    """Return the largest ratio off corners to the present gains, of all kinds of course."""
    present = verdict.held[0].present
    return 0.0 if present is None else present.worst_kind[0]


def hold_out(
    problem: Problem, gains: GainSet, stream: Sequence[int], threads: int, amount: Amount
) -> list[Held]:
    """Fly one set of held-out flights on each hull."""
    rule, courses, held = problem.space.rule(), Courses(), []
    sets = [gains, rule] if problem.present is None else [gains, rule, problem.present]
    for k, hull in enumerate(problem.hulls):
        found, is_line, kinds = problem.fly(hull, amount, (*stream, k), sets, threads, courses)
        flown, ruled, *others = found
        asked = margins_asked(problem, hull)
        present = None
        if problem.present is not None:
            lacks = lacking(problem, asked, problem.present)
            present = HeldPresent(
                terms_of(others[0], ruled, is_line, lacks), ratios_of(flown, others[0], is_line),
                unrest(others[0], is_line), off_by_kind(flown, others[0], kinds),
            )  # fmt: skip
        held.append(
            Held(
                terms_of(flown, ruled, is_line, lacking(problem, asked, gains)),
                ratios_of(flown, ruled, is_line),
                unrest(flown, is_line),
                unrest(ruled, is_line),
                len(is_line),
                int(np.sum(~is_line & ~flown.completed)),
                present,
            )
        )
    return held


def unrest(flown: Flights, is_line: np.ndarray) -> float:
    """Return the largest late rms yaw rate on lines, deg/s; infinite where a flight ended before."""
    rates = flown.late_rms_yaw_rate[is_line]
    return float(np.max(np.where(np.isfinite(rates), rates, math.inf), initial=0.0))


def reasons_against(held: Sequence[Held]) -> list[str]:
    """Return why gains are not accepted, from held-out flights of each hull; empty where they are.

    That they are behind the present gains is the matter of `reasons_behind`.
    """
    reasons = []
    worst = max(held, key=lambda one: one.unrest)
    if worst.unrest > LIMIT_CYCLE:
        reasons.append(f"a limit cycle of {worst.unrest:.2f} deg/s on a straight line")
    lost = sum(one.lost for one in held)
    if lost:
        reasons.append(f"{lost} flights that did not complete their course")
    if any(one.terms.margins > 0.0 for one in held):
        reasons.append("margins of the linear loop below those asked for")
    travel = max(
        min(one.ratios.travel, math.inf if one.present is None else one.present.ratios.travel) for one in held
    )
    most = MOST_TRAVEL if all(one.present is not None for one in held) else 2.0 * MOST_TRAVEL
    if travel > most:
        reasons.append(f"{travel:.1f} times the rudder travel, more than {most:g}")
    distance = max(one.terms.distance for one in held)
    if distance >= 0.0 and not _cures(held):
        reasons.append("no less distance than with the rule")
    return reasons


def reasons_behind(held: Sequence[Held]) -> list[str]:
    """Return why the present gains of the vehicle itself, the first hull, are better; empty for none."""
    present = held[0].present
    if present is None or present.worst_kind[0] <= MOST_BEHIND:
        return []
    cycling = ", which have a limit cycle" if present.unrest > LIMIT_CYCLE else ""
    ratio, kind = present.worst_kind
    return [f"{ratio:.2f} times the distance off corners of the present gains on {kind}{cycling}"]


def _cures(held: Sequence[Held]) -> bool:
    """Return whether the gains remove a limit cycle that the rule has: then distance may be the price."""
    ruled, own = max(one.ruled_unrest for one in held), max(one.unrest for one in held)
    return ruled > LIMIT_CYCLE >= own
