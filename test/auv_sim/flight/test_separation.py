"""The distance between vehicles over time."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.flight.separation import closest_over_time, separation, separations


def run(t: Any, x: Any, y: Any, z: Any = None, **others: Any) -> Run:
    t = np.asarray(t, float)
    cls = Run if z is None else SpatialRun
    columns = {field.name: np.full(len(t), np.nan) for field in dataclasses.fields(cls)}
    given = {"t": t, "x": np.zeros(len(t)) + x, "y": np.zeros(len(t)) + y, **others}
    if z is not None:
        given["z"] = np.zeros(len(t)) + z
    return cls(**(columns | given))


def test_two_that_pass_each_other() -> None:
    t = np.arange(0.0, 10.05, 0.05)
    pair = separation(("a", run(t, 2.0 * t, 0.0)), ("b", run(t, 20.0 - 2.0 * t, 3.0)))
    assert pair.closest == (pytest.approx(3.0), pytest.approx(5.0))
    np.testing.assert_allclose(pair.distance, np.hypot(20.0 - 4.0 * t, 3.0))


def test_the_times_need_not_be_the_same_and_only_the_common_ones_count() -> None:
    slow, fast = np.arange(0.0, 8.0, 0.3), np.arange(2.0, 12.0, 0.05)
    pair = separation(("a", run(slow, slow, 0.0)), ("b", run(fast, fast, 4.0)))
    assert pair.t[0] >= 2.0
    assert pair.t[-1] <= 8.0
    np.testing.assert_allclose(pair.distance, 4.0)
    never = separation(("a", run([0.0, 1.0], 0.0, 0.0)), ("b", run([5.0, 6.0], 0.0, 0.0)))
    assert not len(never.t)
    assert np.isnan(never.closest).all()


def test_depth_counts_and_a_vehicle_without_it_is_at_the_surface() -> None:
    t = [0.0, 1.0]
    deep, shallow, plane = run(t, 0.0, 0.0, 12.0), run(t, 0.0, 3.0, 8.0), run(t, 0.0, 5.0)
    assert separation(("a", deep), ("b", shallow)).closest[0] == pytest.approx(5.0)
    assert separation(("a", plane), ("b", deep)).closest[0] == pytest.approx(13.0)


def test_the_true_position_counts_where_there_is_one() -> None:
    t = [0.0, 1.0]
    erring = run(t, 0.0, 0.0, x_true=np.zeros(2) + 7.0, y_true=np.zeros(2))
    assert separation(("a", erring), ("b", run(t, 0.0, 0.0))).closest[0] == pytest.approx(7.0)


def test_the_closest_of_all_over_time() -> None:
    t = np.arange(0.0, 10.0, 0.1)
    pairs = separations({"a": run(t, 0.0, 0.0), "b": run(t, t, 0.0), "c": run(t + 20.0, 0.0, 9.0)})
    assert [pair.vehicles for pair in pairs] == [("a", "b"), ("a", "c"), ("b", "c")]
    begins, least = closest_over_time(pairs)
    assert begins[0] == 0.0
    np.testing.assert_allclose(least[:10], begins[:10], atol=1e-9)
