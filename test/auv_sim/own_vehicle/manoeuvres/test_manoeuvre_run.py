"""The bounds of a program: each ends it with rudder, planes and thrust at 0."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SPATIAL_STOP, Navigation, SpatialNavigation
from auv_path_following import vehicle
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import ManoeuvreBounds, ManoeuvreRun

REMUS, DIVER = vehicle.load("remus100"), vehicle.load("remus100_6dof")
TWO = program_file.load("two_minutes")
LEVEL = SpatialNavigation(0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def begun(dives: bool = False) -> ManoeuvreRun:
    run = ManoeuvreRun(DIVER if dives else REMUS, TWO, ManoeuvreBounds(), 10.0 if dives else 0.0)
    first = run.step(LEVEL if dives else Navigation(0.0, 0.0, 0.0, 0.0), 0.1)
    assert first.thrust > 0.0 and not run.over
    return run


@pytest.mark.parametrize(
    ("navigation", "reason"),
    [
        (Navigation(1.0, -201.0, 0.0, 0.0), "201 m away"),
        (Navigation(201.0, 1.0, 0.0, 0.0), "201 m away"),
        (Navigation(1.0, math.nan, 0.0, 0.0), "no number"),
        (Navigation(1.0, 0.0, math.inf, 0.0), "no number"),
    ],
)
def test_a_bound_that_is_left_stops_a_vehicle_in_the_plane(navigation: Navigation, reason: str) -> None:
    run = begun()
    assert run.step(navigation, 0.1) == SPATIAL_STOP
    assert reason in run.over and not run.complete
    # And it does not go on when the vehicle is back.
    assert run.step(Navigation(0.0, 0.0, 0.0, 0.0), 0.1) == SPATIAL_STOP


@pytest.mark.parametrize(
    ("changes", "altitude", "reason"),
    [
        ({"z": 18.5}, math.nan, "18.5 m deep, more than 8 m"),
        ({"z": 1.5}, math.nan, "1.5 m deep, more than 8 m"),
        ({"z": 100.5}, math.nan, "deeper than depth.max"),
        ({}, 2.5, "2.5 m above the bottom"),
        ({"theta": 0.9}, math.nan, "a pitch of 52 deg"),
        ({"theta": -0.9}, math.nan, "a pitch of -52 deg"),
    ],
)
def test_a_bound_that_is_left_stops_a_diver(changes: dict[str, float], altitude: float, reason: str) -> None:
    run = begun(dives=True)
    assert run.step(LEVEL._replace(**changes), 0.1, altitude) == SPATIAL_STOP
    assert reason in run.over


def test_the_way_down_from_the_surface_is_no_bound_left() -> None:
    run = ManoeuvreRun(DIVER, TWO, ManoeuvreBounds(), 30.0)
    for depth in (0.5, 10.0, 25.0, 30.0):
        run.step(LEVEL._replace(z=depth), 1.0)
    assert run.over == ""
    run.step(LEVEL._replace(z=21.0), 1.0)
    assert "21.0 m deep" in run.over


@pytest.mark.parametrize("depth", [9.0, 12.0])
def test_a_diver_that_does_not_reach_its_depth_is_stopped(depth: float) -> None:
    """Whether it stays within `dive` of the depth or not, no manoeuvre begins elsewhere."""
    run = ManoeuvreRun(DIVER, TWO, ManoeuvreBounds(dive=1.5), 10.0)
    away = LEVEL._replace(z=depth)
    for _ in range(60):
        assert run.step(away, 1.0).thrust > 0.0
    assert run.step(away, 1.0) == SPATIAL_STOP
    assert f"not level at the depth of 10 m within 60 s, but {depth:.1f} m deep" in run.over


def test_once_the_depth_is_reached_the_smallest_bound_applies() -> None:
    run = ManoeuvreRun(DIVER, TWO, ManoeuvreBounds(dive=0.2), 10.0)
    away = LEVEL._replace(z=10.4)
    assert run.step(away, 1.0).thrust > 0.0  # on the way down, which is over within 0.5 m
    assert run.step(away, 1.0) == SPATIAL_STOP
    assert "10.4 m deep, more than 0.2 m" in run.over


@pytest.mark.parametrize("heard", [20.0, math.inf])
def test_an_altitude_that_is_lost_stops_a_diver(heard: float) -> None:
    run = begun(dives=True)
    assert run.step(LEVEL, 0.1).thrust > 0.0  # a vehicle without an altimeter flies
    assert run.step(LEVEL, 0.1, heard).thrust > 0.0
    assert run.step(LEVEL, 0.1) == SPATIAL_STOP
    assert "no altitude any more" in run.over


@pytest.mark.parametrize(("depth", "found"), [(100.5, "100.5 m"), (96.0, "96 m, stepped to 101 m")])
def test_a_depth_beyond_the_vehicles_is_refused(depth: float, found: str, tmp_path: Path) -> None:
    legs = "[{straight: {seconds: 5, depth_step: -1}}, {straight: {seconds: 5, depth_step: 6}}]"
    (tmp_path / "steps.yaml").write_text(f"{{version: 1, name: steps, legs: {legs}}}")
    program = program_file.load(str(tmp_path / "steps.yaml"))
    expected = f"depth: found {found}, expected depths from 0 to depth.max, 100 m"
    with pytest.raises(ConfigurationError, match=expected):
        ManoeuvreRun(DIVER, program, ManoeuvreBounds(), depth)


def test_a_speed_that_no_vehicle_has_counts_as_lost_navigation() -> None:
    run = begun()
    for k in range(1, 30):
        run.step(Navigation(0.5 * k, 0.0, 0.0, 0.0), 0.1)
    assert "a speed over ground of 5.0 m/s" in run.over


def test_time_beyond_the_program_ends_it() -> None:
    run = begun()
    run.step(Navigation(1.0, 0.0, 0.0, 0.0), 151.0)
    assert "longer than the program" in run.over


def test_it_ends_complete_after_all_legs() -> None:
    run = begun()
    for _ in range(1205):
        run.step(Navigation(0.0, 0.0, 0.0, 0.0), 0.1)
    assert run.complete and run.progress == pytest.approx(1.0)
    assert run.rows[-1].command == SPATIAL_STOP
    run.stop("later")
    assert run.over == "all manoeuvres are flown"
