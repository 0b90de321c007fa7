"""Heave and pitch on the terminal: combinations, planes, buoyancy."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from rich.table import Table

from auv_path_following.vehicle import Hull
from auv_path_following.vertical_hull import VerticalHull
from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers
from auv_sim.own_vehicle.identify.dive.dive_combinations import (
    DIVE_SYMBOLS,
    DIVE_UNITS,
    DiveCombinations,
    vertical_with,
)
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.intervals import REACH, gradient_of
from auv_sim.own_vehicle.identify.results.identification_tables import combinations_table
from auv_sim.own_vehicle.identify.unknowns import ALL, DEAD_TIME, RATE
from auv_sim.terminal import headed_table

#: Standard deviation of the assumed added mass in heave, a share of it.
_ADDED_MASS = 0.4


class Buoyancy(NamedTuple):
    """Weight less buoyancy and its standard deviations, by the data and by the assumed masses, N."""

    value: float
    statistical: float
    systematic: float


def dive_table(found: Identified) -> Table:
    """Return the combinations of heave and pitch with both parts of their intervals."""
    return combinations_table(found, "heave and pitch", DIVE_SYMBOLS, DIVE_UNITS)


def diver_table(found: Identified, hull: Hull, vertical: VerticalHull) -> Table:
    """Return rate and dead time of the planes, pitch frequency and buoyancy, with their intervals.

    Args:
        found: identification of heave and pitch.
        hull, vertical: the source of the masses.
    """
    p, off = found.physical, REACH * found.spread.deviations
    table = headed_table("diver", ("",), ("value", "95 %: data +-", "systematic +-", "unit"))
    righting = DiveCombinations._fields.index("Msin")
    frequency = math.sqrt(max(-p[righting], 0.0))
    share = 0.5 * off[righting] / max(-p[righting], 1e-9)
    buoyancy = weight_less_buoyancy(found, hull, vertical)
    rows = (
        ("rate of the planes", math.degrees(p[RATE]), math.degrees(off[RATE]), 0.0, "deg/s"),
        ("dead time of the planes", p[DEAD_TIME], off[DEAD_TIME], 0.0, "s"),
        ("pitch frequency at rest", frequency, share * frequency, 0.0, "rad/s"),
        (
            "weight less buoyancy",
            buoyancy.value,
            REACH * buoyancy.statistical,
            REACH * buoyancy.systematic,
            "N",
        ),
    )
    for name, value, data, unseen, unit in rows:
        table.add_row(name, f"{value:.4g}", f"{data:.2g}", f"{unseen:.2g}", unit)
    return table


def weight_less_buoyancy(found: Identified, hull: Hull, vertical: VerticalHull) -> Buoyancy:
    """Return the weight less the buoyancy of an identified hull with assumed masses.

    Motion shows the acceleration by this force, not the force: an added mass in heave that is off is in it.
    """

    def force(physical: Numbers, assumed: VerticalHull = vertical) -> float:
        written = vertical_with(DiveCombinations(*map(float, physical[:COUNT])), hull.m, assumed)
        return written.W - written.B

    value, gradient = force(found.physical), np.zeros(ALL)
    gradient[:] = gradient_of(force, found.physical, found.spread)
    acceleration = found.physical[DiveCombinations._fields.index("Zcos")]
    assumed = _ADDED_MASS * abs(vertical.Zwd * acceleration)
    return Buoyancy(
        value, found.spread.statistical(gradient), math.hypot(found.spread.unseen(gradient), assumed)
    )
