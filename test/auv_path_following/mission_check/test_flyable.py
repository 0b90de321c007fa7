"""The check before the water: verdicts on missions made for them."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import Current
from auv_path_following import vehicle
from auv_path_following.abilities import Turning
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.polynomial import Polynomial
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.mission_check.crossings import crossings
from auv_path_following.mission_check.flyable import _inside, check
from auv_path_following.missions import limits, mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.missions.routes.smoothing import Smoothing, smooth

REMUS = vehicle.load("remus100")


def mission(*segments, thrust: float = 6.48) -> Mission:
    return Mission("test", CompositePath(segments), thrust, Path("test.yaml"), "", once=len(segments))


def said(verdicts) -> list[str]:
    return [f"{verdict.level} {verdict}" for verdict in (*verdicts.refusals, *verdicts.warnings)]


def test_a_straight_line_is_fine_and_lasts_as_long_as_it_should():
    verdicts = check(mission(Line(0.0, 0.0, 500.0, 0.3)), REMUS)
    assert said(verdicts) == []
    assert verdicts.speed == pytest.approx(2.0)
    assert verdicts.duration == pytest.approx(250.0)


@pytest.mark.parametrize(("radius", "levels"), [(4.0, ["refused"]), (4.5, ["warning"]), (6.0, [])])
def test_the_tightest_turn_decides(radius, levels):
    verdicts = check(mission(Arc(0.0, 0.0, radius, 0.0, 2.0)), REMUS)
    assert [line.split()[0] for line in said(verdicts)] == levels


def test_a_measured_turn_wins_over_the_hulls():
    measured = dataclasses.replace(REMUS, turning=Turning(radius=9.0))
    (refusal,) = check(mission(Arc(0.0, 0.0, 8.0, 0.0, 2.0)), measured).refusals
    assert "at least 9.00 m" in refusal.expected and "measured" in refusal.expected
    assert "1.00 m too tight" in refusal.expected


def test_the_peak_inside_a_curve_is_found():
    # y = 20 (x / 40)^2 on x from -40 to 40: its tightest point, 40 m into the subpath, has a radius of 40 m.
    curve = Polynomial([-40.0, 80.0], [20.0, -80.0, 80.0])
    measured = dataclasses.replace(REMUS, turning=Turning(radius=41.0))
    (refusal,) = check(mission(curve), measured).refusals
    assert "at north 0.0, east 0.0" in refusal.where
    assert "a turn of radius 40.00 m" in refusal.found


@settings(max_examples=30)
@given(st.floats(-3.0, 3.0), st.floats(0.0, 1.2), st.floats(-3.0, 3.0), st.sampled_from([1.0, -1.0]))
def test_in_a_current_the_turn_through_the_water_counts(chi, strength, towards, side):
    """Move along an arc over ground at one speed through the water; the water track's turn is measured."""
    U, R, dt = 2.0, 20.0, 1e-4
    V = np.array([strength * math.cos(towards), strength * math.sin(towards)])

    def water_course(chi_p: float) -> tuple[float, float]:
        t = np.array([math.cos(chi_p), math.sin(chi_p)])
        n = np.array([-math.sin(chi_p), math.cos(chi_p)])
        ground = V @ t + math.sqrt(U * U - (V @ n) ** 2)
        through = ground * t - V
        return math.atan2(through[1], through[0]), ground

    before, ground = water_course(chi)
    after, _ = water_course(chi + side * ground * dt / R)
    turning = abs((after - before + math.pi) % (2.0 * math.pi) - math.pi) / dt / U
    tiny = Arc(0.0, 0.0, R, chi - side * math.pi / 2, chi - side * math.pi / 2 + side * 1e-5)
    for factor, refused in ((1.01, True), (0.99, False)):
        limited = dataclasses.replace(REMUS, turning=Turning(radius=factor / turning))
        verdicts = check(mission(tiny), limited, Current(*V.tolist()))
        assert bool(verdicts.refusals) is refused


@pytest.mark.parametrize(
    ("current", "level", "text"),
    [
        ((0.0, 1.95), "refused", "of it across the path"),
        ((-2.1, 0.0), "refused", "leaves -0.10 m/s along the path"),
        ((-1.8, 0.0), "warning", "leaves 0.20 m/s along the path"),
        ((1.0, 0.5), None, ""),
    ],
)
def test_a_current_is_held_against_the_speed(current, level, text):
    verdicts = check(mission(Line(0.0, 0.0, 100.0, 0.0)), REMUS, Current(*current))
    lines = said(verdicts)
    assert [line.split()[0] for line in lines] == ([level] if level else [])
    assert not level or text in lines[0]


