"""Guidance as a whole, with a vehicle whose heading is always the desired one."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.types import NO_CURRENT, Current, Navigation, WaterVelocity
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.guidance.acceptance import Cornering
from auv_path_following.guidance.approach import Agility, ApproachConfig
from auv_path_following.guidance.laws.adaptive_lookahead import AdaptiveLookaheadConfig
from auv_path_following.guidance.laws.ailos import AilosConfig
from auv_path_following.guidance.laws.ilos import IlosConfig
from auv_path_following.guidance.laws.los import LosConfig
from auv_path_following.guidance.path_follower import PathFollower, PathFollowerConfig
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.guidance.virtual_point import VirtualPointConfig

SPEED, DT = 1.9, 0.05
STILL = WaterVelocity(0.0, 0.0)
AHEAD = WaterVelocity(SPEED, 0.0)


def config(mode="off", **keys):
    return PathFollowerConfig(
        ailos=AilosConfig(lookahead=6.0),
        virtual_point=VirtualPointConfig(k=1.0),
        switching=SwitchingConfig(mode=mode, radius=6.0),
        **keys,
    )


def line():
    return CompositePath([Line(0.0, 0.0, 150.0, 0.0)])


def corner():
    return CompositePath([Line(0.0, 0.0, 60.0, 0.0), Line(60.0, 0.0, 60.0, math.pi / 2)])


def circle():
    return CompositePath([Arc(0.0, 0.0, 30.0, 0.0, 1.5 * math.pi)])


def glide(follower, x, y, current=NO_CURRENT, known=True, seconds=120.0, vr=0.0):
    """A vehicle whose heading is always the desired one; yields navigation and output of each step."""
    psi, water = follower.look(Navigation(x, y, 0.0, 0.0)).chi_p, WaterVelocity(SPEED, vr)
    for k in range(int(seconds / DT)):
        navigation = Navigation(x, y, psi, 0.0)
        output = follower.update(navigation, water, current if known else NO_CURRENT, DT if k else 0.0)
        yield navigation, output
        if output.finished:
            return
        psi = output.psi_d
        x += (SPEED * math.cos(psi) - vr * math.sin(psi) + current.Vx) * DT
        y += (SPEED * math.sin(psi) + vr * math.cos(psi) + current.Vy) * DT


@pytest.mark.parametrize("offset", [12.0, -12.0])
@pytest.mark.parametrize("vr", [0.0, 0.2])
@pytest.mark.parametrize("current", [NO_CURRENT, Current(0.3, -0.4)])
def test_from_either_side_it_comes_onto_the_line_and_reaches_the_end(offset, vr, current):
    follower = PathFollower(line(), config())
    outputs = [output for _, output in glide(follower, 0.0, offset, current, vr=vr)]
    assert outputs[0].ye == pytest.approx(offset)
    assert all(output.ye * offset > -1e-3 for output in outputs)  # it does not cross over
    assert abs(outputs[-1].ye) < 1e-3
    assert outputs[-1].finished
    assert follower.distance_to_go == 0.0
    assert outputs[-1].s == 1.0


@pytest.mark.parametrize("start", [(32.0, 5.0), (26.0, -6.0)])
def test_on_an_arc_the_errors_energy_falls_all_the_time(start):
    """V1 of Eq. (33), (xe^2 + ye^2)/2, falls once P moves, with a known current too."""
    follower = PathFollower(circle(), config())
    V1 = [
        0.5 * (output.xe**2 + output.ye**2)
        for _, output in glide(follower, *start, Current(0.1, 0.2), seconds=25.0)
    ]
    assert V1[0] > 10.0
    assert all(after < before + 1e-4 for before, after in itertools.pairwise(V1))
    assert V1[-1] < 2e-3


def test_an_unknown_current_leaves_an_offset_and_compensation_takes_it_away():
    current = Current(0.0, 0.4)

    def final(compensate, known=True):
        follower = PathFollower(line(), config(compensate_current=compensate))
        return [output for _, output in glide(follower, 0.0, 0.0, current, known)][-1].ye

    # Where the current is ignored the track settles where SPEED ye / sqrt(Delta^2 + ye^2) = Vy.
    settled = 6.0 * 0.4 / math.sqrt(SPEED**2 - 0.4**2)
    assert final(compensate=False) == pytest.approx(settled, rel=1e-2)
    assert final(compensate=True, known=False) == pytest.approx(settled, rel=1e-2)
    assert abs(final(compensate=True)) < 1e-6


def test_signals_fit_together():
    follower = PathFollower(circle(), config())
    for navigation, output in glide(follower, 33.0, 1.0, Current(0.1, 0.1), vr=0.1):
        if output.finished:
            break
        assert output.psi_d == pytest.approx(wrap(output.chi_p + output.chi_r - output.beta_r))
        assert -math.pi <= output.psi_d <= math.pi
        assert output.psi_e == pytest.approx(wrap(navigation.psi - output.psi_d), abs=1e-12)
        assert output.r_d == output.kappa * output.U_P  # Eq. (9)
        assert output.kappa == pytest.approx(1.0 / 30.0)
        assert output.beta_r == pytest.approx(math.atan2(0.1, SPEED))
        assert output.s == pytest.approx(1.0 - follower.distance_to_go / (45.0 * math.pi))
        assert math.hypot(output.x_p - navigation.x, output.y_p - navigation.y) == pytest.approx(
            math.hypot(output.xe, output.ye)
        )


def test_feed_forward_is_the_rate_of_the_paths_course():
    outputs = [output for _, output in glide(PathFollower(circle(), config()), 30.0, 0.0, seconds=20.0)]
    for before, after in itertools.pairwise(outputs[5:]):
        assert wrap(after.chi_p - before.chi_p) / DT == pytest.approx(before.r_d, abs=1e-9)


@pytest.mark.parametrize(("mode", "switches_at"), [("off", 60.0), ("g0", 54.0)])
def test_where_it_turns_at_a_corner(mode, switches_at):
    steps = list(glide(PathFollower(corner(), config(mode)), 0.0, 0.0))
    switched = [
        (navigation, output) for navigation, output in steps if output.switched and not output.finished
    ]
    assert len(switched) == 1
    navigation, output = switched[0]
    assert navigation.x == pytest.approx(switches_at, abs=SPEED * DT)
    assert output.i == 1
    # P begins the second leg at its start, but for what a step of the first one led beyond.
    assert (output.x_p, output.y_p) == pytest.approx((60.0, 0.0), abs=0.0 if mode == "g0" else SPEED * DT)
    indices = [output.i for _, output in steps]
    assert indices == sorted(indices)


def test_after_an_early_switch_p_waits_for_the_vehicle_without_feed_forward():
    path = CompositePath([Line(0.0, 0.0, 60.0, 0.0), Arc(30.0, 0.0, 30.0, 0.0, math.pi)])
    follower = PathFollower(path, config("g0"))
    # The next subpath begins eastwards; the vehicle is still 4 m west of it and points north.
    follower.place_at(0, 0.95)
    follower.update(Navigation(57.0, -1.0, 0.0, 0.0), AHEAD, NO_CURRENT, 0.0)
    behind = Navigation(58.0, -4.0, 0.0, 0.0)
    for k in range(20):
        output = follower.update(behind, AHEAD, NO_CURRENT, DT)
        assert output.switched is (k == 0)
        assert (output.i, output.s, output.U_P, output.r_d) == (1, 1.0, 0.0, 0.0)
        assert output.xe == pytest.approx(-4.0)
    output = follower.update(Navigation(61.0, 1.0, 0.5, 0.0), AHEAD, NO_CURRENT, DT)
    assert output.U_P > 0.0
    assert output.r_d == pytest.approx(output.U_P / 30.0)


def test_looking_moves_nothing_and_asks_for_the_present_heading():
    follower = PathFollower(line(), config())
    follower.update(Navigation(0.0, 0.0, 0.0, 0.0), AHEAD, NO_CURRENT, 0.0)
    output = follower.look(Navigation(5.0, -3.0, 0.7, 0.1))
    assert (output.psi_d, output.r_d, output.U_P, output.psi_e) == (0.7, 0.0, 0.0, 0.0)
    assert (output.xe, output.ye) == pytest.approx((5.0, -3.0))
    # P rests until the next update sets its speed, however long that takes.
    later = follower.update(Navigation(5.0, -3.0, 0.7, 0.1), AHEAD, NO_CURRENT, 100.0)
    assert later.s == 0.0
    assert not later.finished


def test_new_gains_keep_the_place_on_the_path_and_reset_does_not():
    follower = PathFollower(corner(), config())
    for _ in glide(follower, 0.0, 0.0, seconds=40.0):
        pass
    before = follower.s
    assert before > 1.0
    wide = PathFollowerConfig(
        ailos=AilosConfig(lookahead=12.0), virtual_point=VirtualPointConfig(k=0.5, saturation=50.0)
    )
    follower.configure(wide)
    assert follower.s == before
    y, x = 2.0, 60.0 + 12.0
    output = follower.update(Navigation(x, y, math.pi / 2, 0.0), STILL, NO_CURRENT, 0.0)
    assert output.chi_r == pytest.approx(math.atan(12.0 / 12.0))  # 12 m to port of the leg to the east
    drawn = 0.5 * output.xe
    assert pytest.approx(drawn) == output.U_P
    follower.reset()
    assert follower.look(Navigation(0.0, 0.0, 0.0, 0.0)).s == 0.0


def test_the_laws_memory_is_kept_for_new_gains_and_lost_after_a_hold_and_with_another_law():
    aside, wide = Navigation(5.0, 3.0, 0.0, 0.0), IlosConfig(lookahead=9.0)
    follower = PathFollower(line(), config(law="ilos"))
    for _ in range(3):
        follower.update(aside, AHEAD, NO_CURRENT, DT)
    integral = follower.state.law.integral
    assert integral > 0.0
    follower.configure(config(law="ilos", ilos=wide))
    assert follower.state.law.integral == integral
    follower.rejoin(aside)
    assert follower.state.law.integral == 0.0
    follower.update(aside, AHEAD, NO_CURRENT, DT)
    for law in ("los", "ilos"):
        follower.configure(config(law=law))
    assert follower.state.law.integral == 0.0


def test_the_end_of_the_path_is_final():
    follower = PathFollower(line(), config())
    for _ in glide(follower, 0.0, 0.0):
        pass
    for x in (100.0, 200.0):
        output = follower.update(Navigation(x, 0.0, 0.0, 0.0), AHEAD, NO_CURRENT, DT)
        assert (output.finished, output.switched, output.s, output.r_d) == (True, False, 1.0, 0.0)


def test_the_look_ahead_is_that_of_the_law_that_was_chosen():
    adaptive = AdaptiveLookaheadConfig(enabled=True, hull_length=2.0, largest=4.0)
    keys = {"ilos": IlosConfig(lookahead=7.0), "los": LosConfig(lookahead=8.0)}
    found = [
        PathFollowerConfig(law=law, ailos=AilosConfig(lookahead=5.0), **keys).lookahead
        for law in ("ailos", "ilos", "los")
    ]
    assert found == [5.0, 7.0, 8.0]
    assert PathFollowerConfig(ailos=AilosConfig(lookahead=5.0, adaptive=adaptive)).lookahead == 8.0


@pytest.mark.parametrize("mode", ["g0", "all"])
def test_every_lap_is_flown(mode):
    """A closed subpath has its joint where it starts."""
    corners = [(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0), (0.0, 0.0)]
    lap = Spline(corners) if mode == "g0" else Arc(0.0, 0.0, 20.0, 0.0, 2.0 * math.pi)
    path = CompositePath([lap] * 3)
    start = path.at(0.0)
    steps = list(glide(PathFollower(path, config(mode)), start.x, start.y, seconds=600.0))
    assert steps[-1][1].finished
    assert [output.i for _, output in steps if output.switched] == [1, 2, 2]
    # The circle saves a few metres at each joint.
    assert len(steps) * DT * SPEED == pytest.approx(path.length, rel=0.1)


def dense_circle(radius=30.0, spacing=0.05):
    """Three quarters of a circle from its southern end on, given as points."""
    angles = np.arange(0.0, 1.5 * math.pi, spacing / radius)
    points = [(radius * math.sin(a), radius * (1.0 - math.cos(a))) for a in angles]
    return CompositePath(
        [
            Line(*a, math.dist(a, b), math.atan2(b[1] - a[1], b[0] - a[0]))
            for a, b in itertools.pairwise(points)
        ]
    )


@pytest.mark.parametrize("spacing", [0.05, 0.5, 2.0])
def test_a_circle_given_as_points_is_followed(spacing):
    """P keeps up with the vehicle, and circles of acceptance wider than the subpaths do not send it ahead."""
    path = dense_circle(spacing=spacing)
    steps = list(glide(PathFollower(path, config("g0")), 0.0, 0.0))
    assert steps[-1][1].finished
    assert len(steps) * DT == pytest.approx(path.length / SPEED, rel=0.02)
    assert max(abs(math.hypot(n.x, n.y - 30.0) - 30.0) for n, _ in steps) < 0.3


def test_a_line_given_as_points_ends_at_its_end():
    path = CompositePath([Line(0.05 * k, 0.0, 0.05, 0.0) for k in range(1200)])
    steps = list(glide(PathFollower(path, config("g0")), 0.0, 0.0))
    assert steps[-1][1].finished
    assert steps[-1][0].x == pytest.approx(60.0, abs=0.2)


def test_a_circle_of_acceptance_does_not_count_before_the_subpath_was_joined():
    follower = PathFollower(corner(), config("g0"))
    beside = Navigation(57.0, -4.0, 0.0, 0.0)  # inside the circle, 4 m beside the first leg
    follower.place_at(0, 0.9)
    assert [follower.update(beside, STILL, NO_CURRENT, DT).i for _ in range(5)] == [0] * 5
    near = Navigation(57.0, -1.0, 0.0, 0.0)
    assert [follower.update(near, STILL, NO_CURRENT, DT).i for _ in range(2)] == [0, 1]


def test_far_from_the_path_the_references_stay_what_a_hull_can_turn():
    """P is drawn by 500 m of xe along a tight arc."""
    path = CompositePath([Arc(0.0, 0.0, 15.0, 0.0, 6.0)])
    agility = Agility(speed=2.0, turn_rate=0.3, cornering=Cornering(rate=0.4, lead=1.0))
    bare = PathFollowerConfig(approach=ApproachConfig(enabled=False))
    for _, output in glide(PathFollower(path, bare, agility), 300.0, 400.0, seconds=60.0):
        assert abs(output.r_d) <= 0.3
        assert abs(output.U_P) <= SPEED + 6.0 + 1e-9
