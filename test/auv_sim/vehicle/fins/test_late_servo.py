"""A servo with a dead time: its commands come late by exactly that time, whatever the steps."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import Command
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.vehicle import Rudder, Vehicle
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import engine
from auv_sim.flight.closed_loop import Scenario
from auv_sim.vehicle.fins.actuator import (
    FlawedServo,
    FlawedServoState,
    RudderFlaws,
    Servo,
    flawed_servo_of,
    servo_at,
    servo_of,
    servo_step,
)
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle
from hulls import DIVER, REMUS

RUDDER = REMUS.rudder


def late(dead_time: float, rudder: Rudder = RUDDER) -> Rudder:
    return dataclasses.replace(rudder, dead_time=dead_time)


def vehicle_with(dead_time: float) -> Vehicle:
    return dataclasses.replace(REMUS, rudder=late(dead_time))


@given(
    st.integers(1, 400),
    st.sampled_from([20, 50, 100]),
    st.lists(st.floats(-0.7, 0.7), min_size=1, max_size=8),
    st.sampled_from([0.2, 0.26, 14.0]),
)
def test_its_angle_is_that_of_an_ideal_one_some_time_ago(delay, period, commands, rate) -> None:
    """Against an ideal servo that is moved by 1 ms at a time; all times are in ms."""
    ideal = Servo(RUDDER.max_angle, rate)
    servo = servo_of(late(1e-3 * delay))._replace(max_rate=rate)
    state, angle = servo_at(servo), servo_at(ideal)
    fine = []
    for now in range(len(commands) * period):
        sent = (now - delay) // period
        angle, _ = servo_step(ideal, angle, (commands[sent] if sent >= 0 else 0.0, True), 1e-3)
        fine.append(angle.angle)
    for k, command in enumerate(commands):
        state, deflection = servo_step(servo, state, (command, True), 1e-3 * period)
        assert deflection[2] == pytest.approx(fine[(k + 1) * period - 1], abs=1e-9)
        assert deflection[1] == pytest.approx(fine[k * period + period // 2 - 1], abs=1e-9)


@given(
    st.floats(0.001, 0.4),
    st.sampled_from([0.02, 0.05, 0.1]),
    st.lists(st.floats(-0.7, 0.7), min_size=1, max_size=12),
    st.sampled_from([0.2, 14.0]),
)
def test_at_sea_a_dead_time_has_any_length_too(delay, period, commands, rate) -> None:
    """Not only whole steps of the plant."""
    servo = servo_of(late(delay))._replace(max_rate=rate)
    other = flawed_servo_of(late(delay), RudderFlaws(), period)._replace(max_rate=rate)
    state, seen = servo_at(servo), FlawedServoState()
    for command in commands:
        state, wanted = servo_step(servo, state, (command, True), period)
        seen, found = servo_step(other, seen, (command, True), period)
        assert found == pytest.approx(wanted, abs=1e-9)


def test_without_dead_time_it_is_the_ideal_one() -> None:
    assert type(servo_of(RUDDER)) is Servo


def test_at_sea_it_adds_to_the_dead_time_of_the_flaws() -> None:
    servo = flawed_servo_of(late(0.1), RudderFlaws(dead_time=0.05), 0.05)
    assert isinstance(servo, FlawedServo)
    assert servo.dead_time == pytest.approx(0.15)
    assert flawed_servo_of(RUDDER, RudderFlaws(dead_time=0.05), 0.05).dead_time == 0.05


def test_more_commands_than_the_ring_holds_are_an_error() -> None:
    servo = servo_of(late(0.02))
    state = servo_at(servo)
    with pytest.raises(IndexError, match="more commands within their dead time"):
        for _ in range(100):
            state, _ = servo_step(servo, state, (0.1, True), 1e-4)


def test_both_fins_of_a_vehicle_that_dives_may_be_late() -> None:
    from auv_msgs_py.values.types import SpatialCommand
    from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
    from auv_sim.vehicle.hulls.rigid_body import body_at

    slow = dataclasses.replace(DIVER, rudder=late(0.1), sternplanes=late(0.2, DIVER.sternplanes))
    body = SimulatedDiver(slow, body_at(0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 1.9))
    moved = []
    for _ in range(8):
        body.advance(SpatialCommand(0.3, 0.3, 5.0), 0.05)
        moved.append((body.state.rudder.angle > 0.0, body.state.sternplanes.angle > 0.0))
    assert moved == [(k >= 2, k >= 4) for k in range(8)]


@pytest.mark.parametrize("delay", [0.05, 0.083])
def test_a_vehicle_turns_later_by_the_dead_time(delay) -> None:
    prompt, slow = (
        SimulatedVehicle(hull, PlantState(0.0, 0.0, 0.0, 2.0, 0.0, 0.0))
        for hull in (REMUS, vehicle_with(delay))
    )
    prompt.advance(Command(0.2, 6.48), 1.0 - delay)
    slow.advance(Command(0.2, 6.48), 1.0)
    assert slow.motion.r == pytest.approx(prompt.motion.r, abs=1e-5)
    assert slow.motion.psi == pytest.approx(prompt.motion.psi, abs=1e-5)


def test_the_engine_flies_it_as_the_closed_loop_does() -> None:
    line = CompositePath([Line(0.0, 0.0, 60.0, 0.3)])
    flight = Scenario(
        path=line,
        vehicle=vehicle_with(0.083),
        thrust=6.48,
        initial=PlantState(3.0, 0.0, 0.0, 2.0, 0.0, 0.0),
        controller_vehicle=REMUS,
    )
    run, track = closed_loop.fly(flight), engine.track(flight)
    assert run.steps == track.steps
    for name in ("x", "y", "psi", "r", "rudder"):
        assert np.abs(getattr(run, name) - getattr(track, name)).max() < 1e-9
    assert math.degrees(abs(run.rudder).max()) > 1.0
    by_link = dataclasses.replace(flight, vehicle=REMUS, command_delay=0.083)
    assert np.array_equal(engine.track(by_link).rudder, track.rudder)
    figures = engine.fly([flight])
    assert figures.last_y[0] == pytest.approx(run.y[-1], abs=1e-9)
