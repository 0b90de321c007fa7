"""The circle of acceptance, Eq. (44), by mode, radius and kind of joint."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.settings.schema import validated
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Current
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.reverse import Reversed
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.guidance.acceptance import Cornering, acceptance_radius, corner_of
from auv_path_following.guidance.switching import SwitchingConfig, circles_of, radius_at, reached
from auv_path_following.missions.mission_spec import MissionSwitching

#: A corner (G0) at (40, 0), a smooth joint (G1) at (40, 20), and the end.
PATH = CompositePath(
    [
        Line(0.0, 0.0, 40.0, 0.0),
        Line(40.0, 0.0, 20.0, math.pi / 2),
        Arc(30.0, 20.0, 10.0, 0.0, math.pi / 2),
    ]
)
CORNER, SMOOTH, END = 0, 1, 2


def is_reached(x, y, i, t, path=PATH, mode="g0", radius=6.0):
    circles = circles_of(SwitchingConfig(mode=mode, radius=radius), None, 5.0)
    return reached(circles, path.rows.subpath[i], x, y, t)


def test_the_path_has_the_joints_that_the_tests_need():
    assert [joint.geometric for joint in PATH.joints] == ["G0", "G1"]


@pytest.mark.parametrize(
    ("mode", "at_corner", "at_smooth"), [("off", False, False), ("g0", True, False), ("all", True, True)]
)
def test_modes(mode, at_corner, at_smooth):
    assert is_reached(40.0, 0.0, CORNER, 0.9, mode=mode) is at_corner
    assert is_reached(40.0, 20.0, SMOOTH, 0.9, mode=mode) is at_smooth


@pytest.mark.parametrize("mode", ["off", "g0", "all"])
def test_the_last_subpath_has_no_joint_to_switch_at(mode):
    end = PATH.at(3.0)
    assert not is_reached(end.x, end.y, END, 1.0, mode=mode, radius=1000.0)


@given(st.floats(0.0, 12.0), st.floats(-math.pi, math.pi), st.floats(0.5, 12.0), st.floats(0.0, 1.0))
def test_on_the_last_half_it_is_a_circle_with_the_radius_that_was_asked_for(distance, bearing, radius, t):
    x, y = 40.0 + distance * math.cos(bearing), distance * math.sin(bearing)
    found = is_reached(x, y, CORNER, t, radius=radius)
    if abs(distance - radius) > 1e-9:
        assert found is (distance < radius and t >= 0.5)


def test_the_edge_belongs_to_the_circle():
    assert is_reached(34.0, 0.0, CORNER, 0.85)
    assert is_reached(40.0, 0.0, CORNER, 1.0, radius=0.0)


def test_only_the_joint_at_the_end_of_the_followed_subpath_counts():
    assert not is_reached(40.0, 0.0, SMOOTH, 0.5, mode="all")
    assert not is_reached(40.0, 20.0, CORNER, 0.5, mode="all")


LOOP = Spline([(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0), (0.0, 0.0)])
ROUND = Arc(0.0, 0.0, 10.0, 0.0, 2.0 * math.pi)


@pytest.mark.parametrize(("lap", "mode"), [(LOOP, "g0"), (ROUND, "all"), (Reversed(ROUND), "all")])
def test_a_lap_that_ends_where_it_starts_is_not_over_before_it_was_flown(lap, mode):
    laps = CompositePath([lap, lap])
    for t in (0.0, 0.01, 0.1, 0.3):
        start = lap.evaluate(t)
        assert not is_reached(start.x, start.y, 0, t, laps, mode)
    end = lap.evaluate(0.985)
    assert is_reached(end.x, end.y, 0, 0.985, laps, mode)


def test_a_small_lap_inside_its_own_circle_is_flown_half_at_least():
    small = Arc(0.0, 0.0, 2.0, 0.0, 2.0 * math.pi)
    laps = CompositePath([small, small])
    assert [is_reached(2.0, 0.0, 0, t, laps, "all") for t in (0.0, 0.4, 0.6)] == [False, False, True]


CURRENT = Current(0.1, -0.2)
CORNERING = Cornering(rate=0.5, lead=1.0)


def computed(mode, radius=0.0):
    return circles_of(SwitchingConfig(mode=mode, radius=radius), CORNERING, 5.0)


@pytest.mark.parametrize("mode", ["g0", "all"])
def test_a_radius_of_0_is_computed_where_the_course_jumps(mode):
    circles, row = computed(mode), PATH.rows.subpath[CORNER]
    widest = acceptance_radius(CORNERING, corner_of(PATH, CORNER), 5.0, 1.9, CURRENT)
    assert 0.0 < widest == radius_at(circles, row, 1.9, CURRENT)
    for distance in (0.99, 1.01):
        x = 40.0 - distance * widest
        assert reached(circles, row, x, 0.0, 0.9, 1.9, CURRENT) is (distance < 1.0)
    assert radius_at(circles, PATH.rows.subpath[SMOOTH], 1.9, CURRENT) == 0.0


def test_a_number_stays_a_number():
    assert radius_at(computed("g0", 3.0), PATH.rows.subpath[CORNER], 1.9, CURRENT) == 3.0


@pytest.mark.parametrize("settings_class", [SwitchingConfig, MissionSwitching])
def test_a_file_may_say_auto(settings_class):
    assert validated(settings_class, {"radius": "auto"}, "file").radius == 0.0
    with pytest.raises(ConfigurationError, match="radius: found 'wide', expected a number"):
        validated(settings_class, {"radius": "wide"}, "file")
