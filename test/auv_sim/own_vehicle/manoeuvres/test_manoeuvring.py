"""The law of the manoeuvres: sides, ends, and bounds of what it commands."""

from __future__ import annotations

import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import SPATIAL_STOP, SpatialNavigation
from auv_path_following import vehicle
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.legs import Manoeuvres, manoeuvres_of
from auv_sim.own_vehicle.manoeuvres.manoeuvring import Flown, manoeuvre, manoeuvring_begins
from auv_sim.own_vehicle.manoeuvres.program_file import (
    Circle,
    DepthZigzag,
    LegSpec,
    PitchZigzag,
    PlaneStep,
    Program,
    Straight,
    Zigzag,
)

DIVER = vehicle.load("remus100_6dof")
LEVEL = SpatialNavigation(3.0, 4.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0)
angles = st.floats(-math.pi, math.pi)
rates = st.floats(-1.0, 1.0)


def program_of(*legs: LegSpec) -> Manoeuvres:
    """The legs of a vehicle that is at its depth already."""
    config = manoeuvres_of(Program(version=1, name="p", legs=legs), DIVER)
    return config._replace(legs=config.legs[1:])


def at(**changes: float) -> SpatialNavigation:
    return LEVEL._replace(**changes)


def begun(config: Manoeuvres) -> Flown:
    return manoeuvre(config, manoeuvring_begins(LEVEL, LEVEL.z), LEVEL, 0.0)[0]


def test_a_straight_turns_back_to_its_course() -> None:
    config = program_of(LegSpec(straight=Straight(seconds=9.0, thrust=0.5)))
    state = begun(config)
    # Too far to starboard: rudder to port, which is positive.
    assert manoeuvre(config, state, at(psi=1.2), 0.05)[1].rudder > 0.0
    assert manoeuvre(config, state, at(psi=0.8), 0.05)[1].rudder < 0.0
    assert manoeuvre(config, state, at(r=0.1), 0.05)[1].rudder > 0.0
    command = manoeuvre(config, state, LEVEL, 0.05)[1]
    assert (command.rudder, command.thrust) == (0.0, pytest.approx(0.5 * DIVER.thrust_max))


def test_the_held_depth_and_pitch_are_restored() -> None:
    config = program_of(LegSpec(straight=Straight(seconds=9.0)))
    state = begun(config)
    # Too deep: bow up, which is a negative angle of the planes.
    assert manoeuvre(config, state, at(z=11.0), 0.05)[1].sternplanes < 0.0
    assert manoeuvre(config, state, at(z=9.0), 0.05)[1].sternplanes > 0.0
    assert manoeuvre(config, state, at(theta=0.1), 0.05)[1].sternplanes > 0.0
    assert manoeuvre(config, state, at(q=0.1), 0.05)[1].sternplanes > 0.0


def test_a_zigzag_goes_to_port_first_and_is_reversed_by_the_heading() -> None:
    config = program_of(LegSpec(zigzag=Zigzag(seconds=60.0, rudder_deg=10.0, heading_deg=20.0)))
    state, command = manoeuvre(config, manoeuvring_begins(LEVEL, 10.0), LEVEL, 0.0)
    assert math.degrees(command.rudder) == pytest.approx(10.0)
    found = []
    for heading in (-19.0, -21.0, 0.0, 19.0, 21.0, 0.0):
        state, command = manoeuvre(config, state, at(psi=1.0 + math.radians(heading)), 0.05)
        found.append(round(math.degrees(command.rudder)))
    assert found == [10, -10, -10, -10, 10, 10]
    assert state.reversals == 2


def test_a_zigzag_catches_a_hull_that_turns_on() -> None:
    config = program_of(LegSpec(zigzag=Zigzag(seconds=60.0, rudder_deg=10.0, heading_deg=20.0)))
    _, command = manoeuvre(config, begun(config), at(psi=1.0 + math.radians(85.0)), 0.05)
    assert command.rudder == pytest.approx(DIVER.rudder.max_angle)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_circle_ends_after_its_turn(side: float) -> None:
    config = program_of(LegSpec(circle=Circle(seconds=60.0, rudder_deg=15.0 * side, turn_deg=90.0)))
    state, psi = begun(config), LEVEL.psi
    for turned in range(0, 90, 10):
        psi = LEVEL.psi - side * math.radians(turned)
        state, command = manoeuvre(config, state, at(psi=psi), 0.05)
        assert math.degrees(command.rudder) == pytest.approx(15.0 * side)
    _, command = manoeuvre(config, state, at(psi=psi - side * math.radians(11.0)), 0.05)
    assert command == SPATIAL_STOP


def test_the_course_towards_the_start_is_that_of_the_place() -> None:
    config = program_of(
        LegSpec(circle=Circle(seconds=1.0, rudder_deg=10.0)),
        LegSpec(straight=Straight(seconds=9.0, towards_start=True)),
    )
    state, _ = manoeuvre(config, begun(config), at(x=LEVEL.x, y=LEVEL.y + 50.0), 1.0)
    assert state.leg == 1
    assert math.degrees(state.course) == pytest.approx(-90.0)


def test_a_pitch_zigzag_begins_bow_down_and_is_reversed_by_the_pitch() -> None:
    config = program_of(LegSpec(pitch_zigzag=PitchZigzag(seconds=60.0, planes_deg=6.0, pitch_deg=8.0)))
    state, found = begun(config), []
    for pitch in (-7.0, -9.0, 0.0, 9.0):
        state, command = manoeuvre(config, state, at(theta=math.radians(pitch)), 0.05)
        found.append(round(math.degrees(command.sternplanes)))
    assert found == [6, -6, -6, 6]


def test_a_depth_zigzag_dives_first_and_is_reversed_by_the_depth() -> None:
    config = program_of(LegSpec(depth_zigzag=DepthZigzag(seconds=60.0, pitch_deg=10.0, depth=2.0)))
    state, sides = begun(config), []
    for depth in (11.0, 12.1, 10.0, 7.9, 10.0):
        state, command = manoeuvre(config, state, at(z=depth), 0.05)
        sides.append(command.sternplanes > 0.0)
    assert sides == [True, False, False, True, True]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_plane_step_ends_at_its_pitch(side: float) -> None:
    step = PlaneStep(seconds=9.0, planes_deg=5.0 * side, pitch_deg=10.0)
    config = program_of(LegSpec(plane_step=step))
    state, command = manoeuvre(config, begun(config), at(theta=-side * math.radians(9.0)), 0.05)
    assert math.degrees(command.sternplanes) == pytest.approx(5.0 * side)
    assert manoeuvre(config, state, at(theta=-side * math.radians(11.0)), 0.05)[1] == SPATIAL_STOP


@settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])
@given(angles, angles, rates, rates, st.floats(-50.0, 50.0), st.integers(0, 28))
def test_commands_stay_within_the_limits(
    psi: float, theta: float, q: float, r: float, z: float, number: int
) -> None:
    config = manoeuvres_of(program_file.load("eight_minutes_dive"), DIVER)
    state = manoeuvring_begins(LEVEL, LEVEL.z)._replace(leg=number)
    _, command = manoeuvre(config, state, at(psi=psi, theta=theta, q=q, r=r, z=z), 0.05)
    assert abs(command.rudder) <= DIVER.rudder.max_angle
    assert DIVER.sternplanes is not None
    assert abs(command.sternplanes) <= DIVER.sternplanes.max_angle
    assert 0.0 <= command.thrust <= DIVER.thrust_max
