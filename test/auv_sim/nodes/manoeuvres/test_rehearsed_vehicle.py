"""The vehicle of a rehearsal waits for the node that flies it."""

from __future__ import annotations

import itertools

import pytest

from auv_sim.nodes.manoeuvres.rehearsed_vehicle import LOOK, PATIENCE, AwaitedAnswers

COMMANDS = ("rudder_cmd", "thrust_cmd")


def test_a_step_waits_for_every_command() -> None:
    awaited = AwaitedAnswers(COMMANDS)
    for word in ("mission_state", *COMMANDS):
        awaited.answered(word)
    awaited.asked(11.0)
    assert not awaited.complete(11.0)
    awaited.answered("rudder_cmd")
    assert not awaited.complete(11.1)
    awaited.answered("thrust_cmd")
    assert awaited.complete(11.1)


@pytest.mark.parametrize("order", tuple(itertools.permutations(("mission_state", *COMMANDS))))
def test_the_first_step_waits_for_the_whole_first_answer(order: tuple[str, ...]) -> None:
    """Else the vehicle is at rest for a step more where one of its messages is late."""
    awaited = AwaitedAnswers(COMMANDS)
    awaited.asked(10.0)
    for word in order:
        assert not awaited.complete(10.1)
        awaited.answered(word)
    assert awaited.complete(10.1)
    awaited.asked(11.0)
    assert not awaited.complete(11.0)


def test_a_vehicle_that_is_left_alone_moves_on() -> None:
    awaited = AwaitedAnswers(COMMANDS)
    awaited.asked(5.0)
    looks = [awaited.complete(5.0 + 0.05 * k) for k in range(50)]
    assert looks.index(True) == pytest.approx(PATIENCE / 0.05, abs=1)


def test_a_process_that_was_stopped_has_not_waited() -> None:
    awaited = AwaitedAnswers(COMMANDS)
    awaited.asked(5.0)
    assert not awaited.complete(5.0 + 10.0 * PATIENCE)
    assert not awaited.complete(5.0 + 20.0 * PATIENCE)
    assert LOOK < 0.1 * PATIENCE
