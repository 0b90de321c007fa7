"""Ctrl-C while the engine compiles and flies."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any

import pytest

from auv_sim.flight.batch import engine


def test_ctrl_c_does_not_wait_for_a_flight_that_is_under_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first flight of a run compiles for half a minute, and no thread can be stopped."""
    under_way, over, flown = threading.Event(), threading.Event(), threading.Event()

    def interrupted(scenarios: Any) -> None:
        under_way.wait(180.0)
        raise KeyboardInterrupt

    def compiling(scenarios: Any) -> None:
        under_way.set()
        over.wait(180.0)
        flown.set()

    chunks = [SimpleNamespace(fly=interrupted, places=[0]), SimpleNamespace(fly=compiling, places=[1])]
    monkeypatch.setattr(engine, "COMPILED", True)
    monkeypatch.setattr(engine, "_chunks", lambda *_: chunks)
    with pytest.raises(KeyboardInterrupt):
        engine.fly([], threads=2)
    assert not flown.is_set()
    over.set()
