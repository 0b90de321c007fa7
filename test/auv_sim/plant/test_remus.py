"""The plant against Eqs. (14)-(19) as matrices, its symmetries, and what is known in closed form."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.types import NO_CURRENT, STOP, Command, Current
from auv_path_following import vehicle
from auv_sim.plant.remus import PlantState, RemusDynamics, RemusPlant

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


def flown(name, state, course, current=NO_CURRENT, mirror=False):
    plant = RemusPlant(VEHICLES[name], mirrored(state) if mirror else state)
    for command, dt in course:
        plant.advance(Command(-command.rudder, command.thrust) if mirror else command, dt, current)
    return plant


@settings(deadline=None)
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
    found = RemusDynamics(VEHICLES[name]).derivative(state, delta, thrust, current)
    assert found == pytest.approx(expected, rel=1e-10, abs=1e-12)


def test_the_two_hulls_differ_where_they_should():
    assert VEHICLES["remus100"].hull.surge_coupling
    assert not VEHICLES["remus100_table2"].hull.surge_coupling


@settings(deadline=None, max_examples=40)
@given(st.sampled_from(NAMES), states, commands, currents)
def test_port_and_starboard_are_mirror_images(name, state, course, current):
    here = flown(name, state, course, current)
    there = flown(name, state, course, Current(current.Vx, -current.Vy), mirror=True)
    assert there.state == pytest.approx(mirrored(here.state), rel=1e-9, abs=1e-9)
    assert there.rudder.angle == -here.rudder.angle


@settings(deadline=None, max_examples=40)
@given(states, commands, currents)
def test_a_steady_current_carries_the_track_along_and_changes_nothing_else(state, course, current):
    still, moving = flown("remus100", state, course), flown("remus100", state, course, current)
    seconds = sum(dt for _, dt in course)
    assert moving.state.x == pytest.approx(still.state.x + current.Vx * seconds, abs=1e-8)
    assert moving.state.y == pytest.approx(still.state.y + current.Vy * seconds, abs=1e-8)
    assert moving.state[2:] == still.state[2:]


@settings(deadline=None, max_examples=40)
@given(states, commands, st.floats(-3.0, 3.0))
def test_turning_the_world_changes_nothing(state, course, turn):
    c, s = math.cos(turn), math.sin(turn)

    def turned(p):
        return PlantState(c * p.x - s * p.y, s * p.x + c * p.y, p.psi + turn, p.ur, p.vr, p.r)

    here, there = flown("remus100", state, course), flown("remus100", turned(state), course)
    assert there.state == pytest.approx(turned(here.state), rel=1e-9, abs=1e-8)


@pytest.mark.parametrize("thrust", [THRUST, 2.0])
@pytest.mark.parametrize("name", NAMES)
def test_speed_ahead_is_the_closed_solution(name, thrust):
    """Straight ahead (m - Xud) ur' = XT - |Xuu| ur^2, which tanh solves; at the end ur = sqrt(XT/|Xuu|)."""
    hull = VEHICLES[name].hull
    terminal = math.sqrt(thrust / -hull.Xuu)
    plant = RemusPlant(VEHICLES[name], PlantState(0.0, 0.0, 0.3, 0.0, 0.0, 0.0))
    for k in range(1, 101):
        plant.advance(Command(0.0, thrust), 1.0)
        expected = terminal * math.tanh(k * -hull.Xuu * terminal / (hull.m - hull.Xud))
        assert plant.state.ur == pytest.approx(expected, rel=1e-8)
    assert plant.state.ur == pytest.approx(terminal, rel=1e-3)
    assert (plant.state.vr, plant.state.r, plant.state.psi) == (0.0, 0.0, 0.3)
    assert plant.state.y == pytest.approx(plant.state.x * math.tan(0.3))


@pytest.mark.parametrize(("thrust", "used"), [(100.0, THRUST), (-5.0, 0.0)])
def test_thrust_is_limited_to_what_the_vehicle_can(thrust, used):
    asked, got = (RemusPlant(REMUS, PlantState(0.0, 0.0, 0.0, 1.0, 0.0, 0.0)) for _ in range(2))
    asked.advance(Command(0.0, thrust), 5.0)
    got.advance(Command(0.0, used), 5.0)
    assert asked.state == got.state


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("delta", [0.2, -0.2])
def test_positive_rudder_turns_to_port(name, delta):
    plant = flown(name, PlantState(0.0, 0.0, 0.0, 1.9, 0.0, 0.0), [(Command(delta, THRUST), 5.0)])
    assert plant.state.r * delta < 0.0
    assert plant.state.psi * delta < 0.0
    assert plant.state.y * delta < 0.0


