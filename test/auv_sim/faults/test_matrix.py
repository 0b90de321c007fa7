"""A representative part of the fault matrix, over DDS, in one short flight."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from auv_sim.faults.cli import main
from auv_sim.faults.expectations import REPRESENTATIVE


def test_what_fails_is_noticed_and_the_vehicle_is_safe(domain: int, tmp_path: Path) -> None:
    record = tmp_path / "matrix.json"
    code = main(["--domain", str(domain), "--json", str(record), "--out", str(tmp_path / "out")])
    rows = json.loads(record.read_text(encoding="utf-8"))["rows"]
    assert {row["name"]: row["wrong"] for row in rows} == {name: [] for name in REPRESENTATIVE}
    assert code == 0
    assert (tmp_path / "out" / "bag" / "metadata.yaml").is_file()


def test_a_row_that_is_not_there_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["odom burn"]) == 2
    assert capsys.readouterr().err.strip() == "ROW: found 'odom burn', expected a name that --list prints"


def test_the_rows_can_be_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--list"]) == 0
    assert "ailos_guidance kill" in capsys.readouterr().out.splitlines()
