"""The plant against Eqs. (14)-(19) as matrices, its symmetries, and what is known in closed form."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import NO_CURRENT, STOP, Command, Current
from auv_path_following import vehicle
from auv_sim.vehicle.fins.actuator import ServoState
from auv_sim.vehicle.remus import (
    Afloat,
    PlantState,
    ground_velocity,
    navigation_of,
    planar_hull_of,
    planar_slopes,
    plant_at,
    plant_of,
    plant_step,
)

NAMES = ("remus100", "remus100_table2")
VEHICLES = {name: vehicle.load(name) for name in NAMES}
REMUS = VEHICLES["remus100"]
THRUST = 6.48

_flow = st.floats(-0.5, 0.5)
currents = st.builds(Current, _flow, _flow)
states = st.builds(
    PlantState,
    x=st.floats(-500.0, 500.0),
    y=st.floats(-500.0, 500.0),
    psi=st.floats(-7.0, 7.0),
    ur=st.floats(-1.0, 2.5),
    vr=_flow,
    r=st.floats(-0.6, 0.6),
)
rudders = st.floats(-0.61, 0.61)
commands = st.lists(
    st.tuples(st.builds(Command, rudders, st.floats(0.0, THRUST)), st.floats(0.02, 1.0)),
    min_size=1,
    max_size=6,
)


def mirrored(state):
    """The same seen in a mirror along the north axis."""
    x, y, psi, ur, vr, r = state
    return PlantState(x, -y, -psi, ur, -vr, -r)


def afloat(state: PlantState, course, name="remus100", current=NO_CURRENT) -> Afloat:
    """The plant after a course: a list of (command, seconds)."""
    config, plant = plant_of(VEHICLES[name]), plant_at(state)
    for command, dt in course:
        plant, motion = plant_step(config, plant, (command, current, 1.0), dt)
        assert motion == plant.hull
    return plant


def flown(state: PlantState, course, name="remus100", current=NO_CURRENT) -> PlantState:
    return afloat(state, course, name, current).hull


def slopes(name, state, delta, thrust, current=NO_CURRENT):
    x_dot, y_dot, *rest = planar_slopes(planar_hull_of(VEHICLES[name]), *state[2:], delta, thrust)
    return [x_dot + current.Vx, y_dot + current.Vy, state.r, *rest]


@given(st.sampled_from(NAMES), states, rudders, st.floats(0.0, THRUST), currents)
def test_derivative_is_eqs_14_18_19(name, state, delta, thrust, current):
    hull = VEHICLES[name].hull
    _, _, psi, ur, vr, r = state
    M = np.array(
        [
            [hull.m - hull.Xud, 0.0, 0.0],
            [0.0, hull.m - hull.Yvd, -hull.Yrd],
            [0.0, -hull.Nvd, hull.Izz - hull.Nrd],
        ]
    )
    SX = hull.Xuu * ur * abs(ur) + hull.Xvr * vr * r + hull.Xrr * r**2 + thrust
    if hull.surge_coupling:
        SX += hull.m * vr * r
    SY = hull.Yvv * vr * abs(vr) + hull.Yrr * r * abs(r) + hull.Yur * ur * r - hull.m * ur * r
    SY += hull.Yuv * ur * vr + hull.Yuud * ur**2 * delta
    SN = hull.Nvv * vr * abs(vr) + hull.Nrr * r * abs(r) + hull.Nur * ur * r + hull.Nuv * ur * vr
    SN += hull.Nuud * ur**2 * delta
    R = np.array([[math.cos(psi), -math.sin(psi)], [math.sin(psi), math.cos(psi)]])
    expected = [*(R @ [ur, vr] + current), r, *np.linalg.solve(M, [SX, SY, SN])]
    assert slopes(name, state, delta, thrust, current) == pytest.approx(expected, rel=1e-10, abs=1e-12)


def test_the_two_hulls_differ_where_they_should():
    assert VEHICLES["remus100"].hull.surge_coupling
    assert not VEHICLES["remus100_table2"].hull.surge_coupling


@settings(max_examples=40)
@given(st.sampled_from(NAMES), states, commands, currents)
def test_port_and_starboard_are_mirror_images(name, state, course, current):
    other = [(Command(-command.rudder, command.thrust), dt) for command, dt in course]
    here = afloat(state, course, name, current)
    there = afloat(mirrored(state), other, name, Current(current.Vx, -current.Vy))
    assert there.hull == pytest.approx(mirrored(here.hull), rel=1e-9, abs=1e-9)
    assert there.servo.angle == -here.servo.angle


@settings(max_examples=40)
@given(states, commands, currents)
def test_a_steady_current_carries_the_track_along_and_changes_nothing_else(state, course, current):
    still, moving = flown(state, course), flown(state, course, current=current)
    seconds = sum(dt for _, dt in course)
    assert moving.x == pytest.approx(still.x + current.Vx * seconds, abs=1e-8)
    assert moving.y == pytest.approx(still.y + current.Vy * seconds, abs=1e-8)
    assert moving[2:] == still[2:]


@settings(max_examples=40)
@given(states, commands, st.floats(-3.0, 3.0))
def test_turning_the_world_changes_nothing(state, course, turn):
    c, s = math.cos(turn), math.sin(turn)

    def turned(p):
        return PlantState(c * p.x - s * p.y, s * p.x + c * p.y, p.psi + turn, p.ur, p.vr, p.r)

    here, there = flown(state, course), flown(turned(state), course)
    assert there == pytest.approx(turned(here), rel=1e-9, abs=1e-8)


@pytest.mark.parametrize("thrust", [THRUST, 2.0])
@pytest.mark.parametrize("name", NAMES)
def test_speed_ahead_is_the_closed_solution(name, thrust):
    """Straight ahead (m - Xud) ur' = XT - |Xuu| ur^2, which tanh solves; at the end ur = sqrt(XT/|Xuu|)."""
    hull = VEHICLES[name].hull
    terminal = math.sqrt(thrust / -hull.Xuu)
    state = PlantState(0.0, 0.0, 0.3, 0.0, 0.0, 0.0)
    for k in range(1, 101):
        state = flown(state, [(Command(0.0, thrust), 1.0)], name)
        expected = terminal * math.tanh(k * -hull.Xuu * terminal / (hull.m - hull.Xud))
        assert state.ur == pytest.approx(expected, rel=1e-8)
    assert state.ur == pytest.approx(terminal, rel=1e-3)
    assert (state.vr, state.r, state.psi) == (0.0, 0.0, 0.3)
    assert state.y == pytest.approx(state.x * math.tan(0.3))


