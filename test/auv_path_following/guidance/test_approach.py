"""The way to a path's start from anywhere: planned, flown by the same law, planned anew where it must be."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import NO_CURRENT, Current, Navigation, WaterVelocity
from auv_path_following import vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.dubins import PlanarPose, connect
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.rows import AFTER, KIND, LENGTH, LINE, F, PathRows, evaluate
from auv_path_following.guidance.acceptance import Cornering
from auv_path_following.guidance.approach import (
    Agility,
    ApproachConfig,
    ApproachWatch,
    agility_of,
    empty_approach,
    is_at,
    plan,
    turn_radius,
)
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.guidance.path_follower import PathFollower, PathFollowerConfig
from auv_path_following.guidance.switching import SwitchingConfig

SPEED, DT = 1.9, 0.1
AHEAD = WaterVelocity(SPEED, 0.0)
AGILITY = Agility(speed=SPEED, turn_rate=0.35, cornering=Cornering(rate=0.35, lead=0.5))
CONFIG = PathFollowerConfig(switching=SwitchingConfig(mode="all", radius=6.0))
#: North, east, north; with circles of acceptance at both joints.
PATH = CompositePath(
    [Line(0.0, 0.0, 60.0, 0.0), Line(60.0, 0.0, 60.0, math.pi / 2), Line(60.0, 60.0, 60.0, 0.0)]
)


def fly(follower: PathFollower, start: Navigation, current: Current = NO_CURRENT, seconds: float = 600.0):
    """A vehicle that turns to the desired heading at the hull's rate; yields navigation and output."""
    x, y, psi = start[:3]
    for k in range(int(seconds / DT)):
        navigation = Navigation(x, y, psi, 0.0)
        output = follower.update(navigation, AHEAD, current, DT if k else 0.0)
        yield navigation, output
        if output.finished:
            return
        most = AGILITY.turn_rate * DT
        psi -= min(max(output.psi_e, -most), most)
        x += (SPEED * math.cos(psi) + current.Vx) * DT
        y += (SPEED * math.sin(psi) + current.Vy) * DT


@pytest.mark.parametrize("name", ["remus100", "remus100_mismatch", "remus100_table2"])
@pytest.mark.parametrize("lookahead", [2.0, 5.2])
def test_the_turns_leave_the_hull_a_margin_in_a_following_current(name: str, lookahead: float) -> None:
    agility = agility_of(vehicle.load(name), 6.48)
    radius = turn_radius(ApproachConfig(), agility, lookahead)
    assert (agility.speed + 0.4) / radius <= 0.6 * agility.turn_rate * (1.0 + 1e-12)
    assert radius >= 2.0 * lookahead
    assert turn_radius(ApproachConfig(radius=25.0), agility, lookahead) == 25.0


@pytest.mark.parametrize(
    ("x", "y", "off", "near"),
    [(0, 0, 0, True), (2.9, 0, 59, True), (0, -2.9, -59, True), (3.1, 0, 0, False), (0, 0, 61, False)],
)
def test_near_means_three_metres_and_sixty_degrees(x: float, y: float, off: float, near: bool) -> None:
    psi = math.pi - 0.1 + math.radians(off)  # across the seam of the angles
    assert is_at(50.0 + x, 20.0 + y, psi, 50.0, 20.0, math.pi - 0.1) is near
    start = Navigation(50.0 + x, 20.0 + y, psi, 0.0)
    legs = plan(empty_approach(), PlanarPose(50.0, 20.0, math.pi - 0.1), start, 10.0)
    assert (legs == 0) is near


@pytest.mark.parametrize(("behind", "length"), [(5.0, 5.0), (20.0, 20.0), (-5.0, None)])
def test_the_last_leg_is_straight_unless_the_vehicle_is_too_close_for_it(
    behind: float, length: float | None
) -> None:
    approach = empty_approach()
    legs = plan(approach, PlanarPose(0.0, 0.0, 0.0), Navigation(-behind, 0.0, 0.0, 0.0), 12.0)
    end = approach[legs - 1]
    x, y, dx, dy, _, _ = evaluate(PathRows(legs, approach, ()), end, 1.0)
    assert (x, y) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert (end[KIND], math.atan2(dy, dx)) == (LINE, pytest.approx(0.0, abs=1e-9))
    if length is None:
        assert end[LENGTH] == pytest.approx(12.0)
    else:
        assert approach[0][LENGTH] + approach[0][AFTER] == pytest.approx(length)


@given(st.floats(-90.0, 90.0), st.floats(-90.0, 90.0), st.floats(-4.0, 4.0), st.floats(4.0, 20.0))
def test_its_rows_are_those_of_a_dubins_path_and_a_leg(x: float, y: float, psi: float, radius: float):
    goal = PlanarPose(10.0, -20.0, 0.5)
    before = PlanarPose(goal.x - radius * math.cos(goal.chi), goal.y - radius * math.sin(goal.chi), goal.chi)
    direct = CompositePath(connect(PlanarPose(x, y, psi), goal, radius))
    leg = Line(before.x, before.y, radius, goal.chi)
    settled = CompositePath([*connect(PlanarPose(x, y, psi), before, radius), leg])
    approach = empty_approach()
    legs = plan(approach, goal, Navigation(x, y, psi, 0.0), radius)
    if legs == 0:
        return
    expected = settled if settled.length <= direct.length + 2.0 * radius else direct
    assert legs == expected.n
    for row, i in zip(approach, range(legs), strict=False):
        assert row[KIND:F] == list(expected.rows.subpath[i][KIND:F])
        assert row[LENGTH : AFTER + 1] == list(expected.rows.subpath[i][LENGTH : AFTER + 1])


