"""The identification on the terminal: coefficients, rudder and biases, abilities, whiteness, predictions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from rich.table import Table

from auv_sim.own_vehicle.identify.combinations import COUNT, SYMBOLS, UNITS
from auv_sim.own_vehicle.identify.hull_abilities import Ability
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.intervals import REACH
from auv_sim.own_vehicle.identify.predictions import Prediction
from auv_sim.own_vehicle.identify.unknowns import (
    ALL,
    DEAD_TIME,
    GYRO,
    HALF_PLAY,
    LATENCY,
    RATE,
    TRIM,
    U_BIAS,
    V_BIAS,
)
from auv_sim.own_vehicle.identify.water_current import MeanCurrent
from auv_sim.terminal import headed_table

#: A coefficient with a smaller standard deviation counts as identified, a share.
IDENTIFIED = 0.10
#: Channels of the innovations: name, unit, and SI units for one of it.
_RATE = math.radians(1.0)
_IN_PLANE = (
    ("yaw rate", "deg/s", _RATE), ("u through the water", "m/s", 1.0), ("v through the water", "m/s", 1.0),
)  # fmt: skip
_OF_DIVE = (("pitch rate", "deg/s", _RATE), ("pitch", "deg", _RATE), ("w through the water", "m/s", 1.0))


class Figure(NamedTuple):
    """One row of the servo's table: name, value, half of the 95 % interval, unit."""

    name: str
    value: float
    off: float
    unit: str


def coefficients_table(found: Identified) -> Table:
    """Return the combinations with both parts of their intervals."""
    return combinations_table(found, "accelerations by the water, rudder and thrust", SYMBOLS, UNITS)


def combinations_table(found: Identified, title: str, symbols: Sequence[str], units: Sequence[str]) -> Table:
    """Return combinations with both parts of their intervals.

    Args:
        found: the identification.
        title: of the table.
        symbols, units: of its combinations.
    """
    table = headed_table(title, ("",), ("value", "unit", "95 %: data +- %", "systematic +- %", ""))
    for k, (symbol, unit) in enumerate(zip(symbols, units, strict=True)):
        row, value = np.eye(ALL)[k], found.physical[k]
        data, unseen = found.spread.statistical(row), found.spread.unseen(row)
        share = math.hypot(data, unseen) / abs(value)
        verdict = "" if share < IDENTIFIED else "weak" if share < 0.5 else "as assumed"
        cells = (f"{100.0 * REACH * off / abs(value):.1f}" for off in (data, unseen))
        table.add_row(symbol, f"{value:.4g}", unit, *cells, verdict)
    return table


def identified_line(found: Identified) -> str:
    """Return how many combinations have a standard deviation below `IDENTIFIED`, in words."""
    shares = found.spread.deviations[:COUNT] / np.abs(found.physical[:COUNT])
    known = int((shares < IDENTIFIED).sum())
    return f"{known} of {COUNT} have a standard deviation below {100.0 * IDENTIFIED:.0f} %"


def servo_figures(found: Identified) -> list[Figure]:
    """Return rudder, biases and latency."""
    p, off = found.physical, REACH * found.spread.deviations
    return [
        Figure("rudder rate", math.degrees(p[RATE]), math.degrees(off[RATE]), "deg/s"),
        Figure("dead time of the rudder", p[DEAD_TIME], off[DEAD_TIME], "s"),
        Figure(
            "play of the rudder", 2.0 * math.degrees(p[HALF_PLAY]), 2.0 * math.degrees(off[HALF_PLAY]), "deg"
        ),
        Figure("dead band of the rudder", math.degrees(found.dead_band), math.nan, "deg"),
        Figure("trim of the rudder", math.degrees(p[TRIM]), math.degrees(off[TRIM]), "deg"),
        *_own_trims(found),
        Figure("bias of the gyro", math.degrees(p[GYRO]), math.degrees(off[GYRO]), "deg/s"),
        Figure("bias of u", p[U_BIAS], off[U_BIAS], "m/s"),
        Figure("bias of v", p[V_BIAS], off[V_BIAS], "m/s"),
        Figure("latency of the log", p[LATENCY], off[LATENCY] or math.nan, "s"),
    ]


def _own_trims(found: Identified) -> list[Figure]:
    """Return the trims of the last recordings where they differ from that of the first."""
    trims = dict.fromkeys(passage.trim for passage in found.channels.passages)
    off = REACH * found.spread.deviations[TRIM]
    return [
        Figure(
            f"trim, recording {number}", math.degrees(found.physical[TRIM] + trim), math.degrees(off), "deg"
        )
        for number, trim in enumerate(trims, 1)
        if number > 1
    ]


def figures_table(
    found: Identified, abilities: Sequence[Ability], currents: Sequence[MeanCurrent | None]
) -> Table:
    """Return abilities, rudder, biases, latency and current."""
    table = headed_table("vehicle", ("",), ("value", "95 % +-", "unit"))
    for ability in abilities:
        table.add_row(ability.name, f"{ability.value:.4g}", f"{REACH * ability.deviation:.2g}", ability.unit)
    for figure in servo_figures(found):
        off = "given" if math.isnan(figure.off) and figure.name.startswith("lat") else f"{figure.off:.2g}"
        table.add_row(
            figure.name,
            f"{figure.value:.4g}",
            "tried" if figure.name.startswith("dead band") else off,
            figure.unit,
        )
    for number, current in enumerate(currents, 1):
        if current is not None:
            which = f" of recording {number}" if len(currents) > 1 else ""
            off = f"{REACH * current.deviation:.2g}"
            table.add_row(f"current north{which}", f"{current.north:.3f}", off, "m/s")
            table.add_row(f"current east{which}", f"{current.east:.3f}", off, "m/s")
    return table


class Whiteness(NamedTuple):
    """Innovations of one channel: name, unit, deviation in it, lag-1 correlation and its bound if white."""

    name: str
    unit: str
    deviation: float
    correlation: float
    bound: float


def whiteness(found: Identified) -> Iterator[Whiteness]:
    """Yield the innovations of each channel."""
    for channel, (name, unit, size) in enumerate(_IN_PLANE if found.channels.plane.has_thrust else _OF_DIVE):
        own = found.estimate.residuals[found.channels.rows == channel]
        lag = float(np.mean(own[1:] * own[:-1]) / max(np.mean(own * own), 1e-12))
        deviation = float(found.estimate.deviations[channel]) / size
        yield Whiteness(name, unit, deviation, lag, REACH / math.sqrt(max(own.size, 1)))


def whiteness_table(found: Identified) -> Table:
    """Return deviation and lag-1 correlation of the innovations."""
    table = headed_table("innovations", ("",), ("deviation", "unit", "lag-1 correlation", "white below"))
    for one in whiteness(found):
        table.add_row(
            one.name, f"{one.deviation:.3g}", one.unit, f"{one.correlation:+.3f}", f"{one.bound:.3f}"
        )
    return table


def predictions_table(
    predictions: Sequence[Prediction], rate: str = "yaw rate", state: str = "speed"
) -> Table:
    """Return the errors on left-out manoeuvres.

    Args:
        predictions: with their errors.
        rate, state: names of the predicted rate and of the other predicted state.
    """
    table = headed_table(
        "left-out manoeuvres, by the commands alone", ("over",),
        ("starts", f"{rate} off %", "of it noise of the gyro %", f"{state} off %"),
    )  # fmt: skip
    for p in predictions:
        shares = (f"{100.0 * share:.1f}" for share in (p.error, p.noise, p.state))
        table.add_row(f"{p.horizon:g} s", str(p.starts), *shares)
    return table
