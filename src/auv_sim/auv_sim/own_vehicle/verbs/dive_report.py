"""Heave and pitch in `vehicle.py identify`: identified where stern planes moved, and reported."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from rich.console import Console

from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.own_vehicle.identify.dive.dive_data import DiveData
from auv_sim.own_vehicle.identify.identification import Identified, identify_dive
from auv_sim.own_vehicle.identify.innovations import channels_of
from auv_sim.own_vehicle.identify.predictions import Prediction, predictions_of
from auv_sim.own_vehicle.identify.results.dive_tables import dive_table, diver_table
from auv_sim.own_vehicle.identify.results.identification_tables import (
    identified_line,
    predictions_table,
    whiteness_table,
)
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, LATENCY, RATE
from auv_sim.own_vehicle.verbs.left_out import SHORTEST
from auv_sim.terminal import console as terminal
from auv_sim.terminal import progress_bar, steps_in

#: Fewest samples of what is left out.
_FEWEST = 10


class IdentifiedDive(NamedTuple):
    """Heave and pitch, and predictions of the part that was left out."""

    found: Identified
    predictions: list[Prediction]

    @property
    def planes(self) -> tuple[float, float]:
        """Rate (deg/s) and dead time (s) of the stern planes."""
        return math.degrees(self.found.physical[RATE]), float(self.found.physical[DEAD_TIME])


def identified_dive(
    dives: Sequence[DiveData],
    vehicle: Vehicle,
    hull: Hull,
    plane: Identified,
    left_out: PlanarData | None,
    quiet: bool,
) -> IdentifiedDive | None:
    """Identify heave and pitch where stern planes moved.

    Args:
        dives: recordings of one vehicle; none, or a vehicle without planes: the result is None.
        vehicle, hull: what is known.
        plane: identification in the plane; its latency of the log is used.
        left_out: part of the last recording to leave out and predict.
        quiet: whether no progress is shown.
    """
    if not dives or hull.vertical is None or vehicle.sternplanes is None:
        return None
    sheet = plane.scaling.sheet._replace(
        rate=vehicle.sternplanes.max_rate, latency=float(plane.physical[LATENCY]), latency_deviation=0.0
    )
    used, kept = _divided(dives, left_out)
    with progress_bar(terminal(quiet), quiet) as bar:
        found = identify_dive(used, hull, hull.vertical, sheet, None, steps_in(bar))
    if kept is None:
        return IdentifiedDive(found, [])
    channels = channels_of([kept], found.scaling.sheet, found.dead_band)
    return IdentifiedDive(found, predictions_of(channels, found.physical))


def _divided(
    dives: Sequence[DiveData], left_out: PlanarData | None
) -> tuple[list[DiveData], DiveData | None]:
    """Return recordings without the part that is left out, and that part, if there is enough of both."""
    if left_out is None or left_out.t.size == 0:
        return list(dives), None
    last, begin, end = dives[-1], float(left_out.t[0]), float(left_out.t[-1])
    kept = last.between(begin, end)
    parts = [last.between(-math.inf, begin), last.between(end, math.inf)]
    used = [part for part in parts if part.t.size and part.t[-1] - part.t[0] > SHORTEST]
    if kept.water_t.size < _FEWEST or kept.t.size < _FEWEST or not used:
        return list(dives), None
    return [*dives[:-1], *used], kept


def print_dive(console: Console, dive: IdentifiedDive, hull: Hull) -> None:
    """Print the tables of heave and pitch.

    Args:
        console: where to.
        dive: what was identified.
        hull: the source of the masses.
    """
    assert hull.vertical is not None
    found = dive.found
    console.print(dive_table(found))
    console.print(identified_line(found), highlight=False)
    console.print(diver_table(found, hull, hull.vertical))
    console.print(whiteness_table(found))
    if dive.predictions:
        console.print(predictions_table(dive.predictions, "pitch rate", "pitch"))
