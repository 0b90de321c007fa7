"""The campaign behind the sentence: flights in the sea, on hulls within their uncertainty, and bounds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.prove.confidence import SHARE, largest_share, most_of
from auv_sim.own_vehicle.tune.ensemble import Factors, drawn_hulls
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.objective import LIMIT_CYCLE
from auv_sim.own_vehicle.tune.trial_flights import (
    Conditions,
    Flight,
    draw_sea_flights,
    draw_starts,
    with_laws,
)

Numbers = npt.NDArray[np.float64]

#: Stream of the draws: no search and no acceptance uses it.
_STREAM = 7


class Proposition(NamedTuple):
    """What is to be proven.

    Attributes:
        vehicle: as its file has it; gains and guidance assume it.
        conditions: delay, rates, sea.
        spread: half width of the uncertainty of coefficients, fin rate and dead time, a share.
        own: factors of single numbers, as the vehicle file states them.
        flights: along courses in the sea; as many on lines.
        within: largest distance away from corners that is good enough, m.
        seed: of all draws.
    """

    vehicle: Vehicle
    conditions: Conditions
    spread: float
    own: Mapping[str, Factors]
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
    """Draw all flights of a claim: in the sea along courses, then on lines.

    With a spread each flight along a course has a hull of its own, and so has each on a line: a bound over
    flights on few hulls would not hold for other hulls.
    """
    random = np.random.default_rng([claim.seed, _STREAM])
    hulls: Sequence[Vehicle] = [claim.vehicle] * claim.flights
    if claim.spread > 0.0 or claim.own:
        hulls = drawn_hulls(claim.vehicle, claim.flights, claim.spread, random, claim.own)
    sea_flights = draw_sea_flights(hulls, claim.conditions, random)
    return [*sea_flights, *draw_starts(hulls, claim.conditions, random)]


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
