"""Which measurement would help a vehicle's gains most, and why."""

from __future__ import annotations

from typing import NamedTuple

from auv_path_following.control.rule.fin_response import FinResponse, response_of
from auv_path_following.control.rule.gain_rule import LARGEST_PRODUCT, gains_for
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts
from auv_sim.own_vehicle.new.vehicle_text import EFFECT_FACTOR

#: Delays that drivers have, s.
_WORST_DELAY = 0.3
#: Largest crossover times delay at which loops were free of limit cycles, and the same over the divergence.
_LARGEST_LAG, _LEAST_LEAD = 1.25, 1.5


class Measurement(NamedTuple):
    """One measurement, and the reason for it."""

    what: str
    why: str


def worth_measuring(facts: OwnerFacts, vehicle: Vehicle, step: float = 0.05) -> list[Measurement]:
    """Return the measurements that are missing, the most helpful first.

    Args:
        facts: that were given.
        vehicle: with what was assumed.
        step: between two odometries, s.
    """
    response = response_of(vehicle)
    found = [] if facts.effect is not None else [_effect(response, vehicle, step)]
    if facts.delay is None:
        product = max(response.divergence, 0.0) * _WORST_DELAY
        verdict = "too much" if product > LARGEST_PRODUCT else "slow gains, but possible"
        why = (
            f"{vehicle.rudder.dead_time:g} s is assumed; with {_WORST_DELAY:g} s divergence times delay "
            f"would be {product:.2f}: {verdict}"
        )
        found.append(Measurement("the delay of the commands, by the same manoeuvres", why))
    if facts.divergence is None:
        why = (
            f"p = {response.divergence:.2f} 1/s is assumed; it lies from 0 to "
            f"{2.0 * facts.speed / facts.length:.1f} 1/s and bounds the delay"
        )
        found.append(Measurement("the divergence p, by the same manoeuvres", why))
    return found


def _effect(response: FinResponse, vehicle: Vehicle, step: float) -> Measurement:
    w_c = gains_for(vehicle, step=step).heading.crossover
    low, high = w_c / EFFECT_FACTOR, w_c * EFFECT_FACTOR
    least = _LEAST_LEAD * max(response.divergence, 0.0)
    most = _LARGEST_LAG / (vehicle.rudder.dead_time + 0.5 * step)
    why = (
        f"b = {response.effect:.2f} 1/s^2 is assumed within a factor of {EFFECT_FACTOR:g}, so the crossover "
        f"of the loop may be anywhere from {low:.1f} to {high:.1f} 1/s; it must stay between {least:.1f} and "
        f"{most:.0f} 1/s. Two minutes give b to 4 %"
    )
    return Measurement("the rudder's effect b, by two minutes of zig-zags, circles and steps", why)


def headline(measurements: list[Measurement]) -> str:
    """Return one line for the head of a vehicle file."""
    if not measurements:
        return "Nothing that the gains need is assumed."
    return f"Most worth measuring: {measurements[0].what}."
