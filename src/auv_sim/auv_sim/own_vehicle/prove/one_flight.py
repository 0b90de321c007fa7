"""One flight of a claim: its number, its words, its picture."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from auv_sim.own_vehicle.prove.proof import Proof, Proposition
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.outcome import tuned_picture
from auv_sim.own_vehicle.tune.trial_flights import Flight, with_laws


def draw_flight(
    target: Path, claim: Proposition, label: str, gains: GainSet, flights: Sequence[Flight], number: int
) -> None:
    """Fly one flight again and draw it.

    Raises:
        NotWritten: the picture cannot be written.
    """
    scenario = with_laws(flights[number], gains, claim.vehicle)
    title = flight_words(claim, flights, number)
    tuned_picture.draw(target, title, scenario.path, [(label, scenario)], ())


def flight_words(claim: Proposition, flights: Sequence[Flight], number: int) -> str:
    """Return which flight of a claim a number is."""
    c = flights[number].scenario
    if flights[number].is_line:
        return f"flight {number}: a start on a straight line, {1.0 / c.step:g} odometries a second"
    speed = math.hypot(c.current[0], c.current[1])
    name = "still water" if c.sea is None else f"the sea {c.sea.name}"
    return f"flight {number}: in {name}, {speed:.2f} m/s of further current, {c.path.length:.0f} m"


def worst_of(claim: Proposition, proof: Proof) -> int:
    """Return the number of the worst flight: the farthest in the worst sea, or one that did not complete."""
    place = [one.name for one in claim.seas].index(proof.worst_sea)
    return place * claim.flights + proof.seas[proof.worst_sea].worst
