"""A replay shows where it is and, where there is a keyboard, what the keys do."""

from __future__ import annotations

import io
import time

import pytest
from rich.console import Console

from auv_sim.bags.playing.play_bar import KEYS, PlayBar


def shown(keys: bool, terminal: bool = True) -> tuple[PlayBar, io.StringIO]:
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=terminal, width=160, color_system=None)
    return PlayBar(console, 634.8, keys), screen


@pytest.mark.parametrize("keys", [True, False])
def test_position_state_and_keys(keys: bool) -> None:
    bar, screen = shown(keys)
    with bar:
        bar.show(12.34, paused=False)
        bar.show(20.0, paused=True, at_once=True)
    line = screen.getvalue()
    assert "paused" in line
    assert "20.0 of 634.8 s" in line
    assert (KEYS in line) == keys


def test_many_messages_do_not_move_it_each(monkeypatch: pytest.MonkeyPatch) -> None:
    bar, _ = shown(False)
    monkeypatch.setattr(time, "monotonic", lambda: 100.0)
    bar.show(1.0, paused=False)
    bar.show(2.0, paused=False)
    assert bar._progress.tasks[0].completed == 1.0
    bar.show(2.0, paused=False, at_once=True)
    assert bar._progress.tasks[0].completed == 2.0
