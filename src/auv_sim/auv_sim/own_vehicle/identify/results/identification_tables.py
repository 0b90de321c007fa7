"""The identification on the terminal: coefficients, rudder and biases, abilities, whiteness, predictions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from rich.table import Table

from auv_sim.own_vehicle.identify.combinations import COUNT, SYMBOLS, UNITS
from auv_sim.own_vehicle.identify.dive.dive_combinations import DIVE_SYMBOLS, DIVE_UNITS
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
#: Heave and pitch are identified with roll and sway given, not modelled: on a hull in six degrees of freedom
#: this makes errors of about this many statistical deviations.
MODEL_ERROR = 3.0
_CHANNELS = ("yaw rate", "u through the water", "v through the water")


class Figure(NamedTuple):
    """One row of the servo's table: name, value, half of the 95 % interval, unit."""

    name: str
    value: float
    off: float
    unit: str


def coefficients_table(found: Identified) -> Table:
    """Return the combinations with both parts of their intervals."""
    table = headed_table(
        "accelerations by the water, rudder and thrust", ("",),
        ("value", "unit", "95 %: data +- %", "systematic +- %", ""),
    )  # fmt: skip
    for k in range(COUNT):
        row, value = np.eye(ALL)[k], found.physical[k]
        data, unseen = found.spread.statistical(row), found.spread.unseen(row)
        share = math.hypot(data, unseen) / abs(value)
        verdict = "" if share < IDENTIFIED else "weak" if share < 0.5 else "as assumed"
        cells = (REACH * data, REACH * unseen)
        table.add_row(
            SYMBOLS[k],
            f"{value:.4g}",
            UNITS[k],
            *(f"{100.0 * cell / abs(value):.1f}" for cell in cells),
            verdict,
        )
    return table


def dive_table(found: Identified) -> Table:
    """Return the combinations of heave and pitch, with `MODEL_ERROR` times their statistical deviations."""
    table = headed_table("heave and pitch", ("",), ("value", "unit", "95 % +- %", ""))
    off = REACH * MODEL_ERROR * found.spread.deviations[:COUNT]
    for k in range(COUNT):
        value = found.physical[k]
        share = off[k] / abs(value)
        verdict = "" if share < REACH * IDENTIFIED else "weak" if share < 1.0 else "as assumed"
        table.add_row(DIVE_SYMBOLS[k], f"{value:.4g}", DIVE_UNITS[k], f"{100.0 * share:.0f}", verdict)
    p, sd = found.physical, REACH * found.spread.deviations
    rate, late = p[RATE], max(p[DEAD_TIME], 1e-3)
    shares = f"{100.0 * sd[RATE] / rate:.1f}", f"{100.0 * sd[DEAD_TIME] / late:.1f}"
    table.add_row("rate of the planes", f"{math.degrees(rate):.4g}", "deg/s", shares[0], "")
    table.add_row("dead time of the planes", f"{p[DEAD_TIME]:.3f}", "s", shares[1], "")
    return table


def identified_count(found: Identified) -> int:
    """Return how many combinations have a standard deviation below `IDENTIFIED`."""
    shares = found.spread.deviations[:COUNT] / np.abs(found.physical[:COUNT])
    return int((shares < IDENTIFIED).sum())


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


def whiteness(found: Identified) -> Iterator[tuple[str, float, float, float]]:
    """Yield name, deviation (SI), lag-1 correlation, and its bound for white noise, of each channel."""
    for channel, name in enumerate(_CHANNELS):
        own = found.estimate.residuals[found.channels.rows == channel]
        lag = float(np.mean(own[1:] * own[:-1]) / max(np.mean(own * own), 1e-12))
        yield name, float(found.estimate.deviations[channel]), lag, REACH / math.sqrt(max(own.size, 1))


def whiteness_table(found: Identified) -> Table:
    """Return deviation and lag-1 correlation of the innovations."""
    table = headed_table("innovations", ("",), ("deviation", "unit", "lag-1 correlation", "white below"))
    for number, (name, deviation, lag, bound) in enumerate(whiteness(found)):
        shown, unit = (math.degrees(deviation), "deg/s") if number == 0 else (deviation, "m/s")
        table.add_row(name, f"{shown:.3g}", unit, f"{lag:+.3f}", f"{bound:.3f}")
    return table


def predictions_table(predictions: Sequence[Prediction]) -> Table:
    """Return the errors on left-out manoeuvres."""
    table = headed_table(
        "left-out manoeuvres, by the commands alone", ("over",),
        ("starts", "yaw rate off %", "of it noise of the gyro %", "speed off %"),
    )  # fmt: skip
    for p in predictions:
        shares = (f"{100.0 * share:.1f}" for share in (p.error, p.noise, p.speed))
        table.add_row(f"{p.horizon:g} s", str(p.starts), *shares)
    return table
