"""Hulls of many sizes, known by length, speed, rudder and radius alone, and what `new` assumes of them."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.control.rule.gain_rule import LARGEST_PRODUCT, LEAST_DELAY
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.new.assumed_hull import scaled
from auv_sim.own_vehicle.new.new_session import described
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts, check_facts
from auv_sim.own_vehicle.tune.ensemble import planar
from auv_sim.studies.gains.study_hulls import USUAL_DELAY, drawn_hull, late, stable_hull

#: Ranges of drawn hulls: length (m), diameters of length, speed (m/s), rudder (deg), lengths a second.
LENGTHS, SLENDERNESS, SPEEDS, ANGLES, MOST_LENGTHS = (1.0, 5.0), (6.0, 12.0), (1.0, 2.2), (15.0, 35.0), 1.3
#: Diameters of length of the REMUS 100, and draws after which a number has no hull.
_REMUS, _MOST = 1.6 / 0.19, 50


def new_hulls(drawn: int, first: int = 0) -> dict[str, Vehicle]:
    """Return all hulls by name, with thrust in per cent: shipped ones, one stable in yaw, and drawn ones.

    Args:
        drawn: how many drawn ones.
        first: number of the first of them; from 1 on the drawn ones alone.
    """
    others = {f"drawn {number}": sized_hull(number) for number in range(first, first + drawn)}
    if first > 0:
        return others
    shipped = ("remus100", "remus100_mismatch", "remus100_table2")
    hulls = {name: planar(vehicle.load(name)) for name in shipped} | {"stable in yaw": stable_hull()}
    return {name: _in_per_cent(hull) for name, hull in hulls.items()} | others


def sized_hull(number: int) -> Vehicle:
    """Draw a hull as `drawn_hull`, of another size, speed and rudder; every second one is stable in yaw.

    Hulls for whose speed 50 ms are too much delay are drawn again, because no gain carries them.

    Raises:
        ConfigurationError: many draws found none.
    """
    model = drawn_hull(number)
    random = np.random.default_rng([13, number])
    for _ in range(_MOST):
        length, slender = random.uniform(*LENGTHS), random.uniform(*SLENDERNESS)
        speed, angle = random.uniform(*SPEEDS), random.uniform(*ANGLES)
        speed = min(speed, MOST_LENGTHS * length)
        size = length / model.length
        hull = scaled(model.coefficients, size**3 * (_REMUS / slender) ** 2, size)
        rudder = dataclasses.replace(model.rudder, max_angle_deg=angle, dead_time=0.0)
        sized = dataclasses.replace(
            model, name=f"drawn {number}", length=length, hull=hull, rudder=rudder,
            thrust_max=-hull.Xuu * speed * speed,
        )  # fmt: skip
        try:
            if response_of(sized).divergence * LEAST_DELAY <= LARGEST_PRODUCT:
                return _in_per_cent(sized)
        except (ConfigurationError, ValueError):
            continue
    raise ConfigurationError(f"hull {number}", f"{_MOST} draws without a steady turn", "another number")


def _in_per_cent(hull: Vehicle) -> Vehicle:
    return dataclasses.replace(
        late(hull, 0.0), thrust_unit="percent", thrust_max=100.0, thrust_table=((100.0, hull.thrust_max),),
        params=None,
    )  # fmt: skip


def known_by_little(hull: Vehicle) -> OwnerFacts:
    """Return length, speed, largest rudder and its radius, and the delay of `USUAL_DELAY`: nothing else."""
    angle = hull.rudder.max_angle_deg
    return OwnerFacts(
        hull.name, hull.length, "percent", 100.0, ((100.0, hull.top_speed),),
        ((angle, tightest_turn(hull).radius),), angle, delay=USUAL_DELAY,
    )  # fmt: skip


def assumed(hull: Vehicle) -> Vehicle:
    """Return what the file of `vehicle.py new` describes of a hull that is known by little.

    Raises:
        ConfigurationError: `new` refuses the facts.
    """
    facts = known_by_little(hull)
    check_facts(facts)
    return described(facts, Path(f"{hull.name}.yaml"))[0]
