"""Pairing: whatever the order of arrival, one step's messages come out together."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.contract.pairing import Pairing
from auv_msgs_py.values.errors import LockstepBroken

TOPICS = ("odom", "water", "current")


@given(st.lists(st.permutations(TOPICS), min_size=1, max_size=6))
def test_any_order_within_a_step_gives_the_same_tuples(steps):
    pairing = Pairing(TOPICS, strict=True)
    for step, order in enumerate(steps):
        complete = [pairing.put(topic, (topic, step), stamp=step) for topic in order]
        assert complete == [False, False, True]
        assert pairing.take() == tuple((topic, step) for topic in TOPICS)
        assert pairing.missing == ()


def test_missing_names_what_is_still_owed():
    pairing = Pairing(TOPICS, strict=True)
    assert pairing.missing == ()  # before its first message a step lacks none
    pairing.put("water", 1)
    assert pairing.missing == ("odom", "current")
    assert "water" in pairing
    assert "odom" not in pairing


def test_strict_a_second_message_within_a_step_raises():
    pairing = Pairing(TOPICS, strict=True)
    pairing.put("odom", 1, stamp=5)
    with pytest.raises(LockstepBroken, match=r"odom: a second message"):
        pairing.put("odom", 2, stamp=5)


def test_strict_unequal_stamps_raise():
    pairing = Pairing(TOPICS, strict=True)
    pairing.put("odom", 1, stamp=5)
    pairing.put("current", 1)  # no stamp: counts
    with pytest.raises(LockstepBroken, match=r"water: stamp 6 ns in the step of 5 ns"):
        pairing.put("water", 2, stamp=6)


def test_strict_the_next_step_may_have_another_stamp():
    pairing = Pairing(("odom",), strict=True)
    assert pairing.put("odom", 1, stamp=5)
    pairing.take()
    assert pairing.put("odom", 2, stamp=6)


def test_otherwise_the_newest_wins_and_a_gap_is_none():
    pairing = Pairing(TOPICS, strict=False)
    pairing.put("odom", 1, stamp=5)
    pairing.put("odom", 2, stamp=6)
    pairing.put("water", 3, stamp=1)
    assert pairing.take() == (2, 3, None)
    assert "odom" not in pairing


def test_clear_forgets_values_and_stamp():
    pairing = Pairing(TOPICS, strict=True)
    pairing.put("odom", 1, stamp=5)
    pairing.clear()
    assert not pairing.put("odom", 2, stamp=6)
    assert pairing.take() == (2, None, None)
