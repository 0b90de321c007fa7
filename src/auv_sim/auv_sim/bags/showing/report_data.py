"""The content of the report's page, as plain data."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_path_following.curves.composite import CompositePath
from auv_sim.bags.content.events import Event
from auv_sim.bags.content.recorded_mission import RecordedMission, texts_of
from auv_sim.bags.showing.report_panels import NOW, diagnostics_panel, panels
from auv_sim.bags.showing.space_data import (
    depth_figures,
    packed,
    published_path,
    space,
    spatial_columns,
)
from auv_sim.flight.by_odometry import ByOdometry
from auv_sim.flight.figures.mission_summary import MissionSummary, SpatialMissionSummary, SubpathSummary
from auv_sim.flight.flown_share import percent
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.flight.signals import ANGLES


def page_data(flight: RecordedMission, events: list[Event], title: str) -> dict[str, Any]:
    """Return the page's content; times are seconds since the first odometry."""
    run = flight.run
    start = float(run.t[0]) if run is not None and run.steps else flight.bag.span_ns[0] * 1e-9
    columns = _columns(flight) if run is not None and run.steps else {}
    summary, opinion = flight.summary, flight.by_odometry
    path = _path(flight)
    missions = [part.mission for part in flight.missions if part.mission is not None]
    joints = [joint for mission in missions for joint in mission.path.joints]
    return {
        "title": title,
        "facts": _facts(flight, summary, opinion),
        "notes": [*flight.bag.notes, *flight.notes, *_gaps(summary)],
        "columns": {name: packed(values) for name, values in columns.items()},
        "path": {"x": packed(path[0]), "y": packed(path[1])} if path is not None else None,
        "space": space(flight, columns),
        "joints": [{"index": j.index, "x": j.x, "y": j.y, "geometric": j.geometric} for j in joints],
        "switches": [event.time - start for event in events if event.kind == "switch"],
        "begin": 0.0,
        "now": [n for n in NOW if n["name"] in columns],
        "panels": [*panels(flight, columns), *diagnostics_panel(flight, start)],
        "table": _missions_table(flight) if flight.parts else _table(summary, opinion),
        "events": [{"t": e.time - start, "kind": e.kind, "text": e.text, "level": e.level} for e in events],
        "config": texts_of(flight.bag),
    }


def _columns(flight: RecordedMission) -> dict[str, NDArray[np.float64]]:
    """Return the run's columns that have values, angles in degrees, time from 0, and derived columns."""
    run = flight.run
    assert run is not None
    columns: dict[str, NDArray[np.float64]] = {}
    for name in run.signals:
        values = getattr(run, name)
        if np.isfinite(values).any():
            columns[name] = np.degrees(values) if name in ANGLES else values
    columns["t"] = run.t - run.t[0]
    rudder = columns.get("rudder", columns.get("rudder_cmd"))
    if rudder is not None and run.steps > 1:
        columns["rudder_rate"] = np.r_[np.nan, np.diff(rudder) / np.diff(run.t)]
    erring = "x_true" in columns
    if erring:
        columns["track_x"], columns["track_y"] = run.track
        heading = np.where(np.isfinite(run.psi_true), run.psi_true, run.psi)
        columns["track_psi"] = np.degrees(heading)
    if "s" in columns and any(part.mission is not None for part in flight.missions):
        columns["distance"] = _distances(flight, *run.track)
        if erring and flight.spatial is None:
            columns["distance_by_odometry"] = _distances(flight, run.x, run.y)
    if isinstance(run, SpatialRun):
        columns |= spatial_columns(flight)
    return {name: values for name, values in columns.items() if np.isfinite(values).any()}


