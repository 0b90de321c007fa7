"""Random numbers drawn before a run, and its rings."""

from __future__ import annotations

import numpy as np
import pytest

from auv_sim.vehicle.draws import Draws, draw, looked_up, slot

SEED = (7, 1)


def drawn(count: int, steps: int, refill: int | None = None) -> list[list[float]]:
    """`count` numbers of three rows, drawn on every `refill` steps."""
    draws = Draws(0.1, steps)
    generator = draws.generator(SEED)
    generator.standard_normal()
    rows = [
        draws.normals(generator),
        draws.uniforms(draws.generator((7, 2)), 1, 0.0),
        draws.exponentials(draws.generator((7, 3)), 0.1),
    ]
    memory = draws.memory()
    seen: list[list[float]] = []
    for k in range(count):
        if refill and k and k % refill == 0:
            draws.refill(memory)
        # The rows are used at different rates.
        seen.append([draw(memory, row) for i, row in enumerate(rows) if k % (i + 1) == 0])
    return seen


def test_a_row_is_the_stream_of_its_generator() -> None:
    generator = np.random.default_rng(SEED)
    assert [row[0] for row in drawn(50, 50)] == [float(generator.standard_normal()) for _ in range(51)][1:]


def test_drawing_on_between_two_steps_leaves_the_streams_as_they_are() -> None:
    assert drawn(400, 400) == drawn(400, 40, 40) == drawn(400, 41, 7)


def test_a_row_that_is_used_up_is_an_error() -> None:
    with pytest.raises(IndexError, match="a row of random numbers is used up"):
        drawn(41, 40)


def test_a_row_for_a_slow_sensor_is_short() -> None:
    draws = Draws(0.1, 1000)
    slow, fast = draws.normals(draws.generator(SEED), 1.0), draws.normals(draws.generator(SEED), 0.0)
    assert (slow.end, fast.end - slow.end) == (102, 1000)


def test_arrays_hold_what_lists_hold() -> None:
    memories = []
    for arrays in (False, True):
        draws = Draws(0.1, 10, arrays)
        draws.normals(draws.generator(SEED))
        draws.ring(4)
        memories.append(draws.memory())
    assert [list(values) for values in memories[0]] == [values.tolist() for values in memories[1]]
    assert isinstance(memories[0].drawn, list) and isinstance(memories[1].drawn, np.ndarray)


def test_the_entries_of_rings_do_not_overlap() -> None:
    draws = Draws(0.1, 1)
    rings = [draws.ring(3), draws.ring(2, 3), draws.ring(1)]
    places = [slot(ring, k) + i for ring in rings for k in range(ring.size) for i in range(ring.width)]
    assert sorted(places) == list(range(10)) == list(range(len(draws.memory().kept)))
    assert slot(rings[1], 7) == slot(rings[1], 1)


@pytest.mark.parametrize("arrays", [False, True])
def test_a_table_is_linear_between_its_rows_and_held_outside(arrays: bool) -> None:
    rows = [(0.0, 1.0, 5.0), (10.0, 2.0, 5.0), (30.0, -2.0, 6.0)]
    table = Draws(0.1, 1, arrays).lookup(rows)
    at = np.array([-5.0, 0.0, 4.0, 10.0, 15.0, 29.0, 30.0, 99.0])
    for column in (1, 2):
        expected = np.interp(at, [row[0] for row in rows], [row[column] for row in rows])
        assert [looked_up(table, column, x) for x in at] == pytest.approx(expected.tolist())
    assert looked_up(Draws(0.1, 1, arrays).lookup([]), 1, 3.0) == 0.0
