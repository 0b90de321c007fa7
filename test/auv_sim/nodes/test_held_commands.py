"""What the driver hands on: the newest pair, or a stop."""

from __future__ import annotations

import math

import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SPATIAL_STOP, STOP, Command, SpatialCommand
from auv_sim.nodes.held_commands import Orders
from auv_sim.nodes.mavlink.commands import Commands

RUDDER, PLANES, THRUST = topics.RUDDER_CMD.name, topics.STERNPLANE_CMD.name, topics.THRUST_CMD.name
SECOND = 1_000_000_000


@pytest.fixture
def commands() -> Commands:
    return Commands(Orders({RUDDER: (-0.6, 0.6), THRUST: (0.0, 100.0)}, STOP), timeout=1.0)


def test_a_pair_is_complete_with_its_thrust(commands: Commands) -> None:
    assert not commands.put(THRUST, 5.0, 0)
    assert not commands.put(RUDDER, 0.1, 0)
    assert commands.put(THRUST, 60.0, 0)
    assert commands.command(0, 0.0) == Command(0.1, 60.0)


def test_one_of_the_two_that_falls_silent_is_a_stop(commands: Commands) -> None:
    assert not commands.silent(9 * SECOND)  # none has ever come
    commands.put(RUDDER, 0.1, 0)
    commands.put(THRUST, 60.0, SECOND)
    assert commands.command(SECOND, 0.0) == Command(0.1, 60.0)
    assert commands.command(SECOND + 1, 0.0) == STOP
    assert commands.silent(SECOND + 1)
    assert not commands.none_since(2 * SECOND)
    assert commands.none_since(2 * SECOND + 1)


def test_no_command_counts_when_the_mission_is_over(commands: Commands) -> None:
    commands.put(RUDDER, 0.1, 0)
    commands.put(THRUST, 60.0, 0)
    for state in ("running", "holding", "holding"):
        assert commands.command(0, 0.0) == Command(0.1, 60.0)
        commands.mission_is(state, 0.0)
    assert commands.command(0, 0.0) == STOP
    commands.mission_is("running", 0.0)
    assert commands.command(0, 0.0) == Command(0.1, 60.0)


def test_a_single_forged_state_stops_nothing(commands: Commands) -> None:
    commands.put(RUDDER, 0.1, 0)
    commands.put(THRUST, 60.0, 0)
    commands.mission_is("running", 0.0)
    commands.mission_is("complete", 0.5)
    assert commands.command(0, 1.0) == Command(0.1, 60.0)
    with pytest.raises(MessageRefused, match="'complete' once among 'running'"):
        commands.mission_is("running", 1.0)
    assert commands.command(0, 9.0) == Command(0.1, 60.0)


@pytest.mark.parametrize(
    ("topic", "value"), [(RUDDER, 0.61), (RUDDER, -0.61), (THRUST, -0.1), (THRUST, 100.1), (THRUST, math.nan)]
)
def test_what_the_vehicle_cannot_do_is_refused(commands: Commands, topic: str, value: float) -> None:
    with pytest.raises(MessageRefused):
        commands.put(topic, value, 0)


def test_silent_planes_stop_everything() -> None:
    limits = {RUDDER: (-0.6, 0.6), PLANES: (-0.3, 0.3), THRUST: (0.0, 100.0)}
    commands = Commands(Orders(limits, SPATIAL_STOP), timeout=1.0)
    commands.put(RUDDER, 0.1, 0)
    assert not commands.put(THRUST, 60.0, 0)
    commands.put(PLANES, -0.2, 0)
    assert commands.put(THRUST, 60.0, 0)
    assert commands.command(0, 0.0) == SpatialCommand(0.1, -0.2, 60.0)
    commands.put(RUDDER, 0.1, SECOND)
    commands.put(THRUST, 60.0, SECOND)
    assert commands.command(SECOND, 0.0) == SpatialCommand(0.1, -0.2, 60.0)
    assert commands.command(SECOND + 1, 0.0) == SPATIAL_STOP
    with pytest.raises(MessageRefused):
        commands.put(PLANES, 0.31, 0)
