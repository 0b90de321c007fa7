"""One step of guidance costs the same however many subpaths the path has."""

from __future__ import annotations

import time

import pytest

from auv_msgs_py.values.types import NO_CURRENT, Navigation, WaterVelocity
from auv_path_following.curves.composite import CompositePath
from auv_path_following.guidance.path_follower import PathFollower
from auv_path_following.missions.routes.smoothing import Smoothing, smooth

_STEPS = 200


def _path(subpaths: int) -> CompositePath:
    """A fermat-smoothed zigzag with at least so many subpaths."""
    corners = max(subpaths // 3, 2)
    points = [(100.0 * k, 60.0 * (k % 2)) for k in range(corners + 2)]
    return CompositePath(smooth(points, Smoothing(kind="fermat", radius=15.0)), 1e-9)


def cost_of_a_step(path: CompositePath) -> float:
    """Seconds of processor time for one step on a spiral in the middle of the path."""
    follower = PathFollower(path)
    spiral = path.n // 6 * 3 + 1  # the costliest kind, and the same kind in every path
    assert path.segments[spiral].kind == "fermat"
    follower.place_at(spiral)
    p = path.evaluate(spiral, 0.0)
    navigation = Navigation(p.x, p.y, p.chi, 0.0)
    began = time.process_time()
    for _ in range(_STEPS):
        follower.update(navigation, WaterVelocity(1.9, 0.0), NO_CURRENT, 0.0)
    return (time.process_time() - began) / _STEPS


@pytest.fixture(scope="module")
def costs() -> dict[int, float]:
    """The best of many rounds, taken in turns: a busy machine slows all of them."""
    paths = {n: _path(n) for n in (10, 1_000, 10_000)}
    rounds = [{n: cost_of_a_step(path) for n, path in paths.items()} for _ in range(25)]
    return {n: min(costs[n] for costs in rounds) for n in paths}


def test_a_step_costs_the_same_for_ten_and_for_ten_thousand_subpaths(costs, record_property):
    for n, seconds in costs.items():
        record_property(f"microseconds of a step with {n} subpaths", round(seconds * 1e6, 1))
    assert max(costs.values()) < 2.0 * min(costs.values())
