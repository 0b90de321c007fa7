"""UDP ports for emulated vehicles."""

from __future__ import annotations

import random

import pytest

from auv_sim.launch import vehicle_driver
from auv_sim.launch.processes.claims import claim
from auv_sim.launch.vehicle_driver import free_port


def test_no_two_callers_have_the_same_port_before_it_is_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    """Both draw the same ports; the first two are claimed by another process, as it were."""
    drawn = random.sample(vehicle_driver._PORTS, 50)
    monkeypatch.setattr(vehicle_driver.random, "sample", lambda *_: drawn)
    with claim(f"udp_port/{drawn[0]}") as other:  # type: ignore[union-attr]
        assert other is not None
        first, second = free_port(), free_port()
    assert drawn[0] not in (first, second)
    assert first != second
