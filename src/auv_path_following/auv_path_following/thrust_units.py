"""Thrust in the unit of a vehicle's driver: newtons, per cent of the largest, or revolutions a minute."""

from __future__ import annotations

import math
from typing import Literal

from auv_msgs_py.settings.validators import increasing, unfit

ThrustUnit = Literal["N", "percent", "rpm"]
#: Unit -> its symbol.
SYMBOLS: dict[ThrustUnit, str] = {"N": "N", "percent": "%", "rpm": "rpm"}
#: Pairs of two numbers that increase together.
Rows = tuple[tuple[float, float], ...]


def interpolated(rows: Rows, x: float) -> float:
    """Return y at x between rows of (x, y), from (0, 0) on; beyond the last row in proportion to it."""
    if not x > 0.0:
        return 0.0
    before = (0.0, 0.0)
    for row in rows:
        if x <= row[0]:
            return before[1] + (row[1] - before[1]) * (x - before[0]) / (row[0] - before[0])
        before = row
    return before[1] * x / before[0]


def inverse(rows: Rows) -> Rows:
    """Return rows of (y, x)."""
    return tuple((y, x) for x, y in rows)


def speed_between(rows: Rows, thrust: float, is_linear: bool) -> float:
    """Return the speed at a thrust between measured ones.

    Args:
        rows: thrust and speed, increasing.
        thrust: in the unit of the rows.
        is_linear: whether speed grows with the thrust, as with revolutions; otherwise its square does.
    """
    if is_linear:
        return interpolated(rows, thrust)
    return math.sqrt(interpolated(tuple((x, y * y) for x, y in rows), thrust))


def thrust_between(rows: Rows, speed: float, is_linear: bool) -> float:
    """Return the thrust at a speed: the inverse of `speed_between`."""
    if is_linear:
        return interpolated(inverse(rows), speed)
    return interpolated(tuple((y * y, x) for x, y in rows), speed * speed)


def check_thrust(unit: ThrustUnit, largest: float, table: Rows, has_hull: bool) -> None:
    """Refuse a unit and a table of thrust that do not fit each other.

    Args:
        unit: of the vehicle's thrust.
        largest: `thrust_max`, in this unit.
        table: rows of the unit and N; empty for none.
        has_hull: whether the vehicle has coefficients, which need N.

    Raises:
        PydanticCustomError: they do not.
    """
    if unit == "percent" and largest != 100.0:
        raise unfit(f"percent with thrust_max: {largest:g}", "thrust_max: 100")
    if unit == "N" and table:
        raise unfit("thrust_table with thrust_unit: N", "another unit, or no table")
    if unit != "N" and has_hull and not table:
        raise unfit(f"{unit} with a hull, whose coefficients need N", f"thrust_table: rows of {unit} and N")
    increasing(table)
    increasing(inverse(table))
    if table and not (table[0][0] > 0.0 and table[0][1] > 0.0 and table[-1][0] == largest):
        found = f"thrust_table from {table[0][0]:g} to {table[-1][0]:g} {SYMBOLS[unit]}"
        raise unfit(found, f"rows above 0 up to thrust_max, {largest:g}")
