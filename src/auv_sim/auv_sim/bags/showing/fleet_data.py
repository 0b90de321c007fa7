"""The content of a fleet's page, as plain data: all tracks, and the distances between the vehicles."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.bags.showing.space_data import packed
from auv_sim.flight.figures.mission_summary import SpatialMissionSummary
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.flight.separation import closest_over_time, separations

#: Most points of a line; the closest approach of a pair stays among them.
_MOST_POINTS = 4000
#: Distance between the points of a path, m.
_SPACING = 1.0
_HEADS = (
    "vehicle", "mission", "hull", "outcome", "time (s)", "rms dist. (m)", "largest (m)", "rms depth (m)",
)  # fmt: skip


def fleet_data(
    flights: Mapping[str, RecordedMission], pages: Mapping[str, str], title: str
) -> dict[str, Any]:
    """Return the page's content; times are seconds since the first odometry of all.

    Args:
        flights: vehicle -> its mission; one without odometry is in the table only.
        pages: vehicle -> its own page, relative.
        title: of the page.
    """
    runs = {
        name: flight.run for name, flight in flights.items() if flight.run is not None and flight.run.steps
    }
    start = min((float(run.t[0]) for run in runs.values()), default=0.0)
    pairs = separations(runs)
    met = min((pair for pair in pairs if len(pair.t)), key=lambda pair: pair.closest[0], default=None)
    closest = "No two vehicles were recorded at one time."
    if met is not None:
        distance, at = met.closest
        closest = f"Closest: {' and '.join(met.vehicles)}, {distance:.2f} m at {at - start:.1f} s."
    least_t, least = closest_over_time(pairs)
    return {
        "title": title,
        "vehicles": [
            _vehicle(name, flight, runs.get(name), start, pages) for name, flight in flights.items()
        ],
        "pairs": [
            {"vehicles": pair.vehicles, **_line(pair.t - start, distance=pair.distance)} for pair in pairs
        ],
        "least": _line(least_t - start, distance=least),
        "closest": closest,
        "table": [list(_HEADS), *(_row(name, flight) for name, flight in flights.items())],
    }  # fmt: skip


def _vehicle(
    name: str, flight: RecordedMission, run: Run | None, start: float, pages: Mapping[str, str]
) -> dict[str, Any]:
    found: dict[str, Any] = {"name": name, "page": pages.get(name, ""), "path_x": None, "path_y": None}
    if flight.mission is not None:
        x, y, _ = flight.mission.path.polyline(_SPACING)
        found |= {"path_x": packed(x), "path_y": packed(y)}
    if run is None:
        return found | {"t": "", "x": "", "y": "", "depth": None}
    x, y = run.track
    line = _line(run.t - start, x=x, y=y)
    depth = _line(run.t - start, depth=run.depth)["depth"] if isinstance(run, SpatialRun) else None
    return found | line | {"depth": depth}


def _line(t: Any, **columns: Any) -> dict[str, str]:
    """Return columns over time with at most `_MOST_POINTS` points each, packed."""
    every = max(1, math.ceil(len(t) / _MOST_POINTS))
    kept = np.zeros(len(t), bool)
    kept[::every] = True
    kept[-1:] = True
    if "distance" in columns and len(t):
        kept[int(np.nanargmin(columns["distance"]))] = True
    return {"t": packed(t[kept])} | {name: packed(values[kept]) for name, values in columns.items()}


def _row(name: str, flight: RecordedMission) -> list[str]:
    """Return a vehicle's row of the table."""
    mission = flight.mission.name if flight.mission is not None else "–"
    hull = flight.vehicle.name if flight.vehicle is not None else "–"
    summary = flight.summary
    if summary is None:
        return [name, mission, hull, *["–"] * 5]
    depth = summary.rms_depth_error if isinstance(summary, SpatialMissionSummary) else math.nan
    figures = ((summary.duration, 1), (summary.rms_distance, 3), (summary.largest_distance, 2), (depth, 3))
    numbers = [f"{value:.{digits}f}" if math.isfinite(value) else "–" for value, digits in figures]
    return [name, mission, hull, summary.outcome(), *numbers]
