"""The command in force: the newest of each kind, or a stop."""

from __future__ import annotations

import math

import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SPATIAL_STOP, STOP, Command, SpatialCommand
from auv_sim.nodes.held_commands import HeldCommands, Orders

RUDDER, PLANES, THRUST = topics.RUDDER_CMD.name, topics.STERNPLANE_CMD.name, topics.THRUST_CMD.name
SECOND = 1_000_000_000


@pytest.fixture
def commands() -> HeldCommands:
    return HeldCommands(Orders({RUDDER: (-0.6, 0.6), THRUST: (0.0, 100.0)}, STOP))


def in_force(commands: HeldCommands, now: int, wall: float = 0.0) -> Command:
    """With a timeout of 1 s."""
    found: Command = commands.in_force(now, 1.0, wall)
    return found


def test_all_commands_have_to_arrive(commands: HeldCommands) -> None:
    commands.put(THRUST, 5.0, 0)
    assert not commands.is_complete
    commands.put(RUDDER, 0.1, 0)
    assert commands.is_complete
    assert in_force(commands, 0) == Command(0.1, 5.0)


def test_one_of_the_two_that_falls_silent_is_a_stop(commands: HeldCommands) -> None:
    assert commands.silent(9 * SECOND, 1.0) == []  # none has ever come
    commands.put(RUDDER, 0.1, 0)
    commands.put(THRUST, 60.0, SECOND)
    assert in_force(commands, SECOND) == Command(0.1, 60.0)
    assert in_force(commands, SECOND + 1) == STOP
    assert commands.silent(SECOND + 1, 1.0) == [RUDDER]
    assert commands.silent(2 * SECOND + 1, 1.0) == [RUDDER, THRUST]


def test_a_kind_that_was_never_commanded_is_neutral(commands: HeldCommands) -> None:
    for now in range(5 * SECOND, 9 * SECOND, SECOND // 2):
        commands.put(THRUST, 60.0, now)
        assert in_force(commands, now) == Command(0.0, 60.0)
    assert in_force(commands, 10 * SECOND) == STOP
    commands.clear()
    assert commands.silent(11 * SECOND, 1.0) == []


def test_no_command_counts_when_the_mission_is_over(commands: HeldCommands) -> None:
    commands.put(RUDDER, 0.1, 0)
    commands.put(THRUST, 60.0, 0)
    for state in ("running", "holding", "holding"):
        assert in_force(commands, 0) == Command(0.1, 60.0)
        commands.mission.hear(state, 0.0)
    assert in_force(commands, 0) == STOP
    commands.mission.hear("running", 0.0)
    assert in_force(commands, 0) == Command(0.1, 60.0)


def test_a_single_forged_state_stops_nothing(commands: HeldCommands) -> None:
    commands.put(RUDDER, 0.1, 0)
    commands.put(THRUST, 60.0, 0)
    commands.mission.hear("running", 0.0)
    commands.mission.hear("complete", 0.5)
    assert in_force(commands, 0, wall=1.0) == Command(0.1, 60.0)
    assert "'complete' once among 'running'" in str(commands.mission.hear("running", 1.0))
    assert in_force(commands, 0, wall=9.0) == Command(0.1, 60.0)


@pytest.mark.parametrize(
    ("topic", "value"), [(RUDDER, 0.61), (RUDDER, -0.61), (THRUST, -0.1), (THRUST, 100.1), (THRUST, math.nan)]
)
def test_what_the_vehicle_cannot_do_is_refused(commands: HeldCommands, topic: str, value: float) -> None:
    with pytest.raises(MessageRefused):
        commands.put(topic, value, 0)


def test_silent_planes_stop_everything() -> None:
    limits = {RUDDER: (-0.6, 0.6), PLANES: (-0.3, 0.3), THRUST: (0.0, 100.0)}
    commands = HeldCommands(Orders(limits, SPATIAL_STOP))
    commands.put(RUDDER, 0.1, 0)
    commands.put(THRUST, 60.0, 0)
    assert not commands.is_complete
    commands.put(PLANES, -0.2, 0)
    assert commands.is_complete
    assert in_force(commands, 0) == SpatialCommand(0.1, -0.2, 60.0)
    commands.put(RUDDER, 0.1, SECOND)
    commands.put(THRUST, 60.0, SECOND)
    assert in_force(commands, SECOND) == SpatialCommand(0.1, -0.2, 60.0)
    assert in_force(commands, SECOND + 1) == SPATIAL_STOP
    with pytest.raises(MessageRefused):
        commands.put(PLANES, 0.31, 0)
