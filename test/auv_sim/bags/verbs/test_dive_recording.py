"""The verbs that read a recording, on that of a vehicle that dives."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from auv_msgs_py.settings import yaml_file
from auv_sim.cli import bag as bag_command
from auv_sim.cli import mission as mission_command

DIVE = Path(__file__).parents[3] / "data" / "short_dive.yaml"
VERTICAL = ("sternplane_cmd", "desired_pitch", "desired_pitch_rate", "desired_depth")


@pytest.fixture(scope="module")
def dive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A dive over the graph in one process, in lockstep, in a current with upwelling."""
    run = tmp_path_factory.mktemp("recorded") / "run"
    words = ["--mission", str(DIVE), "--vehicle", "remus100_6dof", "--composed", "--quiet"]
    sea = ["--current", "0.1", "0.2", "--upwelling", "-0.05"]
    assert mission_command.main([*words, *sea, "--out", str(run)]) == 0
    return run


def test_a_rerun_commands_the_recorded_bits(dive: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert bag_command.main(["rerun", str(dive), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["steps"] > 600
    assert set(found["topics"]) > set(VERTICAL)
    for name, figures in found["topics"].items():
        assert figures["identical"] == figures["compared"] >= found["steps"] - 1, name


def test_a_rerun_with_another_gain_of_the_pitch_moves_the_planes_alone(
    dive: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    gains = {"/**/heading_autopilot": {"ros__parameters": {"pitch": {"controller": "pid"}}}}
    yaml_file.dump(gains, tmp_path / "new.yaml")
    asked = ["--params", str(tmp_path / "new.yaml"), "--png", str(tmp_path / "rerun.png")]
    assert bag_command.main(["rerun", str(dive), *asked]) == 0
    shown = capsys.readouterr().out
    assert "bit for bit" not in shown
    assert "stern planes new: travel" in shown
    assert bag_command.main(["rerun", str(dive), *asked, "--json"]) == 0
    topics = json.loads(capsys.readouterr().out)["topics"]
    assert topics["sternplane_cmd"]["largest"] > 0.1
    assert topics["rudder_cmd"]["identical"] == topics["rudder_cmd"]["compared"]
    assert (tmp_path / "rerun.png").read_bytes().startswith(b"\x89PNG")
