"""The mission's state as its readers take it, and that a single foreign word does not change it."""

from __future__ import annotations

import pytest

from auv_msgs_py.contract.mission_word import ALONE, PERIOD, MissionState, MissionWord
from auv_msgs_py.values.errors import MessageRefused


def heard(*said: tuple[float, str]) -> MissionWord:
    word = MissionWord()
    for at, text in said:
        word.hear(text, at)
    return word


@pytest.mark.parametrize("forged", [state.value for state in MissionState if state != "running"])
def test_one_forged_word_among_those_of_guidance_ends_nothing(forged: str) -> None:
    word = heard((0.0, "running"), (PERIOD, "running"), (PERIOD + 0.001, forged))
    assert word.at(2.0 * PERIOD - 1e-6) == "running"
    refused = word.hear("running", 2.0 * PERIOD)
    assert refused is not None
    assert str(refused) == (
        f"mission_state: found '{forged}' once among 'running', expected a state that is repeated"
    )
    assert word.at(2.0 * PERIOD + ALONE) == "running"


def test_a_word_said_twice_counts_at_once_and_a_lone_one_when_nothing_contradicts_it() -> None:
    assert heard((0.0, "running"), (1.0, "aborted"), (1.0, "aborted")).at(1.0) == "aborted"
    lone = heard((0.0, "running"), (1.0, "aborted"))
    assert lone.at(1.0 + ALONE - 1e-6) == "running"
    assert lone.at(1.0 + ALONE) == "aborted"


def test_the_first_word_and_running_count_at_once() -> None:
    assert heard((0.0, "aborted")).at(0.0) == "aborted"
    assert heard((0.0, "aborted"), (0.1, "running")).at(0.1) == "running"


def test_two_different_words_are_not_one_said_twice() -> None:
    word = heard((0.0, "running"), (1.0, "complete"))
    assert word.hear("aborted", 1.1) is not None
    assert word.at(1.2) == "running"


def test_a_word_that_there_is_not_is_refused_and_changes_nothing() -> None:
    word = heard((0.0, "running"))
    with pytest.raises(MessageRefused, match="found 'done', expected idle, running"):
        word.hear("done", 0.5)
    assert word.at(0.5) == "running"
