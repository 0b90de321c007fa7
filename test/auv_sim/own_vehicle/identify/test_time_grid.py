"""Measurements on one line of time: latency, gaps, long steps, parts of a recording."""

from __future__ import annotations

import numpy as np
import pytest

from auv_sim.own_vehicle.identify.predictions import starts_of
from auv_sim.own_vehicle.identify.time_grid import FOLLOWED, LONGEST_STEP, PlanarData, passage_of


def recording(t: np.ndarray, water_t: np.ndarray) -> PlanarData:  # type: ignore[type-arg]
    zeros = np.zeros(t.size)
    u = np.linspace(1.0, 2.0, water_t.size)
    return PlanarData(
        "r", t, np.sin(t), water_t, u, 0.1 * u, t, 0.1 * np.sign(np.sin(t)), t, np.full(t.size, 5.0),
        zeros, zeros, zeros, zeros,
    )  # fmt: skip


def test_a_late_sample_stands_at_the_moment_at_which_it_was_measured() -> None:
    t = np.arange(0.0, 10.0, 0.05)
    data = recording(t, np.arange(0.2, 10.0, 0.2))
    passage = passage_of(data, 0.1)
    with_water = np.flatnonzero(passage.grid.u_row >= 0)
    assert passage.times[with_water[1]] == pytest.approx(0.3)
    assert passage.grid.u[with_water[1]] == data.u[1]
    assert passage.grid.begins.sum() == 1


def test_samples_between_the_odometries_get_nodes_of_their_own() -> None:
    t = np.arange(0.0, 10.0, 0.05)
    passage = passage_of(recording(t, np.arange(0.2, 10.0, 0.2)), 0.12)
    assert np.diff(passage.times).max() <= LONGEST_STEP
    both = (passage.grid.u_row >= 0) & (passage.grid.rate_row >= 0)
    assert not both.any()


def test_slow_odometry_gets_steps_short_enough_for_the_filter() -> None:
    t = np.arange(0.0, 20.0, 0.1)
    passage = passage_of(recording(t, np.arange(0.2, 20.0, 0.2)), 0.0)
    assert np.diff(passage.times)[:-1].max() <= LONGEST_STEP
    assert (passage.grid.rate_row >= 0).sum() == pytest.approx(t.size, abs=3)


def test_a_gap_begins_a_new_passage_and_uses_nothing_before_its_first_sample() -> None:
    t = np.concatenate((np.arange(0.0, 5.0, 0.05), np.arange(8.0, 20.0, 0.05)))
    water = np.concatenate((np.arange(0.2, 5.0, 0.2), np.arange(9.0, 20.0, 0.2)))
    commands = np.arange(0.0, 20.0, 0.05)
    data = recording(t, water)._replace(rudder_t=commands, rudder=0.1 * np.sign(np.sin(commands)))
    passage = passage_of(data, 0.0)
    starts = passage.times[:-1][passage.grid.begins]
    assert starts == pytest.approx([0.2, 9.0])
    unused = (passage.times[:-1] > 7.9) & (passage.times[:-1] < 8.99)
    assert (passage.grid.rate_row[unused] == -1).all()


def test_after_a_gap_without_commands_a_passage_begins_when_the_fin_has_followed_the_next_ones() -> None:
    """Its angle after the gap is not known: one wrong second moved b by a fifth."""
    t = np.concatenate((np.arange(0.0, 5.0, 0.05), np.arange(8.0, 20.0, 0.05)))
    water = np.concatenate((np.arange(0.2, 5.0, 0.2), np.arange(8.0, 20.0, 0.2)))
    passage = passage_of(recording(t, water), 0.0)
    starts = passage.times[:-1][passage.grid.begins]
    assert starts == pytest.approx([0.2, 8.0 + FOLLOWED], abs=0.21)


def test_a_prediction_ends_before_a_gap_and_begins_where_the_fin_is_known() -> None:
    t = np.concatenate((np.arange(0.0, 5.0, 0.05), np.arange(8.0, 20.0, 0.05)))
    water = np.concatenate((np.arange(0.2, 5.0, 0.2), np.arange(8.0, 20.0, 0.2)))
    passage = passage_of(recording(t, water), 0.0)
    spans = [(passage.times[k], passage.times[k + length]) for k, length in starts_of(passage, 2.0)]
    assert any(end <= 5.0 for _, end in spans) and any(begin >= 8.0 + FOLLOWED for begin, _ in spans)
    assert all(end - begin < 2.1 for begin, end in spans)
    assert not any(4.96 < begin < 8.0 + FOLLOWED or 4.96 < end < 8.0 + FOLLOWED for begin, end in spans)


def test_a_part_keeps_the_commands_that_still_act() -> None:
    t = np.arange(0.0, 30.0, 0.05)
    part = recording(t, np.arange(0.2, 30.0, 0.2)).between(20.0, 25.0)
    assert part.t[0] == pytest.approx(20.0) and part.t[-1] < 25.0
    assert 14.9 < part.rudder_t[0] < 15.1 and part.rudder_t[-1] < 25.0
