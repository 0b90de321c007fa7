"""Configurations as rows of numbers."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from auv_path_following import vehicle
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import CONTROLLERS, AutopilotConfig
from auv_sim.flight.batch.compiled import compiled
from auv_sim.flight.batch.config_rows import flat, layout_of, unpack


class Inner(NamedTuple):
    gain: float
    enabled: bool


class Empty(NamedTuple):
    pass


class Outer(NamedTuple):
    mode: int
    empty: Empty
    inner: Inner
    pair: tuple[float, float]


EXAMPLE = Outer(1, Empty(), Inner(0.5, False), (1.0, 2.0))
OTHER = Outer(2, Empty(), Inner(2.5, True), (3.0, -4.0))


@compiled
def restored(example: Any, rows: Any, k: int) -> Any:
    return unpack(example, rows[k])


def test_a_row_restores_its_configuration() -> None:
    assert flat(OTHER) == [2.0, 2.5, 1.0, 3.0, -4.0]
    assert unpack(EXAMPLE, flat(OTHER)) == OTHER
    back = restored(EXAMPLE, np.array([flat(EXAMPLE), flat(OTHER)]), 1)
    assert back == OTHER
    assert type(back.inner) is Inner and type(back.inner.enabled) is bool and type(back.mode) is int


def test_layouts_differ_where_compiled_code_differs() -> None:
    assert layout_of(EXAMPLE) == layout_of(OTHER)
    assert layout_of(EXAMPLE) != layout_of(EXAMPLE._replace(mode=1.0))


def test_every_controller_travels_as_a_row() -> None:
    hull = vehicle.load("remus100")
    layouts = set()
    for law in CONTROLLERS:
        config = autopilot.prepare(AutopilotConfig(controller=law.name), hull)
        assert restored(config, np.array([flat(config)]), 0) == config
        layouts.add(layout_of(config))
    assert len(layouts) == len(CONTROLLERS)