def _distances(
    flight: RecordedMission, x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the distance of the positions to the path of the mission of their row, m, shape (n,)."""
    run = flight.run
    assert run is not None
    if not flight.parts:
        assert flight.mission is not None
        return _distance(run, flight.mission.path, x, y)
    distance = np.full(run.steps, np.nan)
    for part in flight.parts:
        if part.mission is not None and part.run is not None and part.run.steps:
            rows = (run.t >= part.run.t[0]) & (run.t <= part.run.t[-1])
            distance[rows] = _distance(run.select(rows), part.mission.path, x[rows], y[rows])
    return distance


def _distance(
    run: Run, path: CompositePath, x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the distance of the positions to the subpath of their row, m, shape (n,); NaN where unknown."""
    index = run.subpath(path.n)
    known = index >= 0
    distance = np.full(run.steps, np.nan)
    distance[known] = path.distance(x[known], y[known], index[known])
    return distance


def _path(flight: RecordedMission) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Return north and east of the path: the mission's, else the one that guidance published."""
    lines = [part.mission.path.polyline(1.0)[:2] for part in flight.missions if part.mission is not None]
    if lines:
        gap = np.array([np.nan])  # the pen is lifted between two paths
        x, y = (np.concatenate([part for line in lines for part in (line[k], gap)][:-1]) for k in (0, 1))
        return x, y
    published = published_path(flight.bag)
    return published and published[:2]


def _facts(
    flight: RecordedMission, summary: MissionSummary | None, opinion: ByOdometry | None
) -> list[tuple[str, str]]:
    first, last = flight.bag.span_ns
    facts = [("recorded", f"{(last - first) * 1e-9:.1f} s"), ("messages", f"{flight.bag.count:,}")]
    if flight.vehicle is not None:
        facts.insert(0, ("vehicle", flight.vehicle.name))
    if summary is not None:
        facts = [
            ("mission", summary.outcome()),
            ("flown", percent(summary.flown_share)),
            *facts,
            ("path", f"{summary.path_length:.1f} m"),
            ("mean speed", f"{_number(summary.mean_speed, 2)} m/s"),
            ("rms distance", f"{_number(summary.rms_distance, 3)} m"),
            ("largest", f"{_number(summary.largest_distance, 2)} m"),
            ("rudder", f"{_number(summary.rudder_travel, 1)}°"),
        ]
    if isinstance(summary, SpatialMissionSummary):
        facts += [
            ("depth rms", f"{_number(summary.rms_depth_error, 3)} m"),
            ("largest depth error", f"{_number(summary.largest_depth_error, 2)} m"),
            ("stern planes", f"{_number(summary.sternplane_travel, 1)}°"),
        ]
    if opinion is not None:
        facts.append(("by its odometry", f"rms {opinion.rms:.3f} m, largest {opinion.largest:.2f} m"))
    return facts


def _gaps(summary: MissionSummary | None) -> list[str]:
    """Return the line about missed and skipped stretches, if there are any."""
    if summary is None or not (summary.missed or summary.skipped):
        return []
    return [summary.flown_line()]


def _missions_table(flight: RecordedMission) -> list[list[str]]:
    """Return the figures of several missions, a row for each."""
    rows, heads = [], ["mission"]
    for number, part in enumerate(flight.parts, 1):
        table = _table(part.summary, None)
        if table:
            heads = ["mission", "began at", "outcome", "flown", *table[0][1:]]
            assert part.mission is not None and part.summary is not None
            share = percent(part.summary.flown_share)
            name = f"{number} {part.mission.name}"
            rows.append([name, part.place or "start", part.ended[0], share, *table[-1][1:]])
    return [heads, *rows]


def _table(summary: MissionSummary | None, opinion: ByOdometry | None) -> list[list[str]]:
    if summary is None:
        return []

    def figures(part: MissionSummary | SubpathSummary) -> list[str]:
        return [
            _number(part.duration, 1), _number(part.rms_distance, 3), _number(part.largest_distance, 3),
            _number(part.rms_heading_error, 2), _number(part.rudder_travel_per_metre, 3),
            *(_number(figure, 3) for figure in depth_figures(part)),
        ]  # fmt: skip

    heads = ["subpath", "time (s)", "rms dist. (m)", "largest (m)", "rms heading (°)", "rudder (°/m)"]
    heads += ["rms depth (m)", "largest depth error (m)"] * bool(depth_figures(summary))
    rows = [[f"{part.number} {part.kind}", *figures(part)] for part in summary.subpaths]
    rows.append(["all", *figures(summary)])
    if opinion is not None:
        heads.append("rms by odometry (m)")
        for row, rms in zip(rows, (*opinion.subpaths, opinion.rms), strict=True):
            row.append(_number(rms, 3))
    return [heads, *rows]


def _number(value: float, digits: int) -> str:
    return f"{value:.{digits}f}" if math.isfinite(value) else "–"