@pytest.mark.parametrize("seed", range(12))
def test_from_anywhere_the_start_is_reached_first_and_then_every_leg(seed: int) -> None:
    draw = np.random.default_rng(seed)
    x, y = draw.uniform(-150.0, 150.0, 2)
    current = Current(*draw.uniform(-0.28, 0.28, 2))
    start = Navigation(float(x), float(y), float(draw.uniform(-math.pi, math.pi)), 0.0)
    follower = PathFollower(PATH, CONFIG, AGILITY)
    to_go, steps = [], []
    for step in fly(follower, start, current):
        steps.append(step)
        to_go.append(follower.distance_to_go)
    outputs: list[GuidanceOutput] = [output for _, output in steps]
    assert outputs[-1].finished
    approaching = [output.approach > 0.0 for output in outputs]
    joined = approaching.index(False)
    assert joined > 0 and not any(approaching[joined:])
    assert {(o.i, o.s) for o in outputs[:joined]} == {(0, 0.0)}
    assert math.hypot(*steps[joined][0][:2]) < 1.0
    assert to_go[0] > PATH.length
    assert all(0.0 < a - b < 1.5 for a, b in itertools.pairwise(to_go[:joined]))
    assert max(math.hypot(o.xe, o.ye) for o in outputs[:joined]) < 1.0
    assert max(abs(o.r_d) for o in outputs) <= AGILITY.turn_rate
    # No leg is left out: every one is entered within the circle at its start.
    switches = [n for n, o in steps if o.switched and not o.finished]
    assert [math.hypot(n.x - 60.0, n.y - 60.0 * k) < 6.01 for k, n in enumerate(switches)] == [True, True]


@pytest.mark.parametrize("config", [PathFollowerConfig(approach=ApproachConfig(enabled=False)), CONFIG])
def test_at_the_start_or_where_it_is_off_there_is_none(config: PathFollowerConfig) -> None:
    away = 0.0 if config.approach.enabled else 40.0
    output = PathFollower(PATH, config, AGILITY).update(
        Navigation(2.0, away, 0.5, 0.0), AHEAD, NO_CURRENT, 0.0
    )
    assert (output.approach, output.x_p, output.y_p) == (0.0, 0.0, 0.0)


def test_a_hold_on_the_way_plans_anew_and_one_on_the_path_rejoins() -> None:
    follower = PathFollower(PATH, CONFIG, AGILITY)
    for _ in fly(follower, Navigation(-60.0, -40.0, 2.0, 0.0), seconds=10.0):
        pass
    carried = Navigation(-30.0, -60.0, -1.0, 0.0)
    follower.rejoin(carried)
    output = follower.update(carried, AHEAD, NO_CURRENT, 0.0)
    assert (output.x_p, output.y_p, output.chi_p) == pytest.approx((-30.0, -60.0, -1.0))
    assert output.s == 0.0 < output.approach
    on_leg = next(navigation for navigation, output in fly(follower, carried) if output.s > 0.5)
    carried = on_leg._replace(x=on_leg.x + 10.0)
    follower.rejoin(carried)
    after = follower.update(carried, AHEAD, NO_CURRENT, 0.0)
    assert after.approach == 0.0
    assert after.x_p == pytest.approx(carried.x, abs=0.1)


def test_a_vehicle_carried_off_its_approach_gets_a_new_one() -> None:
    follower = PathFollower(PATH, CONFIG, AGILITY)
    follower.update(Navigation(-100.0, 0.0, 0.0, 0.0), AHEAD, NO_CURRENT, 0.0)
    away = Navigation(-95.0, 30.0, 0.0, 0.0)
    assert follower.update(away, AHEAD, NO_CURRENT, DT).ye == pytest.approx(30.0)
    output = follower.update(away, AHEAD, NO_CURRENT, DT)
    assert (output.xe, output.ye) == pytest.approx((0.0, 0.0))


def test_an_approach_that_ends_beside_the_start_is_flown_again() -> None:
    """P reaches the end of the approach while an unmeasured current keeps the vehicle 5 m off."""
    follower = PathFollower(PATH, CONFIG, AGILITY)
    x = -20.0
    for k in range(400):
        output = follower.update(
            Navigation(x, 5.0 if k else 0.0, 0.0, 0.0), AHEAD, NO_CURRENT, DT if k else 0.0
        )
        x += SPEED * DT
        if x > 2.0:
            break
    assert output.s == 0.0
    assert output.approach > 50.0


def test_the_watch_names_the_phase_its_changes_and_an_approach_that_takes_long() -> None:
    watch = ApproachWatch()
    assert watch.update(123.4, 0.0) == "approaching: 123 m to the path's start"
    assert watch.update(100.0, 50.0) == ""
    assert (watch.phase, watch.complaint(60.0)) == ("approaching: 100 m to the path's start", "")
    assert watch.update(90.0, 20.0) == ""
    assert watch.complaint(60.0) == "the approach to the path's start takes more than 60 s"
    assert watch.update(0.0, 1.0) == "the path's start is reached"
    assert (watch.update(0.0, 1.0), watch.phase, watch.complaint(60.0)) == ("", "on the path", "")
