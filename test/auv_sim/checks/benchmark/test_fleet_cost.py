"""The cost of a vehicle of a fleet; nothing asserts how long anything takes."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from auv_msgs_py.contract import topics
from auv_sim.checks.benchmark.fleet_cost import cost_of_steps, in_own_process
from auv_sim.checks.benchmark.usage import Usage


def test_the_cost_of_a_fleet_is_that_of_a_vehicle_s_step() -> None:
    cost = in_own_process(2, True, 40)
    assert set(cost) == {"composed", topics.FLEET_CLOCK}
    assert 0.0 < cost[topics.FLEET_CLOCK] < cost["composed"] < 1.0


def test_steps_that_were_flown_between_two_looks_do_not_end_a_measurement() -> None:
    """A vehicle that had flown past the end of the measurement when its beginning was first seen."""
    monitor = SimpleNamespace(mission_time=0.0, stamp=0)

    def look(_: float) -> None:
        monitor.mission_time += 100.0
        monitor.stamp += 100_000_000_000

    def until(condition: Callable[[], bool], look: Callable[[], None], _: float) -> None:
        while not condition():
            look()

    used = itertools.count(1.0)
    children: Any = SimpleNamespace(until=until, usage=lambda: {"auv.plant": Usage(next(used), 0)})
    monitor.look = look
    assert cost_of_steps(children, {"auv": monitor}, 40) == {"plant": pytest.approx(1.0 / 2000.0)}