@pytest.mark.parametrize(("thrust", "used"), [(100.0, THRUST), (-5.0, 0.0)])
def test_thrust_is_limited_to_what_the_vehicle_can(thrust, used):
    start = PlantState(0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    assert flown(start, [(Command(0.0, thrust), 5.0)]) == flown(start, [(Command(0.0, used), 5.0)])


def test_the_efficiency_is_a_share_of_the_thrust_as_limited():
    start, config = plant_at(PlantState(0.0, 0.0, 0.0, 1.0, 0.0, 0.0)), plant_of(REMUS)
    weak, _ = plant_step(config, start, (Command(0.0, 100.0), NO_CURRENT, 0.5), 5.0)
    assert weak.hull == flown(start.hull, [(Command(0.0, 0.5 * REMUS.thrust_max), 5.0)])


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("delta", [0.2, -0.2])
def test_positive_rudder_turns_to_port(name, delta):
    state = flown(PlantState(0.0, 0.0, 0.0, 1.9, 0.0, 0.0), [(Command(delta, THRUST), 5.0)], name)
    assert state.r * delta < 0.0
    assert state.psi * delta < 0.0
    assert state.y * delta < 0.0


@pytest.mark.parametrize("moving_rudder", [False, True], ids=["rudder at rest", "rudder turning"])
def test_runge_kutta_is_of_fourth_order(moving_rudder):
    """Halving the step divides the error by 16. Sway and yaw keep their signs, so Eq. (19) is smooth here."""
    start = PlantState(0.0, 0.0, 0.2, 1.9, 0.05, -0.15)
    seconds = 2.0 if moving_rudder else 4.0

    def end(max_step):
        plant = Afloat(start, ServoState(0.05 if moving_rudder else 0.2))
        inputs = Command(0.6 if moving_rudder else 0.2, THRUST), NO_CURRENT, 1.0
        config = plant_of(REMUS)._replace(max_step=max_step)
        return np.array(plant_step(config, plant, inputs, seconds)[1])

    exact = end(0.0025)
    assert exact[4] > 0.0 > exact[5]
    errors = [np.abs(end(step) - exact).max() for step in (0.1, 0.05, 0.025)]
    assert errors[2] < 1e-6
    for coarse, fine in itertools.pairwise(errors):
        assert 12.0 < coarse / fine < 22.0


def test_a_long_step_is_divided_evenly():
    start = PlantState(0.0, 0.0, 0.0, 1.9, 0.0, 0.0)
    long = flown(start, [(Command(0.3, THRUST), 0.12)])
    assert long == pytest.approx(flown(start, [(Command(0.3, THRUST), 0.04)] * 3), abs=1e-14)


def test_the_shipped_step_is_fine_enough():
    """10, 20 and 50 Hz agree to a millimetre over a minute of hard rudder."""
    ends = []
    for rate in (10, 20, 50):
        course = [
            (Command(0.4 if k // (10 * rate) % 2 else -0.4, THRUST), 1.0 / rate) for k in range(60 * rate)
        ]
        ends.append(flown(PlantState(0.0, 0.0, 0.0, 1.9, 0.0, 0.0), course))
    for end in ends[:2]:
        assert end[:2] == pytest.approx(ends[2][:2], abs=1e-3)


@given(states, currents)
def test_velocity_over_ground_is_that_of_the_position(state, current):
    """Eqs. (15) and (16) with the signs that follow from Eq. (14): turned to the world they give (x', y')."""
    u, v = ground_velocity(state, current)
    x_dot, y_dot, *_ = slopes("remus100", state, 0.0, 0.0, current)
    assert math.cos(state.psi) * u - math.sin(state.psi) * v == pytest.approx(x_dot, abs=1e-12)
    assert math.sin(state.psi) * u + math.cos(state.psi) * v == pytest.approx(y_dot, abs=1e-12)


@pytest.mark.parametrize(
    ("psi", "expected"),
    [(0.0, (1.1, 0.2)), (math.pi / 2, (1.2, -0.1)), (math.pi, (0.9, -0.2)), (-math.pi / 2, (0.8, 0.1))],
    ids=["north", "east", "south", "west"],
)
def test_eq_15_on_the_four_headings(psi, expected):
    state = PlantState(0.0, 0.0, psi, 1.0, 0.0, 0.0)
    assert ground_velocity(state, Current(0.1, 0.2)) == pytest.approx(expected)


def test_an_ideal_navigation_is_the_state():
    assert navigation_of(PlantState(1.0, 2.0, 9.0, 1.5, -0.1, 0.2)) == (1.0, 2.0, 9.0, 0.2)


def test_left_alone_it_slows_down_on_its_course():
    state = flown(PlantState(0.0, 0.0, 0.5, 1.9, 0.0, 0.0), [(STOP, 60.0)])
    assert 0.0 < state.ur < 0.5
    assert state.psi == 0.5
