"""A short siege: a hostile node publishes on every topic beside a flying graph."""

from __future__ import annotations

from pathlib import Path

import pytest

from auv_sim.checks.faults import siege
from auv_sim.checks.faults.hostile import TOPICS, Malice
from auv_sim.checks.faults.siege import besiege
from auv_sim.cli.fault_matrix import main


def test_nothing_ends_and_everything_is_named(
    domain: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(siege, "_WARM_AT_LEAST", 4.0)
    found = besiege(tmp_path, 4.0, 8.0, lambda _: None)
    assert found.wrong == []
    assert found.refused > 100
    assert set(found.growth) == {
        "recorder", "current_observer", "ailos_guidance", "heading_autopilot", "remus_plant",
    }  # fmt: skip


def test_malice_is_repeatable_and_reaches_every_topic() -> None:
    one, two = Malice(3), Malice(3)
    for topic in TOPICS * 20:
        # The middleware leaves what was in memory between aligned fields: lengths are compared, not bytes.
        assert len(one.of(topic)) == len(two.of(topic))


def test_rows_and_a_siege_exclude_each_other(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--hostile", "5", "odom jump"]) == 2
    assert capsys.readouterr().err.startswith("--hostile: found together with rows")
