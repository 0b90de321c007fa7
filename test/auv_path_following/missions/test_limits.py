"""What ends a mission."""

from __future__ import annotations

import math

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import Navigation
from auv_path_following.missions.limits import (
    LimitsConfig,
    LimitsInputs,
    LimitsState,
    NoLimits,
    inside,
    limits_step,
    prepare,
)
from auv_path_following.missions.mission_state import NO_REASON, words

SQUARE = ((0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (0.0, 50.0))
DT = 0.1


class MissionRun:
    """Limits of one mission, with the reason as text."""

    def __init__(self, config=None, geofence=()):
        self.config, self.state = prepare(config or LimitsConfig(), geofence), LimitsState()

    def reset(self):
        self.state = LimitsState()

    def broken(self, navigation, xe, ye, to_go, dt, holds=False, rests=False):
        x, y = navigation[:2]
        inputs = LimitsInputs(x, y, 0.0, math.hypot(xe, ye), 0.0, math.inf, to_go, holds, rests)
        self.state, reason = limits_step(self.config, self.state, inputs, dt)
        return "" if reason == NO_REASON else words(reason)

    def wait(self, dt):
        return self.broken(at(0.0, 0.0), 0.0, 0.0, 0.0, dt, holds=True)


def at(x, y):
    return Navigation(x, y, 0.0, 0.0)


def first_broken(limits, track, off_path=lambda _: 0.0, to_go=lambda _: 0.0):
    """Time and reason of the first broken limit along track(t)."""
    for k in range(10_000):
        t = k * DT
        x, y = track(t)
        reason = limits.broken(at(x, y), 0.0, off_path(t), to_go(t), DT if k else 0.0)
        if reason:
            return t, reason
    return None


def test_a_limit_that_is_set_in_flight_counts_from_the_start():
    limits = MissionRun()
    for _ in range(100):
        assert limits.broken(at(0.0, 0.0), 0.0, 0.0, 0.0, 1.0) == ""
    limits.config = prepare(LimitsConfig(duration=101.5))
    assert limits.broken(at(0.0, 0.0), 0.0, 0.0, 0.0, 1.0) == ""
    assert limits.broken(at(0.0, 0.0), 0.0, 0.0, 0.0, 1.0).startswith("limit duration: 102.0 s")


def test_a_flight_that_never_has_limits_is_never_ended():
    far = LimitsInputs(0.0, 0.0, 0.0, 1e9, 0.0, math.inf, 0.0, False, False)
    state, reason = limits_step(NoLimits(), LimitsState(), far, 1e9)
    assert (state, reason) == (LimitsState(), NO_REASON)


def test_without_limits_nothing_ends():
    assert first_broken(MissionRun(), lambda t: (1e6 * t, 0.0), lambda t: 1e6) is None


def test_duration():
    t, reason = first_broken(MissionRun(LimitsConfig(duration=20.0)), lambda t: (t, 0.0))
    assert t == pytest.approx(20.0, abs=2 * DT)
    assert "duration" in reason


def test_distance_counts_once_the_vehicle_has_been_near():
    limits = MissionRun(LimitsConfig(path_distance=10.0))
    assert limits.broken(at(0.0, 0.0), 0.0, 40.0, 0.0, DT) == ""  # the way to the path
    assert limits.broken(at(0.0, 0.0), 0.0, 9.0, 0.0, DT) == ""
    assert limits.broken(at(0.0, 0.0), 8.0, 6.1, 0.0, DT).startswith("limit path_distance: 10.1 m")
    limits.reset()
    assert limits.broken(at(0.0, 0.0), 0.0, 40.0, 0.0, DT) == ""


def test_geofence():
    limits = MissionRun(geofence=SQUARE)
    assert limits.broken(at(50.0, 25.0), 0.0, 0.0, 0.0, DT) == ""
    assert "geofence" in limits.broken(at(50.0, 51.0), 0.0, 0.0, 0.0, DT)


@given(st.floats(-20.0, 120.0), st.floats(-20.0, 70.0))
def test_inside_a_rectangle(x, y):
    on_edge = min(abs(x), abs(x - 100.0), abs(y), abs(y - 50.0)) < 1e-9
    assert on_edge or inside(SQUARE, x, y) == (0.0 < x < 100.0 and 0.0 < y < 50.0)


def test_a_bay_is_outside():
    bay = ((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (5.0, 2.0), (0.0, 10.0))
    assert not inside(bay, 5.0, 5.0)
    assert inside(bay, 5.0, 1.0)


SLOW = LimitsConfig(ground_speed=0.2, ground_speed_window=30.0)


def test_a_current_that_is_too_strong_is_found_within_its_window():
    t, reason = first_broken(MissionRun(SLOW), lambda t: (0.05 * t, 0.0))
    assert t == pytest.approx(30.0, abs=1.0)
    assert reason.startswith("limit ground_speed: 0.05 m/s over 30.")


@pytest.mark.parametrize(
    "track",
    [
        lambda t: (0.3 * t, 0.0),
        lambda t: (9.0 * math.cos(1.9 / 9.0 * t), 9.0 * math.sin(1.9 / 9.0 * t)),  # a circle in 30 s
        lambda t: (5.0 * math.cos(1.9 / 5.0 * t), 5.0 * math.sin(1.9 / 5.0 * t)),
    ],
)
def test_a_vehicle_that_makes_way_may_also_turn(track):
    assert first_broken(MissionRun(SLOW), track) is None


def test_a_hold_does_not_count_as_slow():
    limits = MissionRun(SLOW)
    for k in range(250):
        assert limits.broken(at(0.19 * k, 0.0), 0.0, 0.0, 0.0, DT) == ""
    assert limits.broken(at(50.0, 0.0), 0.0, 0.0, 0.0, 60.0) == ""  # no measurement for a minute
    for _ in range(290):
        assert limits.broken(at(50.0, 0.0), 0.0, 0.0, 0.0, DT) == ""


BEHIND = LimitsConfig(path_speed=0.3, path_speed_window=30.0)


def still(_):
    return 0.0, 0.0


def test_a_vehicle_that_moves_but_does_not_follow_is_found_within_its_window():
    """It follows for 100 s and then goes round and round: P swings back and forth."""

    def to_go(t):
        return 500.0 - 1.9 * min(t, 100.0) + (2.0 * math.sin(t - 100.0) if t > 100.0 else 0.0)

    def track(t):
        return 5.0 * math.cos(0.4 * t), 5.0 * math.sin(0.4 * t)

    t, reason = first_broken(MissionRun(BEHIND), track, to_go=to_go)
    assert 120.0 < t < 140.0
    assert reason.startswith("limit path_speed: ")
    assert reason.endswith(" s, at least 0.3 m/s")


def test_the_way_to_the_path_is_not_too_slow_along_it():
    """P waits at the beginning for 200 s, then goes: nothing is wrong with that."""
    assert first_broken(MissionRun(BEHIND), still, to_go=lambda t: 2000.0 - 1.9 * max(0.0, t - 200.0)) is None


@example(0.31, 0.0)
@example(0.31, 20.0)
@example(5.0, 20.0)
@settings(max_examples=20)
@given(st.floats(0.31, 5.0), st.floats(0.0, 20.0))
def test_a_vehicle_that_keeps_its_speed_along_the_path_goes_on(speed, wait):
    """Also one that waits at a corner for less than the window allows."""

    def to_go(t):
        waited = min(max(t - 60.0, 0.0), wait * (1.0 - 0.3 / speed))
        return 6000.0 - speed * (t - waited)

    assert first_broken(MissionRun(BEHIND), still, to_go=to_go) is None


@pytest.mark.parametrize(("rate", "window"), [(1.0, 2.0), (1.0, 7.0), (10.0, 2.0), (3.0, 30.0)])
def test_speeds_are_right_also_where_a_window_has_few_measurements(rate, window):
    """Just too slow is found, and just fast enough is not, though measurements miss the window's corners."""
    for limit in ("ground_speed", "path_speed"):
        config = LimitsConfig(**{limit: 0.3, f"{limit}_window": window})
        for speed, found in ((0.29, True), (0.31, False)):
            limits = MissionRun(config)
            limits.state = limits.state._replace(has_followed=True)
            steps = range(int(rate * 20.0 * window))
            reasons = [
                limits.broken(at(speed * k / rate, 0.0), 0.0, 0.0, 900.0 - speed * k / rate, 1.0 / rate)
                for k in steps
            ]
            assert any(reasons) is found


def test_time_that_is_held_counts_for_the_duration():
    limits = MissionRun(LimitsConfig(duration=20.0))
    assert limits.broken(at(0.0, 0.0), 0.0, 0.0, 0.0, 15.0) == ""
    assert limits.wait(4.0) == ""
    assert limits.wait(2.0).startswith("limit duration: 21.0 s")


def test_a_new_start_is_a_new_way_to_the_path():
    limits = MissionRun(BEHIND)
    assert first_broken(limits, still, to_go=lambda t: 100.0 - min(t, 50.0)) is not None
    limits.reset()
    assert first_broken(limits, still, to_go=lambda t: 100.0) is None


def test_a_hold_does_not_count_as_slow_along_the_path():
    limits = MissionRun(BEHIND)
    for k in range(300):
        assert limits.broken(at(0.0, 0.0), 0.0, 0.0, 500.0 - 0.19 * k, DT) == ""
    limits.broken(at(0.0, 0.0), 0.0, 0.0, 443.0, 0.0, rests=True)
    t, _ = first_broken(limits, still, to_go=lambda _: 443.0)
    assert t == pytest.approx(30.0, abs=1.0)


def test_the_stricter_of_parameters_and_mission_counts():
    one = LimitsConfig(
        path_distance=10.0,
        duration=0.0,
        ground_speed=0.1,
        ground_speed_window=20.0,
        path_speed=0.5,
        path_speed_window=50.0,
        max_depth=40.0,
        min_altitude=3.0,
        depth_error=0.0,
    )
    other = LimitsConfig(
        path_distance=0.0,
        duration=60.0,
        ground_speed=0.3,
        ground_speed_window=40.0,
        path_speed=0.2,
        path_speed_window=90.0,
        max_depth=30.0,
        min_altitude=5.0,
        depth_error=2.0,
    )
    expected = LimitsConfig(
        path_distance=10.0,
        duration=60.0,
        ground_speed=0.3,
        ground_speed_window=40.0,
        path_speed=0.5,
        path_speed_window=50.0,
        max_depth=30.0,
        min_altitude=5.0,
        depth_error=2.0,
    )
    assert one.stricter(other) == other.stricter(one) == expected


def deep(z=10.0, depth_error=0.0, altitude=math.inf):
    return LimitsInputs(0.0, 0.0, z, 0.0, depth_error, altitude, 0.0, False, False)


@pytest.mark.parametrize(
    ("limit", "fits", "breaks", "message"),
    [
        ({"max_depth": 30.0}, deep(30.0), deep(30.2), "limit max_depth: 30.2 m, at most 30 m"),
        (
            {"min_altitude": 3.0},
            deep(altitude=3.0),
            deep(altitude=2.8),
            "limit min_altitude: 2.8 m above the bottom, at least 3 m",
        ),
        (
            {"depth_error": 2.0},
            deep(depth_error=-2.0),
            deep(depth_error=-2.5),
            "limit depth_error: 2.5 m from the requested depth, at most 2 m",
        ),
    ],
    ids=["too deep", "too near the bottom", "too far from the depth"],
)
def test_limits_of_depth(limit, fits, breaks, message):
    config = prepare(LimitsConfig(**limit))
    state, reason = limits_step(config, LimitsState(), fits, DT)
    assert reason == NO_REASON
    _, reason = limits_step(config, state, breaks, DT)
    assert words(reason) == message
    _, reason = limits_step(prepare(LimitsConfig()), state, breaks, DT)
    assert reason == NO_REASON


def test_the_error_of_the_depth_counts_once_the_depth_was_reached():
    config, state = prepare(LimitsConfig(depth_error=2.0)), LimitsState()
    for error in (9.0, 5.0, 2.5):
        state, reason = limits_step(config, state, deep(depth_error=error), DT)
        assert reason == NO_REASON
