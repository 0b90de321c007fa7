"""`vehicle.py manoeuvres` on the simulator: flown by one file, with another hull in the water; recorded."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pydantic
import pytest

from auv_sim.bags.content.recorded_manoeuvres import manoeuvres_in
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.manoeuvre_topics import READ
from auv_sim.cli.vehicles import vehicle_command
from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import ManoeuvreBounds
from auv_sim.own_vehicle.verbs.manoeuvres import BOX, CURRENT, SPEED
from auv_sim.sim_parameters import ConstantCurrent, PlantParameters

PROGRAM = """
version: 1
name: short
legs:
  - straight: {seconds: 4}
  - zigzag: {seconds: 10, rudder_deg: 15, heading_deg: 10}
"""
CODE = "import sys; from auv_sim.cli.vehicles.vehicle_command import main; sys.exit(main(sys.argv[1:]))"


def test_a_rehearsal_is_recorded_for_identification(tmp_path: Path) -> None:
    (tmp_path / "short.yaml").write_text(PROGRAM)
    words = ["manoeuvres", "--vehicle", "remus100_mismatch", "--controller-model", "remus100"]
    words += ["--program", str(tmp_path / "short.yaml"), "--sea", "moderate", "--out", str(tmp_path / "run")]
    words += ["--speed", "1000"]  # more than the machine can do: each odometry still has its own answer
    done = subprocess.run(
        [sys.executable, "-c", CODE, *words], capture_output=True, text=True, check=False, timeout=600
    )
    assert done.returncode == 0, done.stderr
    assert "all manoeuvres are flown" in done.stdout
    assert f"identify {tmp_path}/run/bag --vehicle remus100" in done.stdout
    assert (tmp_path / "run" / "manoeuvres.png").stat().st_size > 10_000
    recorded = manoeuvres_in(tmp_path / "run" / "bag")
    rudder = recorded.rudder.value
    assert np.degrees(rudder).max() == pytest.approx(15.0, abs=0.1)
    assert np.degrees(rudder).min() == pytest.approx(-15.0, abs=0.1)
    # Each odometry of the program has its own answer, before the next one: stamp by stamp.
    answered = recorded.rudder.t[recorded.rudder.t < recorded.rudder.t[0] + 12.0]
    assert np.unique(answered).size == answered.size > 200
    assert set(answered) <= set(recorded.run.t)


def test_one_seed_makes_one_flight_to_the_last_bit(tmp_path: Path) -> None:
    (tmp_path / "short.yaml").write_text(PROGRAM.replace("10,", "2,").replace("seconds: 4", "seconds: 1"))
    words = ["manoeuvres", "--vehicle", "remus100", "--program", str(tmp_path / "short.yaml"), "--quiet"]
    words += ["--sea", "moderate", "--seed", "5", "--speed", "1000"]
    flights = []
    for name in ("first", "second"):
        out = ["--out", str(tmp_path / name)]
        subprocess.run([sys.executable, "-c", CODE, *words, *out], check=True, timeout=600)
        bag = read_bag(tmp_path / name / "bag")
        odometry, log, rudder, thrust = (bag.find(topic.name) for topic in READ[:4])
        assert odometry is not None and log is not None and rudder is not None and thrust is not None
        count = odometry.count  # zeros follow for a time by the wall clock
        flights.append([topic.messages[:count] for topic in (odometry, log, rudder, thrust)])
        assert count == 361  # 3 s, and 15 s of coasting
    assert flights[0] == flights[1]


@pytest.mark.parametrize(
    ("words", "where"),
    [
        (["--no-sim"], "--no-sim"),
        (["--yes-the-vehicle-may-move"], "--yes-the-vehicle-may-move"),
        (["--no-sim", "--controller-model", "remus100"], "--controller-model"),
        (["--no-sim", "--sea", "moderate"], "--sea"),
        (["--no-sim", "--current", "0.2", "0.1"], "--current"),
        (["--no-sim", "--seed", "3"], "--seed"),
        (["--no-sim", "--speed", "2"], "--speed"),
        (["--program", "two_minutes_dive"], "two_minutes_dive: legs"),
        (["--vehicle", "remus100_6dof", "--depth", "101"], "depth: found 101 m"),
        (["--sea", "nowhere"], "nowhere: found no such sea file"),
    ],
)
def test_nothing_moves_without_consent_or_with_options_that_do_not_fit(
    words: list[str], where: str, capsys: pytest.CaptureFixture[str], tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    assert vehicle_command.main(["manoeuvres", "--vehicle", "remus100", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(where)
    assert list(tmp_path.iterdir()) == []


def test_a_wrong_ros_domain_is_refused_before_anything_is_made(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Else the same `--out` would be refused the second time."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_DOMAIN_ID", "233")
    words = ["--vehicle", "remus100", "--no-sim", "--yes-the-vehicle-may-move", "--out", "run"]
    assert vehicle_command.main(["manoeuvres", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("ROS_DOMAIN_ID: found '233'")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("option", ["--box", "--current", "--speed", "--depth"])
@pytest.mark.parametrize("value", ["-6000", "6000.5", "nan", "inf", "-inf", "1e400", "far"])
def test_a_number_that_no_parameter_takes_costs_one_line(
    option: str, value: str, capsys: pytest.CaptureFixture[str], tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    # A leading minus belongs to the value.
    words = [option, value, value] if option == "--current" else [f"{option}={value}"]
    try:
        code = vehicle_command.main(["manoeuvres", "--vehicle", "remus100_6dof", *words])
    except SystemExit as end:
        code = end.code  # type: ignore[assignment]
    assert code == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert value in line or option in line
    assert list(tmp_path.iterdir()) == []


def test_the_ranges_of_the_options_are_those_of_the_parameters() -> None:
    for box in BOX:
        assert ManoeuvreBounds(box=box)
    for settings, key, (low, high) in ((ConstantCurrent, "Vx", CURRENT), (PlantParameters, "speed", SPEED)):
        for value in (low, high):
            assert settings(**{key: value})
        for value in (low - 0.1, high + 0.1):
            with pytest.raises(pydantic.ValidationError):
                settings(**{key: value})