def test_the_duration_counts_the_current():
    along = check(mission(Line(0.0, 0.0, 100.0, 0.0)), REMUS, Current(0.5, 0.0))
    across = check(mission(Line(0.0, 0.0, 100.0, 0.0)), REMUS, Current(0.0, 1.2))
    assert along.duration == pytest.approx(100.0 / 2.5)
    assert across.duration == pytest.approx(100.0 / 1.6)
    assert check(mission(Line(0.0, 0.0, 9.0, 0.0)), REMUS, Current(-3.0, 0.0)).duration == math.inf


def test_too_much_thrust_is_refused():
    (refusal,) = check(mission(Line(0.0, 0.0, 9.0, 0.0), thrust=7.0), REMUS).refusals
    assert (refusal.where, refusal.found) == ("thrust", "7 N")


@pytest.mark.parametrize(("thrust", "level"), [(6.48, "refused"), (300.0, "warning"), (900.0, None)])
def test_newtons_for_a_vehicle_in_rpm_are_found_by_the_speed(thrust, level):
    table = ((500.0, 0.72), (1500.0, 6.48))
    rpm = dataclasses.replace(REMUS, thrust_max=1500.0, thrust_unit="rpm", thrust_table=table)
    findings = check(mission(Line(0.0, 0.0, 900.0, 0.0), thrust=thrust), rpm)
    found = [one for one in (*findings.refusals, *findings.warnings) if one.where == "thrust"]
    assert [one.level for one in found] == ([level] if level else [])
    assert not found or f"{thrust:g} rpm, which makes" in found[0].found


CORNERS = smooth([(0, 0), (50, 0), (50, 8), (100, 8), (100, 50)], Smoothing(kind="linear"))


@pytest.mark.parametrize(
    ("mode", "radius", "overlaps"),
    [("g0", 6.0, True), ("g0", 3.9, False), ("off", 6.0, False), ("all", 26.0, True)],
)
def test_overlapping_circles_are_warned_of(mode, radius, overlaps):
    verdicts = check(mission(*CORNERS), REMUS, switching=SwitchingConfig(mode=mode, radius=radius))
    assert any("circles of acceptance" in line for line in said(verdicts)) is overlaps
    assert any("3 corners" in line for line in said(verdicts))


@pytest.mark.parametrize(
    ("mode", "radius", "lookahead", "level"),
    [
        ("g0", 6.0, 6.0, None),
        ("g0", 6.5, 6.0, "warning"),
        ("all", 12.0, 6.0, "warning"),
        ("g0", 12.5, 6.0, "refused"),
        ("g0", 1000.0, None, "refused"),  # the default's
        ("off", 1000.0, 6.0, None),
        ("g0", 12.5, 15.0, None),
    ],
)
def test_a_circle_goes_no_farther_than_the_look_ahead(mode, radius, lookahead, level):
    corner = smooth([(0, 0), (5000, 0), (5000, 5000)], Smoothing(kind="linear"))
    switching = SwitchingConfig(mode=mode, radius=radius)
    verdicts = check(mission(*corner), REMUS, switching=switching, lookahead=lookahead)
    lines = [line for line in said(verdicts) if "Rk <= Delta" in line]
    assert [line.split()[0] for line in lines] == ([level] if level else [])
    assert not lines or f"switching.radius: found {radius:g} m with a look-ahead of 6 m" in lines[0]


def test_computed_circles_are_never_too_wide_but_legs_may_be_too_short():
    legs = smooth([(0, 0), (60, 0), (60, 9), (120, 9)], Smoothing(kind="linear"))
    computed = SwitchingConfig(mode="g0", radius=0.0)
    (line,) = (line for line in said(check(mission(*legs), REMUS, switching=computed)) if "circle" in line)
    assert line.startswith("warning joint 1 at north 60.0, east 0.0")
    assert "room for a circle of acceptance of 4.5 m (likewise at 1 more), expected room for 6.0 m" in line
    sharp = smooth([(0, 0), (200, 0), (60, 80)], Smoothing(kind="linear"))
    strong = check(mission(*sharp), REMUS, Current(0.4, 0.0), switching=computed, lookahead=1.0)
    assert not strong.refusals and not any("circle" in line for line in said(strong))


