"""A representative part of the fault matrix, over DDS, in one short flight."""

from __future__ import annotations

import json
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from auv_sim.checks.faults.expectations import REPRESENTATIVE
from auv_sim.cli.fault_matrix import main
from conftest import children_of


def test_what_fails_is_noticed_and_the_vehicle_is_safe(domain: int, tmp_path: Path) -> None:
    names, wrong = list(REPRESENTATIVE), dict[str, list[str]]()
    # A process that the machine pauses in a row is a second fault; a row that is wrong stays so.
    for k in range(3):
        record, out = tmp_path / f"{k}.json", tmp_path / f"out{k}"
        code = main([*names, "--domain", str(domain), "--json", str(record), "--out", str(out)])
        rows = json.loads(record.read_text(encoding="utf-8"))["rows"]
        assert {row["name"] for row in rows} == set(names)
        wrong = {row["name"]: row["wrong"] for row in rows if row["wrong"]}
        assert (code == 0) is (not wrong)
        assert (out / "bag" / "metadata.yaml").is_file()
        names = list(wrong)
        if not wrong:
            break
    assert wrong == {}


def test_ctrl_c_ends_the_flight_and_its_nodes(
    command_line: Callable[..., list[str]], spawn: Callable[..., subprocess.Popen[str]], tmp_path: Path
) -> None:
    process = spawn(command_line("auv_sim.cli.fault_matrix", "--out", tmp_path / "out"))
    while not (tmp_path / "out" / "bag").exists():
        assert process.poll() is None
        time.sleep(0.05)
    nodes = children_of(process.pid)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=180)
    assert process.returncode == 130
    assert err.splitlines()[-1] == "interrupted" and "Traceback" not in err
    assert len(nodes) == 4 and not any(Path(f"/proc/{pid}").exists() for pid in nodes)


def test_a_row_that_is_not_there_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["odom burn"]) == 2
    assert capsys.readouterr().err.strip() == "ROW: found 'odom burn', expected a name that --list prints"


def test_the_rows_can_be_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--list"]) == 0
    assert "ailos_guidance kill" in capsys.readouterr().out.splitlines()
