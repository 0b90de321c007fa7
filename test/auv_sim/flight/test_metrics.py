from __future__ import annotations

import dataclasses
import json
import math

import numpy as np
import pytest

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_sim.flight.figures.mission_summary import MissionSummary
from auv_sim.flight.metrics import summarise, under_way
from auv_sim.flight.run_record import Run

SPEED, STEP = 2.0, 0.05


def corner_path() -> CompositePath:
    """100 m north, 100 m east, then straight on for another 100 m: one G0 joint, one G2 joint."""
    return CompositePath(
        [
            Line(0.0, 0.0, 100.0, 0.0),
            Line(100.0, 0.0, 100.0, math.pi / 2),
            Line(100.0, 100.0, 100.0, math.pi / 2),
        ]
    )


def run_along(offset: float, amplitude: float) -> Run:
    """Exactly along the path, `offset` metres to port, with a sine of whole periods on top."""
    distance = np.arange(0.0, 300.0 + 1e-9, SPEED * STEP)
    lateral = offset + amplitude * np.sin(2.0 * math.pi * distance / 10.0)
    first = distance < 100.0
    n = distance.size
    return Run.from_columns(
        {
            "t": 1.0 + distance / SPEED,
            "x": np.where(first, distance, 100.0 + lateral),
            "y": np.where(first, -lateral, distance - 100.0),
            "psi": np.where(first, 0.0, math.pi / 2),
            "psi_e": np.radians(3.0) * np.sin(2.0 * math.pi * distance / 10.0),
            "rudder": np.radians(5.0) * np.sin(2.0 * math.pi * distance / 10.0),
            "thrust_cmd": np.full(n, 6.48),
            "s": np.minimum(distance / 100.0, 3.0),
        }
    )


def test_a_sine_about_the_path_has_the_figures_of_a_sine() -> None:
    summary = summarise(run_along(0.0, 0.4), corner_path())
    third = summary.subpaths[2]
    assert third.rms_distance == pytest.approx(0.4 / math.sqrt(2.0), rel=1e-2)
    assert third.largest_distance == pytest.approx(0.4, rel=1e-2)
    assert third.rms_heading_error == pytest.approx(3.0 / math.sqrt(2.0), rel=1e-2)
    # Ten periods, each moves the rudder by four amplitudes.
    assert third.rudder_travel == pytest.approx(10 * 4 * 5.0, rel=1e-2)
    x = np.linspace(0.0, 100.0, 100_000, endpoint=False)
    slope = 0.4 * 2.0 * math.pi / 10.0 * np.cos(2.0 * math.pi * x / 10.0)
    length = 100.0 * float(np.mean(np.sqrt(1.0 + slope**2)))
    assert third.distance_covered == pytest.approx(length, rel=1e-3)
    assert third.rudder_travel_per_metre == pytest.approx(200.0 / length, rel=1e-2)
    assert third.duration == pytest.approx(50.0)
    assert summary.rms_distance == pytest.approx(0.4 / math.sqrt(2.0), rel=2e-2)


def test_totals_are_the_sums_of_the_subpaths() -> None:
    summary = summarise(run_along(0.0, 0.4), corner_path())
    assert summary.completed
    assert summary.steps == 3001
    assert summary.path_length == pytest.approx(300.0)
    for name in ("duration", "distance_covered", "rudder_travel"):
        assert getattr(summary, name) == pytest.approx(sum(getattr(k, name) for k in summary.subpaths))
    assert summary.mean_speed == pytest.approx(summary.distance_covered / summary.duration)
    assert summary.largest_distance == max(k.largest_distance for k in summary.subpaths)
    assert [(k.number, k.kind) for k in summary.subpaths] == [(1, "line"), (2, "line"), (3, "line")]


def test_only_the_corner_counts_for_the_corner() -> None:
    run = run_along(0.0, 0.0)
    x, y = run.x.copy(), run.y.copy()
    x[990] -= 3.0  # 1 m before the corner, along the path: it stays on the path
    y[990] -= 1.5  # and beside it
    y[500] -= 9.0  # 50 m before it
    changed = Run.from_columns(
        {**{k: getattr(run, k) for k in ("t", "psi", "s", "thrust_cmd")}, "x": x, "y": y}
    )
    summary = summarise(changed, corner_path())
    (corner,) = summary.corners
    assert (corner.joint, corner.x, corner.y) == (1, 100.0, 0.0)
    assert corner.largest_distance == pytest.approx(1.5)
    assert summary.largest_distance == pytest.approx(9.0)


