"""The vehicle of a rehearsal waits for the node that flies it."""

from __future__ import annotations

from auv_sim.nodes.manoeuvres.rehearsed_vehicle import PATIENCE, AwaitedAnswers


def test_a_step_waits_for_every_command_that_has_ever_come() -> None:
    awaited = AwaitedAnswers()
    awaited.asked(10.0)
    assert awaited.complete(10.0)  # nothing flies it yet
    awaited.answered("rudder_cmd")
    awaited.answered("thrust_cmd")
    awaited.asked(11.0)
    assert not awaited.complete(11.0)
    awaited.answered("rudder_cmd")
    assert not awaited.complete(11.1)
    awaited.answered("thrust_cmd")
    assert awaited.complete(11.1)


def test_a_vehicle_that_is_left_alone_moves_on() -> None:
    awaited = AwaitedAnswers()
    awaited.answered("rudder_cmd")
    awaited.asked(5.0)
    assert not awaited.complete(5.0 + 0.9 * PATIENCE)
    assert awaited.complete(5.0 + 1.1 * PATIENCE)
