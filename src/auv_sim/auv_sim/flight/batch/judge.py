"""The figures of one flight from its track, as `flight_figures.figures_of` derives them from tallies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.batch import tally
from auv_sim.flight.batch.kinds.spatial_tally import SETTLING_TIME
from auv_sim.flight.figures.flown_rows import FlownRows
from auv_sim.flight.loops import followed_path
from auv_sim.flight.metrics import root_mean_square, summarise
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.flight.scenario import Scenario


def judged(run: Run, scenario: Scenario) -> dict[str, Any]:
    """Return a flight's figures by the names of `Flights`.

    Args:
        run: every odometry of the flight, from `closed_loop.fly`.
        scenario: of the flight.
    """
    path = followed_path(scenario)
    x, y = run.track
    summary = summarise(run, path)
    arrived = bool(run.s[-1] >= path.n)
    # The last command of a completed mission is the stop.
    commands = run.rudder_cmd[:-1] if arrived else run.rudder_cmd
    stops = (scenario.controller_vehicle or scenario.vehicle).rudder.max_angle
    elapsed = scenario.step * np.arange(run.steps)
    calm = elapsed >= tally.calm_time(scenario.vehicle) - 1e-6
    rows = FlownRows(run, path)
    distance = rows.distance
    near = np.flatnonzero((run.s > 0.0) & (distance <= tally.ARRIVED))
    late = distance[near[0] :] if near.size else distance[:0]
    figures = {
        "completed": arrived,
        "flown_share": summary.flown_share,
        "finite": bool(np.isfinite(x[-1] + y[-1] + run.psi[-1])),
        "steps": run.steps,
        "duration": float(elapsed[-1]),
        "progress": float(run.s[-1]),
        "rms_distance": summary.rms_distance,
        "largest_distance": summary.largest_distance,
        **_of_distances("late", late),
        **_of_distances("off_corners", distance[rows.corners(path)[1]]),
        "time_to_path": float(elapsed[near[0]]) if near.size else math.nan,
        "rms_heading_error": summary.rms_heading_error,
        "distance_covered": summary.distance_covered,
        "rudder_travel": summary.rudder_travel,
        "rudder_travel_per_metre": summary.rudder_travel_per_metre,
        "late_rms_yaw_rate": math.degrees(root_mean_square(run.r[calm])),
        **_of_commands(commands, stops, scenario.step),
        "current_estimate_error": summary.current_estimate_error,
        "last_x": float(x[-1]),
        "last_y": float(y[-1]),
        "subpath_rms_distance": np.array([part.rms_distance for part in summary.subpaths]),
        "subpath_largest_distance": np.array([part.largest_distance for part in summary.subpaths]),
        "subpath_duration": np.array([part.duration for part in summary.subpaths]),
    }
    if isinstance(path, SpatialPath) and isinstance(run, SpatialRun):
        joined = elapsed[near[0]] if near.size else math.inf
        settled = elapsed - joined >= SETTLING_TIME - 1e-6
        figures |= _in_space(run, rows, path, summary, settled) | _of_pitch(run, calm)
    return figures


def _of_distances(kind: str, distances: Any) -> dict[str, float]:
    largest = float(distances.max()) if distances.size else math.nan
    return {f"{kind}_rms_distance": root_mean_square(distances), f"{kind}_largest_distance": largest}


def _of_commands(commands: Any, stops: float, step: float) -> dict[str, float]:
    """Return the figures of the rudder's commands (rad), a `step` of s apart; `stops`: its largest angle."""
    rate = np.degrees(np.diff(commands)) / step
    return {
        "rms_rudder_rate": root_mean_square(rate),
        "largest_rudder_rate": float(np.abs(rate).max()) if rate.size else 0.0,
        "saturated": float(np.mean(np.abs(commands[1:]) >= stops - 1e-12)) if rate.size else math.nan,
    }


def _in_space(
    run: SpatialRun, rows: FlownRows, path: SpatialPath, summary: Any, settled: Any
) -> dict[str, Any]:
    """Return the further figures of `SpatialFlights`; `settled` marks the rows on the path."""
    _, is_free = rows.corners(path)
    is_free &= settled
    steady = rows.depth_error[is_free]
    return {
        "rms_depth_error": summary.rms_depth_error,
        "largest_depth_error": summary.largest_depth_error,
        "steady_rms_depth_error": root_mean_square(steady),
        "steady_largest_depth_error": float(np.abs(steady).max()) if steady.size else math.nan,
        "largest_pitch": summary.largest_pitch,
        "sternplane_travel": summary.sternplane_travel,
        "sternplane_travel_per_metre": summary.sternplane_travel_per_metre,
        "last_z": float(run.depth[-1]),
        "subpath_rms_depth_error": np.array([part.rms_depth_error for part in summary.subpaths]),
    }


def _of_pitch(run: SpatialRun, calm: Any) -> dict[str, float]:
    """Return the rms pitch rate of the rows that `calm` marks."""
    return {"late_rms_pitch_rate": math.degrees(root_mean_square(run.q[calm]))}
