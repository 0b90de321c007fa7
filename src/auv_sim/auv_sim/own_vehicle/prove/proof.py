"""The campaign behind the sentence: flights in seas, on hulls within their uncertainty, and bounds."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.prove.confidence import SHARE, largest_share, most_of
from auv_sim.own_vehicle.prove.drawn_dives import with_depths
from auv_sim.own_vehicle.tune.ensemble import Factors, check_delay, drawn_hulls
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.objective import LIMIT_CYCLE
from auv_sim.own_vehicle.tune.trial_flights import (
    LATER,
    Conditions,
    Flight,
    draw_sea_flights,
    draw_starts,
    with_laws,
)
from auv_sim.vehicle.sea import Sea

Numbers = npt.NDArray[np.float64]

#: Streams of the draws: no search and no acceptance uses them. The second is for depths.
_STREAM, _DEPTHS = 7, 8


class Proposition(NamedTuple):
    """What is to be proven.

    Attributes:
        vehicle: as its file has it; gains and guidance assume it.
        conditions: delay, rates; its sea is the first of `seas`.
        seas: in each of them all courses are flown.
        spread: half width of the uncertainty of coefficients, fin rate and dead time, a share.
        own: factors of single numbers, as the vehicle file states them.
        flights: along courses in each sea; as many on lines.
        within: largest distance away from corners that is good enough, m.
        within_depth: largest error of depth that is good enough, m; for a vehicle that dives.
        seed: of all draws.
        is_part: whether the vehicle is the horizontal part of one that dives.
    """

    vehicle: Vehicle
    conditions: Conditions
    seas: tuple[Sea, ...]
    spread: float
    own: Mapping[str, Factors]
    flights: int
    within: float
    within_depth: float
    seed: int
    is_part: bool = False


class SeaProof(NamedTuple):
    """What the flights along courses in one sea say.

    Attributes:
        off, whole, rms: largest true distance of each flight away from corners and anywhere, and its rms, m;
            infinite where it did not complete.
        deep: largest error of depth of each flight, m, infinite likewise; zeros for a vehicle in the plane.
        travel: mean travel of the rudder, deg/m.
        lost: flights that did not complete their course.
    """

    off: Numbers
    whole: Numbers
    rms: Numbers
    deep: Numbers
    travel: float
    lost: int

    @property
    def off_bound(self) -> float:
        """What 99 % of the flights keep away from corners at 95 % confidence, m."""
        return most_of(self.off)

    @property
    def whole_bound(self) -> float:
        """The same anywhere on the course, m."""
        return most_of(self.whole)

    @property
    def deep_bound(self) -> float:
        """The same of the error of depth, m."""
        return most_of(self.deep)

    @property
    def worst(self) -> int:
        """Number of the flight that is farthest away; one that did not complete its course comes first."""
        return int(np.argmax(self.off if math.isinf(np.max(self.off)) else self.whole))


class Proof(NamedTuple):
    """What the flights say of one set of gains.

    Attributes:
        seas: by the names of the seas, in the order flown.
        unrest: late rms yaw rate of each flight on a line, deg/s.
    """

    seas: Mapping[str, SeaProof]
    unrest: Numbers

    @property
    def worst_sea(self) -> str:
        """Name of the sea with the largest bound away from corners; of infinite ones, that with most lost."""
        return max(self.seas, key=lambda name: (self.seas[name].off_bound, self.seas[name].lost))

    @property
    def off_bound(self) -> float:
        """Largest bound away from corners, m."""
        return max(one.off_bound for one in self.seas.values())

    @property
    def deep_bound(self) -> float:
        """Largest bound of the error of depth, m."""
        return max(one.deep_bound for one in self.seas.values())

    @property
    def cycles(self) -> int:
        """Flights on lines with a limit cycle; those that ended early are among them."""
        return int(np.sum(~(self.unrest <= LIMIT_CYCLE)))

    @property
    def cycle_bound(self) -> float:
        """Largest share of starts with a limit cycle, at 95 % confidence."""
        return largest_share(self.cycles, len(self.unrest))

    def holds(self, within: float, within_depth: float) -> bool:
        """Return whether 99 % keep `within` and `within_depth` (m), and 99 % of starts do not limit-cycle."""
        is_near = self.off_bound <= within and self.deep_bound <= within_depth
        return is_near and self.cycle_bound <= 1.0 - SHARE


def draw_claim(claim: Proposition) -> list[Flight]:
    """Draw all flights of a claim: along courses in the first sea, in the next ones, then on lines.

    With a spread each flight along a course has a hull of its own, and so has each on a line: a bound over
    flights on few hulls would not hold for other hulls. All seas have the same courses, hulls and currents.

    Raises:
        ConfigurationError: no hull can be drawn, or the delay is too long for the simulator.
    """
    random = np.random.default_rng([claim.seed, _STREAM])
    hulls: Sequence[Vehicle] = [claim.vehicle] * claim.flights
    if claim.spread > 0.0 or claim.own:
        hulls = drawn_hulls(claim.vehicle, claim.flights, claim.spread, random, claim.own)
    check_delay(hulls, claim.conditions.delay, LATER)
    along = draw_sea_flights(hulls, claim.conditions, random)
    lines = draw_starts(hulls, claim.conditions, random)
    if claim.vehicle.dives:
        depths = np.random.default_rng([claim.seed, _DEPTHS])
        along = [with_depths(flight, depths) for flight in along]
    return [*(_in_sea(flight, sea) for sea in claim.seas for flight in along), *lines]


def _in_sea(flight: Flight, sea: Sea) -> Flight:
    return flight._replace(scenario=dataclasses.replace(flight.scenario, sea=sea))


def fly_proof(
    claim: Proposition, flights: Sequence[Flight], gains: GainSet, threads: int,
    done: Callable[[int], Any] | None = None,
) -> Proof:  # fmt: skip
    """Fly the flights of a claim with one set of gains.

    Args:
        claim: what is to be proven.
        flights: of `draw_claim`, or those of some of its seas, with or without lines.
        gains: to fly with.
        threads: flights at the same time.
        done: called after each flight.
    """
    scenarios: list[Scenario] = [with_laws(flight, gains, claim.vehicle) for flight in flights]
    found = engine.fly(scenarios, threads, done, Courses())
    is_line = np.array([flight.is_line for flight in flights])
    names = [
        None if c.sea is None or line else c.sea.name for c, line in zip(scenarios, is_line, strict=True)
    ]
    seas = {
        sea.name: _sea_proof(found, np.array([name == sea.name for name in names]))
        for sea in claim.seas
        if sea.name in names
    }
    return Proof(seas, found.late_rms_yaw_rate[is_line])


def _sea_proof(found: Flights, rows: npt.NDArray[np.bool_]) -> SeaProof:
    completed = found.completed[rows]

    def of_completed(values: Numbers) -> Numbers:
        return np.where(completed, values[rows], math.inf)

    deep = getattr(found, "largest_depth_error", np.zeros(len(rows)))
    travel = found.rudder_travel_per_metre[rows]
    is_known = np.isfinite(travel)
    return SeaProof(
        of_completed(found.off_corners_largest_distance),
        of_completed(found.largest_distance),
        of_completed(found.rms_distance),
        of_completed(deep),
        float(np.mean(travel[is_known])) if is_known.any() else math.nan,
        int(np.sum(~completed)),
    )
