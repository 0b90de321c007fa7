"""The campaign behind the sentence: flights in the sea, on hulls within their uncertainty, and bounds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.prove.confidence import SHARE, largest_share, most_of
from auv_sim.own_vehicle.tune.ensemble import ensemble
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.objective import LIMIT_CYCLE
from auv_sim.own_vehicle.tune.trial_flights import (
    Amount,
    Conditions,
    Flight,
    draw_flights,
    draw_sea_flights,
    with_laws,
)

Numbers = npt.NDArray[np.float64]

#: Hulls drawn; the flights take them in turn.
HULLS = 50
#: Stream of the draws: no search and no acceptance uses it.
_STREAM = 7


class Proposition(NamedTuple):
    """What is to be proven.

    Attributes:
        vehicle: as its file has it; gains and guidance assume it.
        conditions: delay, rates, sea.
        spread: half width of the uncertainty of coefficients, fin rate and dead time, a share.
        own: half widths of single coefficients, shares.
        flights: along courses in the sea; as many on lines.
        within: largest distance away from corners that is good enough, m.
        seed: of all draws.
    """

    vehicle: Vehicle
    conditions: Conditions
    spread: float
    own: Mapping[str, float]
    flights: int
    within: float
    seed: int


class Proof(NamedTuple):
    """What the flights say of one set of gains.

    Attributes:
        off, whole, rms: largest true distance of each flight away from corners and anywhere, and its rms, m;
            infinite where it did not complete.
        unrest: late rms yaw rate of each flight on a line, deg/s.
        travel: mean travel of the rudder in the sea, deg/m.
        lost: flights that did not complete their course.
    """

    off: Numbers
    whole: Numbers
    rms: Numbers
    unrest: Numbers
    travel: float
    lost: int

    @property
    def cycles(self) -> int:
        """Flights on lines with a limit cycle."""
        return int(np.sum(~(self.unrest <= LIMIT_CYCLE)))

    @property
    def off_bound(self) -> float:
        """What 99 % of the flights keep away from corners at 95 % confidence, m."""
        return most_of(self.off)

    @property
    def whole_bound(self) -> float:
        """The same anywhere on the course, m."""
        return most_of(self.whole)

    @property
    def cycle_bound(self) -> float:
        """Largest share of starts with a limit cycle, at 95 % confidence."""
        return largest_share(self.cycles, len(self.unrest))

    def holds(self, within: float) -> bool:
        """Return whether 99 % keep `within` (m) away from corners, 99 % of starts without limit cycle."""
        return self.off_bound <= within and self.cycle_bound <= 1.0 - SHARE


def draw_claim(claim: Proposition) -> list[Flight]:
    """Draw all flights of a claim: in the sea along courses, then on lines."""
    random = np.random.default_rng([claim.seed, _STREAM])
    members = HULLS if claim.spread > 0.0 or claim.own else 1
    hulls = ensemble(claim.vehicle, members, claim.spread, random, claim.own)
    flights: list[Flight] = []
    lines: list[Flight] = []
    each = math.ceil(claim.flights / len(hulls))
    rates = len(claim.conditions.steps)
    for hull in hulls:
        flights += draw_sea_flights(hull, claim.conditions, each, random)
        amount = Amount(starts=math.ceil(each / rates), courses=0, legs=0, at_sea=0)
        lines += draw_flights(hull, claim.conditions, amount, random)
    return [*flights[: claim.flights], *lines[: claim.flights]]


def fly_proof(
    claim: Proposition, flights: list[Flight], gains: GainSet, threads: int,
    done: Callable[[int], Any] | None = None,
) -> Proof:  # fmt: skip
    """Fly the flights of a claim with one set of gains.

    Args:
        claim: what is to be proven.
        flights: of `draw_claim`.
        gains: to fly with.
        threads: flights at the same time.
        done: called after each flight.
    """
    scenarios: list[Scenario] = [with_laws(flight, gains, claim.vehicle) for flight in flights]
    found = engine.fly(scenarios, threads, done, Courses())
    is_line = np.array([flight.is_line for flight in flights])
    along = ~is_line
    completed = found.completed[along]

    def of_completed(values: Numbers) -> Numbers:
        return np.where(completed, values[along], math.inf)

    return Proof(
        of_completed(found.off_corners_largest_distance),
        of_completed(found.largest_distance),
        of_completed(found.rms_distance),
        found.late_rms_yaw_rate[is_line],
        float(np.nanmean(found.rudder_travel_per_metre[along])),
        int(np.sum(~completed)),
    )
