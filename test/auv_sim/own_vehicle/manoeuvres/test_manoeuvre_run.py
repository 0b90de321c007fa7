"""The bounds of a program: each ends it with rudder, planes and thrust at 0."""

from __future__ import annotations

import math

import pytest

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
