"""Which rows lie in a hold."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from auv_sim.bags.reading.held_rows import held_rows


def held(words: dict[int, str], rows: int = 10) -> list[float]:
    """Rows 1000 ns apart."""
    states = [(at, SimpleNamespace(data=word)) for at, word in words.items()]
    return held_rows(1000 * np.arange(rows), states).tolist()


def test_a_hold_lasts_from_the_word_to_the_first_row_after_it() -> None:
    words = {-10: "idle", 5: "running", 2_500: "holding", 5_200: "running"}
    assert held(words) == [0, 0, 0, 1, 1, 1, 1, 0, 0, 0]


def test_a_repeated_word_is_one_hold() -> None:
    assert (
        held({0: "running", 2_500: "holding", 3_500: "holding", 4_200: "running"})
        == [0] * 3 + [1] * 3 + [0] * 4
    )


def test_a_hold_between_two_rows_marks_the_second() -> None:
    assert held({0: "running", 2_500: "holding", 2_600: "running"}) == [0, 0, 0, 1, 0, 0, 0, 0, 0, 0]


def test_a_hold_that_does_not_end_lasts_to_the_last_row() -> None:
    assert held({0: "running", 7_500: "holding"}) == [0] * 8 + [1] * 2


def test_without_a_state_it_is_not_known() -> None:
    assert np.isnan(held({})).all()
