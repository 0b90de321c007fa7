"""Other laws beside given gains: each tuned by the same search with one budget, flown on the same flights."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_sim.own_vehicle.prove.peer_space import PeerSpace
from auv_sim.own_vehicle.prove.proof import Proof, Proposition, draw_claim, fly_proof
from auv_sim.own_vehicle.tune.ensemble import planar
from auv_sim.own_vehicle.tune.gain_space import LAWS, OWN_LAW, GainSet, GainSpace
from auv_sim.own_vehicle.tune.search import Budget, search
from auv_sim.own_vehicle.tune.trial_flights import STRAIGHT, Flight
from auv_sim.own_vehicle.tune.tuning_problem import Problem

#: Name of MSS's law in tables.
PEER = "MSS: ALOS, sliding mode"
#: Flights along straight legs, at most: bounds of 99 % at 95 % need 299.
_LEGS = 500
#: (task, how much it is) -> what counts one step of it.
Progress = Callable[[str, int], Callable[[float], None]]


class LawTables(NamedTuple):
    """Proofs by the name of the law, in the worst sea of the proof, in the plane.

    Attributes:
        alike: on the courses of the proof, the given gains first.
        straight: on courses of straight legs, with MSS's law; empty where it cannot fly the vehicle.
    """

    alike: Mapping[str, Proof]
    straight: Mapping[str, Proof]


def compare(
    claim: Proposition, own: tuple[str, GainSet], proof: Proof, guidance: PathFollowerConfig, budget: Budget,
    begin: Progress,
) -> LawTables:  # fmt: skip
    """Tune and fly the laws.

    Args:
        claim: what is proven.
        own: name and gains that are proven.
        proof: of them.
        guidance: for everything that is not tuned.
        budget: of each law.
        begin: announces a task.
    """
    worst = next(sea for sea in claim.seas if sea.name == proof.worst_sea)
    flat = claim._replace(
        vehicle=planar(claim.vehicle), seas=(worst,), conditions=claim.conditions._replace(sea=worst)
    )
    laws = {
        law if law != OWN_LAW else f"{law}, tuned alike": _tuned(flat, law, guidance, budget, begin)
        for law in LAWS
    }
    flights = draw_claim(flat)
    label, gains = own
    if claim.vehicle.dives:
        alike = {label: _flown(flat, flights, label, gains, budget, begin)}
    else:
        alike = {label: Proof({worst.name: proof.seas[worst.name]}, proof.unrest)}
    alike |= {name: _flown(flat, flights, name, law, budget, begin) for name, law in laws.items()}
    if flat.vehicle.dives:
        return LawTables(alike, {})
    return LawTables(alike, _on_legs(flat, {label: gains, **laws}, alike, flights, guidance, budget, begin))


def _on_legs(
    flat: Proposition, laws: Mapping[str, GainSet], alike: Mapping[str, Proof], flights: list[Flight],
    guidance: PathFollowerConfig, budget: Budget, begin: Progress,
) -> dict[str, Proof]:  # fmt: skip
    """Fly the laws, and MSS's law tuned on such courses, along straight legs.

    Args:
        flat: what is proven, in the plane and in one sea.
        laws: gains by name.
        alike: what was found of them; their starts on lines are not flown again.
        flights: of `flat`, of which MSS's law flies the lines.
        guidance, budget, begin: as of `compare`.
    """
    legs = flat._replace(
        conditions=flat.conditions._replace(kinds=STRAIGHT), flights=min(flat.flights, _LEGS)
    )
    along = [flight for flight in draw_claim(legs) if not flight.is_line]
    straight = {
        name: _flown(legs, along, f"{name}, legs", law, budget, begin)._replace(unrest=alike[name].unrest)
        for name, law in laws.items()
    }
    peer = _tuned(legs, PEER, guidance, budget, begin)
    lines = [flight for flight in flights if flight.is_line]
    return straight | {PEER: _flown(legs, [*along, *lines], PEER, peer, budget, begin)}


def _tuned(
    claim: Proposition, law: str, guidance: PathFollowerConfig, budget: Budget, begin: Progress
) -> GainSet:
    delay, step = claim.conditions.delay, claim.conditions.step
    space = (
        PeerSpace(claim.vehicle, guidance, delay, step)
        if law == PEER
        else GainSpace(claim.vehicle, guidance, delay, step, law)
    )
    problem = Problem(space, [claim.vehicle], claim.conditions, claim.seed)
    found = search(problem, budget, begin(f"tune: {law}", budget.generations))
    return space.gains(found.point)


def _flown(
    claim: Proposition, flights: list[Flight], name: str, gains: GainSet, budget: Budget, begin: Progress
) -> Proof:
    return fly_proof(claim, flights, gains, budget.threads, begin(f"flights: {name}", len(flights)))
