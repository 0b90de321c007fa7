from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from auv_sim.bags.sequence_watch import SequenceWatch


def lost(numbers: list[int], publishers: int = 1) -> int:
    watch = SequenceWatch()
    for number in numbers:
        watch.note(number, publishers)
    return watch.lost


@given(st.integers(1, 1000), st.lists(st.booleans(), max_size=60))
def test_one_publisher_every_gap_is_counted(first: int, arrived: list[bool]) -> None:
    """A late joiner begins anywhere; what never came at the end cannot be known."""
    numbers = [first] + [first + 1 + k for k, here in enumerate(arrived) if here]
    assert lost(numbers) == numbers[-1] - first + 1 - len(numbers)


@given(st.lists(st.integers(0, 2), max_size=80))
def test_publishers_taking_turns_lose_nothing(turns: list[int]) -> None:
    counters = [0, 0, 0]
    numbers = []
    for publisher in turns:
        counters[publisher] += 1
        numbers.append(counters[publisher])
    assert lost(numbers, 3) == 0


def test_a_publisher_that_begins_anew_is_no_loss() -> None:
    assert lost([5, 6, 7, 1, 2, 3]) == 0
    assert lost([5, 6, 7, 1, 2, 5]) == 2


def test_a_gap_between_two_publishers() -> None:
    assert lost([1, 100, 2, 101, 3, 105, 4], 2) == 3


def test_no_numbers_no_claim() -> None:
    assert lost([0, 0, 0]) == 0
