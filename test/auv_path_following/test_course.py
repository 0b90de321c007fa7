"""The course of a mission: its kind, its limits and holds, and what guidance measures on it."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import NO_SPATIAL_WATER, NO_WATER
from auv_path_following import vehicle
from auv_path_following.course import PlanarCourse, SpatialCourse, course_of
from auv_path_following.guidance.spatial.vertical_modes import FOLLOW_PATH, AltitudeHold
from auv_path_following.missions import mission_file
from auv_path_following.missions.limits import LimitsConfig, MissionLimits, NoLimits
from auv_path_following.missions.mission_state import HoldingConfig
from auv_path_following.parameters import GuidanceParameters

DATA = Path(__file__).parents[1] / "data"
PLANAR, DIVER = vehicle.load("remus100"), vehicle.load("remus100_6dof")
KINDS = pytest.mark.parametrize("hull", [PLANAR, DIVER], ids=["planar", "diver"])


class Received(NamedTuple):
    navigation: Any
    water: Any
    moved: bool
    altitude: float


def mission_of(name: str) -> mission_file.Mission:
    return mission_file.load(str(DATA / f"{name}.yaml"), DIVER)


def test_a_vehicle_without_stern_planes_flies_in_the_plane() -> None:
    planar = mission_file.load("paper_composite")
    assert type(course_of(planar, PLANAR)) is PlanarCourse
    for name in ("short_dive", "short_altitude"):
        with pytest.raises(ConfigurationError, match="stern planes"):
            course_of(mission_of(name), PLANAR)


def test_a_diver_flies_a_planar_mission_at_its_surface_depth() -> None:
    course = course_of(mission_file.load("paper_composite"), DIVER)
    assert type(course) is SpatialCourse
    assert [depth for _, depth in course.path.knots] == [DIVER.depth.surface] * 2


def test_only_an_altitude_needs_the_range_to_the_bottom() -> None:
    parameters = GuidanceParameters()
    dive, altitude = (course_of(mission_of(name), DIVER) for name in ("short_dive", "short_altitude"))
    assert (dive.with_altitude, altitude.with_altitude) == (False, True)
    assert dive.prepare(parameters).follower.mode == FOLLOW_PATH
    held = altitude.prepare(parameters).follower.mode
    assert isinstance(held, AltitudeHold)
    assert (held.above, held.least) == (6.0, 3.0)


@KINDS
def test_limits_are_the_stricter_ones_and_may_be_left_out(hull: vehicle.Vehicle) -> None:
    mission = mission_file.load("paper_composite")
    mission = dataclasses.replace(mission, limits=LimitsConfig(duration=50.0))
    parameters = GuidanceParameters(limits=LimitsConfig(duration=70.0, path_distance=9.0))
    course = course_of(mission, hull)
    limits = course.prepare(parameters).limits
    assert isinstance(limits, MissionLimits)
    assert (limits.values.duration, limits.values.path_distance) == (50.0, 9.0)
    assert course.prepare(parameters, is_limited=False).limits == NoLimits()


@KINDS
def test_in_lockstep_no_mission_holds(hull: vehicle.Vehicle) -> None:
    course = course_of(mission_file.load("paper_composite"), hull)
    holding = HoldingConfig(hold_after=3.0)
    assert course.prepare(GuidanceParameters(holding=holding)).hold_after == 3.0
    assert course.prepare(GuidanceParameters(holding=holding, lockstep=True)).hold_after == math.inf


@pytest.mark.parametrize(("hull", "nothing"), [(PLANAR, NO_WATER), (DIVER, NO_SPATIAL_WATER)])
def test_a_measurement_without_water_has_a_placeholder(hull: vehicle.Vehicle, nothing: Any) -> None:
    course = course_of(mission_file.load("paper_composite"), hull)
    without = course.measured(Received("pose", None, True, 7.0), 12.0, 3.5)
    assert without[:6] == ("pose", nothing, False, True, 12.0, 3.5)
    flowing = nothing._replace(ur=1.9)
    measured = course.measured(Received("pose", flowing, False, 7.0), 12.0, 3.5)
    assert measured[:6] == ("pose", flowing, True, False, 12.0, 3.5)
    assert measured[6:] == ((7.0,) if hull.dives else ())