@pytest.mark.parametrize("moving_rudder", [False, True], ids=["rudder at rest", "rudder turning"])
def test_runge_kutta_is_of_fourth_order(moving_rudder):
    """Halving the step divides the error by 16. Sway and yaw keep their signs, so Eq. (19) is smooth here."""
    start = PlantState(0.0, 0.0, 0.2, 1.9, 0.05, -0.15)
    seconds = 2.0 if moving_rudder else 4.0

    def end(max_step):
        plant = RemusPlant(REMUS, start, max_step)
        plant.rudder.angle = 0.05 if moving_rudder else 0.2
        plant.advance(Command(0.6 if moving_rudder else 0.2, THRUST), seconds)
        return np.array(plant.state)

    exact = end(0.0025)
    assert exact[4] > 0.0 > exact[5]
    errors = [np.abs(end(step) - exact).max() for step in (0.1, 0.05, 0.025)]
    assert errors[2] < 1e-6
    for coarse, fine in itertools.pairwise(errors):
        assert 12.0 < coarse / fine < 22.0


def test_a_long_step_is_divided_evenly():
    long, short = (RemusPlant(REMUS, PlantState(0.0, 0.0, 0.0, 1.9, 0.0, 0.0)) for _ in range(2))
    long.advance(Command(0.3, THRUST), 0.12)
    for _ in range(3):
        short.advance(Command(0.3, THRUST), 0.04)
    assert long.state == pytest.approx(short.state, abs=1e-14)


def test_the_shipped_step_is_fine_enough():
    """10, 20 and 50 Hz agree to a millimetre over a minute of hard rudder."""
    ends = []
    for rate in (10, 20, 50):
        plant = RemusPlant(REMUS, PlantState(0.0, 0.0, 0.0, 1.9, 0.0, 0.0))
        for k in range(60 * rate):
            plant.advance(Command(0.4 if k // (10 * rate) % 2 else -0.4, THRUST), 1.0 / rate)
        ends.append(plant.state)
    for end in ends[:2]:
        assert end[:2] == pytest.approx(ends[2][:2], abs=1e-3)


@settings(deadline=None)
@given(states, currents)
def test_velocity_over_ground_is_that_of_the_position(state, current):
    """Eqs. (15) and (16) with the signs that follow from Eq. (14): turned to the world they give (x', y')."""
    u, v = RemusPlant(REMUS, state).ground_velocity(current)
    x_dot, y_dot, *_ = RemusDynamics(REMUS).derivative(state, 0.0, 0.0, current)
    assert math.cos(state.psi) * u - math.sin(state.psi) * v == pytest.approx(x_dot, abs=1e-12)
    assert math.sin(state.psi) * u + math.cos(state.psi) * v == pytest.approx(y_dot, abs=1e-12)


@pytest.mark.parametrize(
    ("psi", "expected"),
    [(0.0, (1.1, 0.2)), (math.pi / 2, (1.2, -0.1)), (math.pi, (0.9, -0.2)), (-math.pi / 2, (0.8, 0.1))],
    ids=["north", "east", "south", "west"],
)
def test_eq_15_on_the_four_headings(psi, expected):
    plant = RemusPlant(REMUS, PlantState(0.0, 0.0, psi, 1.0, 0.0, 0.0))
    assert plant.ground_velocity(Current(0.1, 0.2)) == pytest.approx(expected)


def test_measurements_are_the_state():
    plant = RemusPlant(REMUS, PlantState(1.0, 2.0, 9.0, 1.5, -0.1, 0.2))
    assert plant.navigation == (1.0, 2.0, 9.0, 0.2)
    assert plant.water_velocity == (1.5, -0.1)


def test_reset_brings_back_state_and_rudder():
    start = PlantState(1.0, 2.0, 0.5, 1.5, 0.0, 0.0)
    plant = RemusPlant(REMUS, start)
    plant.advance(Command(0.5, THRUST), 3.0)
    assert plant.rudder.angle > 0.0
    plant.reset()
    assert plant.state == start
    assert plant.rudder.angle == plant.rudder.target == 0.0


def test_left_alone_it_slows_down_on_its_course():
    plant = RemusPlant(REMUS, PlantState(0.0, 0.0, 0.5, 1.9, 0.0, 0.0))
    plant.advance(STOP, 60.0)
    assert 0.0 < plant.state.ur < 0.5
    assert plant.state.psi == 0.5
