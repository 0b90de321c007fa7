"""The layout plots fields that exist, in the namespace that was asked for."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from auv_msgs_py.contract import qos
from auv_sim.cli import live_view
from auv_sim.nodes.live_view import bridge
from auv_sim.nodes.live_view.foxglove_layout import PLOTS, layout


def test_every_series_is_a_number_of_a_topic_that_is_served() -> None:
    for series in PLOTS.values():
        for _, topic, field in series:
            value = qos.message_class(topic.type)()
            for name in field.split("."):
                value = getattr(value, name)
            assert isinstance(value, float)
            assert topic in bridge.SHOWN


def test_the_layout_is_that_of_one_vehicle() -> None:
    pytest.importorskip("foxglove", reason="foxglove-sdk is not installed: requirements/foxglove.txt")
    whole = json.loads(layout("/boat"))
    text = json.dumps(whole)
    assert "/boat/path_error.vector.y" in text and "/boat/mission_state.data" in text and "/auv/" not in text
    assert {"ThreeDee", "Plot", "Log", "DiagnosticsSummary", "StateTransitions"} <= {
        part.split('"')[0] for part in text.split('"panelType": "')[1:]
    }


def test_without_the_sdk_one_line_says_how_to_get_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "foxglove", None)
    assert live_view.main(["--layout", str(tmp_path / "layout.json")]) == 2
    assert capsys.readouterr().err.strip() == (
        "foxglove-sdk: found not installed, expected pip install -r requirements/foxglove.txt"
    )
    assert not (tmp_path / "layout.json").exists()
