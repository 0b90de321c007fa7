"""Rows in bounded memory: what was appended is there, thinned from the oldest on."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.views.console.record.history import History
from auv_sim.views.console.record.track_columns import NAMES, PLACE


@given(st.integers(1, 400), st.integers(2, 40))
def test_rows_keep_their_order_within_the_bound(count: int, most: int) -> None:
    history = History(most)
    for k in range(count):
        history.append({"t": float(k), "x": -float(k)})
    t = history.rows[:, PLACE["t"]]
    assert 1 <= len(t) <= most
    assert history.taken == count
    assert t[-1] == count - 1, "the newest row is never dropped"
    assert np.all(np.diff(t) > 0.0)
    assert set(t) <= set(range(count))
    assert np.array_equal(history.rows[:, PLACE["x"]], -t)
    if count <= most:
        assert np.array_equal(t, np.arange(count)), "nothing is dropped below the bound"


@given(st.integers(100, 2000))
def test_the_oldest_part_is_the_coarsest(count: int) -> None:
    history = History(50)
    for k in range(count):
        history.append({"t": float(k)})
    steps = np.diff(history.rows[:, PLACE["t"]])
    assert np.all(np.diff(steps[1:]) <= 0.0)
    assert len(history.rows) >= 25


def test_a_column_without_a_value_is_not_a_number() -> None:
    history = History()
    history.append({"t": 0.5, "ye": 0.1})
    row = dict(zip(NAMES, history.rows[0], strict=True))
    assert (row["t"], row["ye"]) == (0.5, np.float32(0.1))
    assert {name for name, value in row.items() if np.isnan(value)} == set(NAMES) - {"t", "ye"}


def test_restored_rows_are_followed_by_new_ones() -> None:
    before, after = History(), History(10)
    for k in range(20):
        before.append({"t": float(k)})
    after.restore(before.rows)
    assert after.taken == 10
    after.append({"t": 20.0})
    t = after.rows[:, PLACE["t"]]
    assert (t[-1], len(t)) == (20.0, 6)
