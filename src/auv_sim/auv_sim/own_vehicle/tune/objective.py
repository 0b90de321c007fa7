"""The objective of the search, in one number: distance, rudder travel, limit cycles, margins.

Of every hull, on the same flights against a reference, which `reference_of` makes of the rule's gains and
those that the vehicle has at present,

    J = 0.6 mean f(rms/rms_ref) + 0.4 mean f(off/off_ref), with f(x) = ln x + max(ln x, 0)
        + 0.1 mean ln(travel/travel_ref) + the excess of that mean over ln 2
        + 12 mean max(ln(off/off_present), 0)
        + limit cycles + flights that do not complete + margins that are too small

`off` is the rms away from corners. With f a course that becomes worse counts twice. A course that becomes
worse than with the present gains costs more than another kind of course can gain. The objective of several
hulls is that of the worst. Smaller is better; gains that fly like the reference and keep all conditions
have 0.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from auv_sim.flight.batch.flight_figures import Flights

#: Weights of distances and of distances away from corners.
RMS, OFF = 0.6, 0.4
#: Weights of ln(travel), and of what exceeds `FREE_TRAVEL` times that of the reference.
TRAVEL, TOO_MUCH, FREE_TRAVEL = 0.1, 1.0, 2.0
#: Weight of ln(off/off_present) where that is above 0, in the mean of the flights along courses: large enough
#: that no kind of course is traded for another.
BEHIND = 12.0
#: Travel of the reference: a share of that of the present gains, within bounds over that of the rule.
PRESENT_TRAVEL, LEAST_TRAVEL, LARGEST_TRAVEL = 0.65, 0.5, 2.0
#: Rms yaw rate late on a straight line that is a limit cycle, and from which on it costs, deg/s.
LIMIT_CYCLE, RESTLESS = 0.3, 0.1
#: Cost of a limit cycle of `LIMIT_CYCLE`, doubling with each factor of e, and the largest of one flight.
CYCLING, WORST = 1.0, 8.0
#: Cost of a flight that does not complete its course.
LOST = 5.0
#: Smallest margins asked for: gain either way, delay over the loop's own; less where the rule has less.
LEAST_GAIN, LEAST_DELAY = 1.4, 0.35
#: Cost of a loop that is unstable where a margin asks for its stability.
UNSTABLE = 2.0
#: Distance (m) and travel (deg/m) added to both sides of a ratio: differences far below them do not matter.
_RESOLVED, _STILL = 0.01, 0.01


class CostTerms(NamedTuple):
    """The parts of an objective.

    Attributes:
        rms, off: mean f of the ratios to the reference.
        travel: mean ln of the ratio to the reference.
        cycling: of the flights on lines; 0 without a limit cycle.
        lost: of flights that did not complete.
        margins: of the linear loop.
        behind: of flights that are farther from their path off corners than with the present gains; 0
            without any.
    """

    rms: float
    off: float
    travel: float
    cycling: float
    lost: float
    margins: float
    behind: float = 0.0

    @property
    def distance(self) -> float:
        """The part of both distances."""
        return RMS * self.rms + OFF * self.off

    @property
    def total(self) -> float:
        """J."""
        excess = max(self.travel - math.log(FREE_TRAVEL), 0.0)
        penalties = self.cycling + self.lost + self.margins + self.behind
        return self.distance + TRAVEL * self.travel + TOO_MUCH * excess + penalties


def reference_of(ruled: Flights, present: Flights | None) -> Flights:
    """Return what gains are compared with, flight by flight: the smaller distances of two sets of gains.

    Travel is `PRESENT_TRAVEL` of that of the present gains, at least `LEAST_TRAVEL` and at most
    `LARGEST_TRAVEL` times the rule's. A flight that only one of them completed counts with that one.

    Args:
        ruled: figures with the rule's gains.
        present: figures of the same flights with the gains that the vehicle has; None without any.
    """
    if present is None:
        return ruled
    both, lone = ruled.completed & present.completed, present.completed & ~ruled.completed

    def least(name: str) -> Any:
        one, two = getattr(ruled, name), getattr(present, name)
        return np.where(both, np.fmin(one, two), np.where(lone, two, one))

    one, two = ruled.rudder_travel_per_metre, present.rudder_travel_per_metre
    travel = np.clip(PRESENT_TRAVEL * two, LEAST_TRAVEL * one, LARGEST_TRAVEL * one)
    return dataclasses.replace(
        ruled,
        completed=ruled.completed | present.completed,
        rms_distance=least("rms_distance"),
        off_corners_rms_distance=least("off_corners_rms_distance"),
        rudder_travel_per_metre=np.where(both, travel, np.where(lone, two, one)),
    )


def terms_of(
    flown: Flights, reference: Flights, is_line: Any, unstable: float = 0.0, present: Flights | None = None
) -> CostTerms:
    """Return the objective's parts of one hull.

    Args:
        flown, reference: figures of the same flights with the gains, and of `reference_of`.
        is_line: which flights are along a line, shape (n,).
        unstable: share of the margins asked for that the linear loop lacks, 0 to 1.
        present: figures of the same flights with the gains that the vehicle has; None without any.
    """
    along = ~is_line
    finished = along & flown.completed & reference.completed
    pairs = [
        (getattr(flown, name)[finished], getattr(reference, name)[finished])
        for name in ("rms_distance", "off_corners_rms_distance", "rudder_travel_per_metre")
    ]
    return CostTerms(
        distance_cost(*pairs[0]),
        distance_cost(*pairs[1]),
        _mean(_ratio(*pairs[2], _STILL)),
        cycling(flown.late_rms_yaw_rate[is_line]),
        LOST * float(np.sum(along & ~flown.completed)),
        UNSTABLE * unstable,
        0.0 if present is None else behind_cost(flown, present, is_line),
    )


def behind_cost(flown: Flights, present: Flights, is_line: Any) -> float:
    """Return the cost of flights that are farther from their path off corners than with the present gains."""
    both = ~is_line & flown.completed & present.completed
    ratio = _ratio(flown.off_corners_rms_distance[both], present.off_corners_rms_distance[both], _RESOLVED)
    return BEHIND * _mean(np.maximum(ratio, 0.0))


def cycling(rates: Any) -> float:
    """Return the cost of limit cycles, from late rms yaw rates on lines (deg/s); NaN counts as the worst."""
    known = np.where(np.isfinite(rates), np.maximum(rates, 1e-9), math.inf)
    cost = CYCLING * (np.log(known / RESTLESS) / math.log(LIMIT_CYCLE / RESTLESS))
    return float(np.sum(np.clip(cost, 0.0, WORST)))


class Ratios(NamedTuple):
    """Geometric means over the flights along courses, against other gains: rms, off corners, travel."""

    rms: float
    off: float
    travel: float


def ratios_of(flown: Flights, others: Flights, is_line: Any) -> Ratios:
    """Return the ratios of the flights along courses that completed with both.

    Args:
        flown, others: figures of the same flights with the gains and with others.
        is_line: as of `terms_of`.
    """
    both = ~is_line & flown.completed & others.completed
    pairs = (
        (flown.rms_distance, others.rms_distance, _RESOLVED),
        (flown.off_corners_rms_distance, others.off_corners_rms_distance, _RESOLVED),
        (flown.rudder_travel_per_metre, others.rudder_travel_per_metre, _STILL),
    )
    return Ratios(*(math.exp(_mean(_ratio(own[both], other[both], added))) for own, other, added in pairs))


def off_by_kind(flown: Flights, others: Flights, kinds: Sequence[str]) -> dict[str, float]:
    """Return the geometric means of the ratios off corners by kind of course, of flights that completed.

    Args:
        flown, others: figures of the same flights with the gains and with others.
        kinds: of the courses, flight by flight; empty on lines, which do not count.
    """
    both = flown.completed & others.completed
    ratio = _ratio(flown.off_corners_rms_distance, others.off_corners_rms_distance, _RESOLVED)
    names = np.asarray(kinds)
    return {name: math.exp(_mean(ratio[(names == name) & both])) for name in dict.fromkeys(kinds) if name}


def distance_cost(flown: Any, reference: Any) -> float:
    """Return the mean f of the ratios of distances (m); 0 without any."""
    ratio = _ratio(flown, reference, _RESOLVED)
    return _mean(ratio + np.maximum(ratio, 0.0))


def _ratio(flown: Any, others: Any, added: float) -> Any:
    return np.log((flown + added) / (others + added))


def _mean(values: Any) -> float:
    known = values[np.isfinite(values)]
    return float(np.mean(known)) if known.size else 0.0


def worst(totals: list[float]) -> float:
    """Return the objective of several hulls: that of the worst."""
    return max(totals)
