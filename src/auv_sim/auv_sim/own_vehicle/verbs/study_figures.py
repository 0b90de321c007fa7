"""The figures of an identification study, with the targets that were set before it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers
from auv_sim.own_vehicle.identify.intervals import REACH
from auv_sim.own_vehicle.identify.results.identification_tables import IDENTIFIED
from auv_sim.own_vehicle.identify.study.identified_cases import Judged
from auv_sim.own_vehicle.identify.study.identified_dives import JudgedDive

#: Coefficients of each data set that have to be identified.
_LEAST = 8
#: Largest rms of the errors over the standard deviations of a diver's combinations in the plane.
_LARGEST_SCORE = 1.3
T = TypeVar("T", Judged, JudgedDive)


class Row(NamedTuple):
    """One figure: name; median, worst and target with their unit; and whether the target is met."""

    name: str
    median: str
    worst: str
    target: str
    met: bool


def is_short(program: str) -> bool:
    """Return whether a program (its name or file) takes two minutes, which has targets of its own."""
    return Path(program).stem.startswith("two_minutes")


def figures(outcomes: Sequence[Judged], program: str) -> list[Row]:
    """Return the figures and their targets; of two minutes only the rudder's effect has one."""

    def row(name: str, unit: str, factor: float, target: float, value: Callable[[Judged], float]) -> Row:
        return _row(outcomes, name, unit, factor, target, value)

    b = row("effect of the rudder b", "%", 100.0, 4.0 if is_short(program) else 3.0, lambda o: o.b)
    if is_short(program):
        return [b]
    return [
        b,
        row("tightest turn", "%", 100.0, 2.0, lambda o: o.radius),
        row("speed", "%", 100.0, 3.0, lambda o: o.speed),
        row("yaw pole", "1/s", 1.0, 0.1, lambda o: o.pole_off),
        row("dead time", "ms", 1000.0, 10.0, lambda o: o.dead_time),
        row("rudder rate", "%", 100.0, 1.0, lambda o: o.rate),
        row("current", "m/s", 1.0, 0.02, lambda o: o.current),
        row("left out, yaw rate over 2 s", "%", 100.0, 5.0, lambda o: o.two),
        row("left out, over 10 s, over that of the truth", "", 1.0, 1.15, lambda o: o.ten / o.true_ten),
        *_coverage(outcomes),
    ]


def dive_figures(outcomes: Sequence[JudgedDive], program: str) -> list[Row]:
    """Return the figures of heave and pitch; targets are for medians, and twice as wide for two minutes."""
    wider = 2.0 if is_short(program) else 1.0

    def row(name: str, unit: str, factor: float, target: float, value: Callable[[JudgedDive], float]) -> Row:
        return _row(outcomes, name, unit, factor, target, value, np.median)

    return [
        row("effect of the planes", "%", 100.0, 2.0 * wider, lambda o: o.planes),
        row("righting moment, pitch frequency squared", "%", 100.0, 2.0 * wider, lambda o: o.righting),
        row("pitch damping at 10 deg/s", "%", 100.0, 3.0 * wider, lambda o: o.damping),
        row("weight less buoyancy, masses assumed", "N", 1.0, 0.5 * wider, lambda o: o.buoyancy),
        row("dead time", "ms", 1000.0, 5.0 * wider, lambda o: o.dead_time),
        row("left out, pitch rate over 2 s", "%", 100.0, 10.0, lambda o: o.two),
        row("left out, over 10 s, over that of the truth", "", 1.0, 1.15, lambda o: o.ten / o.true_ten),
        *_coverage(outcomes),
        *_in_plane(outcomes),
    ]


def _row(
    outcomes: Sequence[T],
    name: str,
    unit: str,
    factor: float,
    target: float,
    value: Callable[[T], float],
    judged: Callable[[Numbers], float] = np.max,
) -> Row:
    """Return a row whose target is that of the worst outcome, or of another figure of all."""
    sizes = factor * np.abs([value(outcome) for outcome in outcomes])
    met = bool(judged(sizes) <= target)
    unit = f" {unit}" if unit else ""
    return Row(name, f"{np.median(sizes):.2g}{unit}", f"{sizes.max():.2g}{unit}", f"{target:g}{unit}", met)


def _coverage(outcomes: Sequence[Judged] | Sequence[JudgedDive]) -> list[Row]:
    """Return the share of intervals that hold the truth, of the combinations identified, and how many are."""
    identified = np.array([outcome.shares for outcome in outcomes]) < IDENTIFIED
    counts = identified.sum(axis=1)
    middle = float(np.median(counts))
    return [
        _held("95 % intervals that hold the truth", identified, [outcome.scores for outcome in outcomes]),
        Row(
            f"identified of {COUNT}", f"{middle:g}", f"{counts.min()}", f"{_LEAST} (median)", middle >= _LEAST
        ),
    ]


def _in_plane(outcomes: Sequence[JudgedDive]) -> list[Row]:
    """Return the errors over the claimed standard deviations of divers in the plane, and the coverage."""
    identified = np.array([outcome.plane_shares for outcome in outcomes]) < IDENTIFIED
    scores = np.array([outcome.plane_scores for outcome in outcomes])
    rms, largest = float(np.sqrt(np.mean(scores**2))), float(np.sqrt(np.mean(scores**2, axis=1)).max())
    name = "in the plane, errors over standard deviations (rms of all)"
    return [
        Row(name, f"{rms:.2f}", f"{largest:.2f}", f"{_LARGEST_SCORE:g}", rms <= _LARGEST_SCORE),
        _held("in the plane, 95 % intervals that hold the truth", identified, scores.tolist()),
    ]


def _held(name: str, identified: NDArray[np.bool_], scores: Sequence[Sequence[float]]) -> Row:
    """Return the share of the intervals that hold the truth, of the combinations identified."""
    inside = float((np.abs(scores) < REACH)[identified].mean())
    return Row(name, f"{100.0 * inside:.1f} %", f"{int(identified.sum())} intervals", "90 %", inside >= 0.9)