def test_a_path_without_circles_does_not_mind_their_radius():
    verdicts = check(
        mission(Line(0.0, 0.0, 500.0, 0.0)), REMUS, switching=SwitchingConfig(mode="all", radius=999.0)
    )
    assert said(verdicts) == []


@pytest.mark.parametrize(("radius", "overlaps"), [(8.0, True), (9.0, False), (25.0, False)])
def test_laps_shorter_than_two_circles_are_warned_of(radius, overlaps):
    """Every lap ends where it starts; what counts is how far it goes in between."""
    lap = Arc(0.0, 0.0, radius, 0.0, 2.0 * math.pi)
    laps = dataclasses.replace(mission(lap, lap, lap), once=1)
    verdicts = check(laps, REMUS, switching=SwitchingConfig(mode="all", radius=26.0))
    assert any("joints 1 and 2" in line and "overlap" in line for line in said(verdicts)) is overlaps


def test_a_repeated_path_is_judged_once_and_lasts_longer(tmp_path):
    file = tmp_path / "eight.yaml"
    body = "version: 1\nname: e\nframe: ned\nthrust: 6.48\nrepeat: {}\n"
    body += "figure_of_eight: {{centre: [0, 0], radius: 30, separation: 120}}\n"
    file.write_text(body.format(1), encoding="utf-8")
    once = check(mission_file.load(str(file)), REMUS)
    file.write_text(body.format(5), encoding="utf-8")
    five = check(mission_file.load(str(file)), REMUS)
    assert said(five) == said(once)
    assert "crosses itself once" in said(once)[0]
    assert five.duration == pytest.approx(5.0 * once.duration)


def _brute(points) -> set[tuple[int, int]]:
    def side(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    n = len(points) - 1
    return {
        (i + 1, j + 1)
        for i in range(n)
        for j in range(i + 2, n)
        if side(points[i], points[i + 1], points[j]) * side(points[i], points[i + 1], points[j + 1]) < 0.0
        and side(points[j], points[j + 1], points[i]) * side(points[j], points[j + 1], points[i + 1]) < 0.0
    }


@settings(max_examples=60)
@example([(0, 0), (0, 3), (0, 1)])  # straight back on itself
@given(st.lists(st.tuples(st.integers(0, 40), st.integers(0, 40)), min_size=3, max_size=14, unique=True))
def test_crossings_are_those_of_a_search_of_all_pairs(points):
    found = crossings(smooth(points, Smoothing(kind="linear")))
    assert {(crossing.first, crossing.second) for crossing in found} == _brute(points)


def test_a_loop_in_one_subpath_crosses_itself():
    # x = u^2 - 1, y = u^3 - u with u = 3 t - 1.5, ten times as large: u = -1 and u = 1 meet in the origin.
    loop = Polynomial([12.5, -90.0, 90.0], [-18.75, 172.5, -405.0, 270.0])
    (crossing,) = crossings([loop])
    assert (crossing.first, crossing.second) == (1, 1)
    assert (crossing.x, crossing.y) == pytest.approx((0.0, 0.0), abs=0.05)


def test_what_runs_along_itself_does_not_cross():
    circle = Arc(0.0, 0.0, 20.0, 0.0, 2.0 * math.pi)
    assert crossings([circle, circle]) == []


@pytest.mark.parametrize(("width", "refused"), [(30, False), (20, True)])
def test_a_path_that_leaves_its_geofence_is_refused(tmp_path, width, refused):
    file = tmp_path / "m.yaml"
    file.write_text(
        "version: 1\nname: x\nframe: ned\nthrust: 6\nloiter: {centre: [0, 0], radius: 25, turns: 1}\n"
        f"geofence: [[-60, -{width}], [60, -{width}], [60, {width}], [-60, {width}]]\n"
    )
    found = check(mission_file.load(str(file)), vehicle.load("remus100"))
    assert [verdict.where for verdict in found.refusals] == (["geofence"] if refused else [])


@settings(max_examples=60)
@given(
    st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=3, max_size=7), st.integers(0, 999)
)
def test_many_points_are_in_a_polygon_as_each_of_them_is(polygon, seed: int) -> None:
    corners = [(float(x), float(y)) for x, y in polygon]
    x, y = np.random.default_rng(seed).integers(-10, 11, (2, 50)).astype(float)
    each = [limits.inside(corners, float(a), float(b)) for a, b in zip(x, y, strict=True)]
    assert _inside(corners, x, y).tolist() == each