def test_what_comes_before_the_start_and_after_the_end_does_not_count() -> None:
    run = run_along(0.0, 0.0)
    thrust, s, x = run.thrust_cmd.copy(), run.s.copy(), run.x.copy()
    thrust[:100], s[:100], x[:100] = 0.0, 0.0, 50.0
    s[-200:], x[-199:] = 3.0, 500.0
    columns = {"t": run.t, "psi": run.psi, "y": run.y, "thrust_cmd": thrust, "s": s, "x": x}
    changed = Run.from_columns(columns)
    flown = under_way(changed, 3)
    assert (flown.steps, flown.t[0], flown.t[-1]) == (3001 - 100 - 199, run.t[100], run.t[-200])
    summary = summarise(changed, corner_path())
    assert summary.largest_distance == pytest.approx(0.0, abs=1e-9)
    assert summary.steps == 3001
    assert summary.duration == pytest.approx((3000 - 100 - 199) * STEP)


def test_the_current_estimate_is_judged_after_it_has_settled() -> None:
    run = run_along(0.0, 0.0)
    since = run.t - run.t[0]
    error = np.where(since < 15.0 - 1e-9, 0.5, 0.003)
    columns = {k: getattr(run, k) for k in ("t", "x", "y", "psi", "s", "thrust_cmd")}
    columns |= {"Vx_true": 0.1 + 0.0 * since, "Vy_true": 0.2 + 0.0 * since}
    columns |= {"Vx_est": 0.1 + 0.6 * error, "Vy_est": 0.2 - 0.8 * error}
    summary = summarise(Run.from_columns(columns), corner_path())
    assert summary.current_estimate_error == pytest.approx(0.003)


def test_an_aborted_mission_has_subpaths_without_figures() -> None:
    run = run_along(0.2, 0.0)
    summary = summarise(run.select(run.s < 1.5), corner_path())
    assert not summary.completed
    third = summary.subpaths[2]
    assert math.isnan(third.rms_distance)
    assert math.isnan(third.duration)
    assert summary.subpaths[1].rms_distance == pytest.approx(0.2)


def test_json_is_strict_and_complete() -> None:
    summary = summarise(run_along(0.2, 0.0), corner_path())
    data = json.loads(summary.to_json(), parse_constant=lambda name: pytest.fail(f"{name} in JSON"))
    assert data["current_estimate_error"] is None
    assert data["subpaths"][1]["rms_distance"] == pytest.approx(0.2)
    assert data["corners"][0]["joint"] == 1
    assert set(data) == set(MissionSummary.__dataclass_fields__)


def test_a_run_that_never_started_is_no_error() -> None:
    run = Run.from_columns({"t": [1.0, 1.05], "x": [0.0, 0.0], "y": [0.0, 0.0], "psi": [0.0, 0.0]})
    summary = summarise(run, corner_path())
    assert (summary.completed, summary.steps) == (False, 2)
    assert math.isnan(summary.rms_distance)


def test_distances_are_those_of_the_true_track() -> None:
    """The odometry believes to be on the path all the time; the vehicle is half a metre beside it."""
    on_the_path = run_along(0.0, 0.0)
    first = on_the_path.s < 1.0
    told = dataclasses.replace(
        on_the_path,
        x_true=on_the_path.x + np.where(first, 0.0, 0.5),
        y_true=on_the_path.y + np.where(first, 0.5, 0.0),
    )
    summary = summarise(told, corner_path())
    assert summarise(on_the_path, corner_path()).rms_distance == pytest.approx(0.0, abs=1e-9)
    assert summary.rms_distance == pytest.approx(0.5, rel=0.01)
    assert summary.navigation_error == pytest.approx(0.5)
    assert math.isnan(summarise(on_the_path, corner_path()).navigation_error)


def test_what_happens_near_a_corner_is_told_apart() -> None:
    wide = run_along(0.0, 0.0)
    near = np.hypot(wide.x - 100.0, wide.y) < 10.0
    far = np.hypot(wide.x - 100.0, wide.y - 150.0) < 10.0
    out = dataclasses.replace(wide, x=wide.x + np.where(near, 3.0, 0.0) + np.where(far, 1.0, 0.0))
    summary = summarise(out, corner_path())
    assert summary.largest_distance == pytest.approx(3.0)
    assert summary.largest_distance_off_corners == pytest.approx(1.0)
