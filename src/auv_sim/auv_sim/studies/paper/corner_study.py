"""One corner at a time: each hull with its own model and with that of the REMUS 100, in any current.

A better model must not make the controller fly worse. A corner shows it best: there the limits of the heading
reference and the circle of acceptance follow from the model.
"""

from __future__ import annotations

import csv
import dataclasses
import functools
import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_sim.flight.batch import engine
from auv_sim.flight.scenario import Scenario
from auv_sim.studies.paper.paper_flights import parameters_named, vehicle_named

#: (hull that is flown, hull of the controller's model).
PAIRS = (
    ("remus100", "remus100"),
    ("remus100_mismatch", "remus100_mismatch"),
    ("remus100_mismatch", "remus100"),
    ("remus100_table2", "remus100_table2"),
    ("remus100_table2", "remus100"),
)
ANGLES = (30, 45, 60, 90, 120)
SIDES = (1, -1)
#: Strength of the currents, m/s, and number of their directions.
STRENGTH, DIRECTIONS = 0.4, 8
#: Lengths of the leg in, m: the corner comes after the observer has settled, or within the first minute.
SETTLED, EARLY = 150.0, 40.0
_LEG_OUT = 60.0
_TIME_LIMIT = 200.0


@dataclass(frozen=True)
class CornerFlight:
    """One flight over one corner.

    Attributes:
        hull, model: vehicle files of the plant and of the controllers.
        angle: course change, deg, positive to starboard.
        direction: where the current flows to, deg from the leg in; None in still water.
        leg_in: m.
    """

    hull: str
    model: str
    angle: int
    direction: float | None
    leg_in: float

    def scenario(self, params: str = "robust") -> Scenario:
        """Return the scenario; the vehicle starts on the leg in, at cruising speed."""
        parameters, hull = parameters_named(params), vehicle_named(self.hull)
        current = NO_CURRENT
        if self.direction is not None:
            flow = math.radians(self.direction)
            current = Current(STRENGTH * math.cos(flow), STRENGTH * math.sin(flow))
        return Scenario(
            path=_path(self.angle, self.leg_in),
            vehicle=hull,
            thrust=hull.thrust_max,
            current=current,
            guidance=parameters[topics.GUIDANCE].guidance,
            observer=parameters[topics.OBSERVER].observer,
            autopilot=parameters[topics.AUTOPILOT].autopilot,
            controller_vehicle=vehicle_named(self.model),
            time_limit=_TIME_LIMIT,
        )


@dataclass(frozen=True)
class CornerResult:
    """A corner, and the largest distances to the path: after the switch at the corner, and before it (m)."""

    corner: CornerFlight
    distance: float
    distance_before: float


@dataclass(frozen=True)
class CornerRow:
    """All currents and both sides of one corner.

    Attributes:
        hull, model, angle: as in `CornerFlight`, without the side.
        still, worst: largest distance in still water and in any current, m.
        early: the same as `worst`, where the corner comes within the first minute.
        ratio: largest distance over that with the REMUS 100's model, in the worst of all currents.
    """

    hull: str
    model: str
    angle: int
    still: float
    worst: float
    early: float
    ratio: float


def corners(pairs: Sequence[tuple[str, str]] = PAIRS, angles: Sequence[int] = ANGLES) -> list[CornerFlight]:
    """Return every flight of the study."""
    directions = [None, *(360.0 / DIRECTIONS * k for k in range(DIRECTIONS))]
    return [
        CornerFlight(hull, model, side * angle, direction, leg_in)
        for (hull, model), angle, side, direction, leg_in in itertools.product(
            pairs, angles, SIDES, directions, (SETTLED, EARLY)
        )
    ]


def fly(
    flown: Sequence[CornerFlight], workers: int, done: Callable[[], None] = lambda: None
) -> list[CornerResult]:
    """Fly with the batch engine; return the results in the same order.

    Args:
        flown: what to fly.
        workers: threads.
        done: called after each flight, from any thread.
    """
    flights = engine.fly([corner.scenario() for corner in flown], workers, lambda _: done())
    largest = flights.subpath_largest_distance
    return [
        CornerResult(corner, float(after), float(before))
        for corner, before, after in zip(flown, largest[:, 0], largest[:, 1], strict=True)
    ]


def table(results: Sequence[CornerResult]) -> list[CornerRow]:
    """Return one row for each hull, model and angle."""
    by_corner = {result.corner: result.distance for result in results}
    rows = []
    for key in dict.fromkeys((c.hull, c.model, abs(c.angle)) for c in by_corner):
        mine = [c for c in by_corner if (c.hull, c.model, abs(c.angle)) == key]
        settled = [c for c in mine if c.leg_in == SETTLED]
        other = [dataclasses.replace(c, model="remus100") for c in settled]
        rows.append(
            CornerRow(
                *key,
                still=max(by_corner[c] for c in settled if c.direction is None),
                worst=max(by_corner[c] for c in settled),
                early=max((by_corner[c] for c in mine if c.leg_in == EARLY), default=math.nan),
                ratio=max(
                    by_corner[c] / by_corner.get(o, math.nan) for c, o in zip(settled, other, strict=True)
                ),
            )
        )
    return rows


def write(results: Sequence[CornerResult], file: Path) -> None:
    """Write every flight as a line of CSV."""
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        names = [field.name for field in dataclasses.fields(CornerFlight)]
        writer.writerow([*names, "distance", "distance_before"])
        for result in results:
            writer.writerow([*dataclasses.astuple(result.corner), result.distance, result.distance_before])


@functools.cache
def _path(angle: int, leg_in: float) -> CompositePath:
    return CompositePath([Line(0.0, 0.0, leg_in, 0.0), Line(leg_in, 0.0, _LEG_OUT, math.radians(angle))])
