"""How the growth of a process is measured, and the memory of the processes themselves."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_sim.checks.soak import long_flight, memory
from auv_sim.checks.soak.long_flight import growth
from auv_sim.cli.soak import main
from auv_sim.flight.run_record import Run
from auv_sim.launch import launcher


def test_what_grows_is_found_and_the_warm_up_does_not_count() -> None:
    rows = [
        (steps, {"flat": 100_000 if steps >= 1000 else 50_000, "leak": 80_000 + steps // 10})
        for steps in map(float, range(0, 10_000, 100))
    ]
    flat, leak = growth([(steps, {k: int(v) for k, v in held.items()}) for steps, held in rows])
    assert (flat.name, leak.name) == ("flat", "leak")
    assert flat.slope == pytest.approx(0.0, abs=1e-6)
    assert leak.slope == pytest.approx(100.0)


def test_memory_of_a_child_is_read_and_drawn(tmp_path: Path) -> None:
    sleeper = subprocess.Popen([sys.executable, "-m", "timeit", "-n", "1", "import time; time.sleep(600)"])
    try:
        held: dict[str, int] = {}
        while held.get("timeit", 0) < 1000:  # the interpreter needs more than that once it has begun
            assert sleeper.poll() is None
            held = memory.of_children(os.getpid())
        memory.draw([(0.0, held), (1000.0, held), (2000.0, held)], 0.0, tmp_path / "soak.png")
        assert (tmp_path / "soak.png").stat().st_size > 1000
    finally:
        sleeper.kill()
        sleeper.wait()


def test_a_soak_that_is_interrupted_has_not_failed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    outcome = launcher.Outcome("interrupted", "stopped by a signal", 1.0, 1.0)
    monkeypatch.setattr(launcher, "fly", lambda *_: outcome)
    assert main(["--minutes", "1", "--out", str(tmp_path / "soak")]) == 130
    assert capsys.readouterr().err == "interrupted: stopped by a signal\n"


def test_a_soak_that_did_not_fly_its_path_has_failed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(launcher, "fly", lambda *_: launcher.Outcome("complete", "", 1.0, 1.0))
    t = np.arange(0.0, 60.0, 1.0)
    run = Run.from_columns({"t": t, "x": 1.9 * t, "y": 0.0 * t, "psi": 0.0 * t, "s": np.minimum(t, 40.0)})
    monkeypatch.setattr(long_flight, "load", lambda _: run)
    assert main(["--minutes", "1", "--out", str(tmp_path / "soak")]) == 1
    assert "soak failed: incomplete: found " in capsys.readouterr().err


def test_a_directory_that_exists_is_never_written_to(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--out", str(tmp_path)]) == 2
    assert "--out" in capsys.readouterr().err


def test_the_survey_of_a_vehicle_that_dives_has_depths(tmp_path: Path) -> None:
    for dives, name in ((False, "remus100"), (True, "remus100_6dof")):
        file = tmp_path / f"{name}.yaml"
        file.write_text(long_flight.survey(dives, 2), encoding="utf-8")
        mission = mission_file.load(str(file), vehicle.load(name))
        assert (mission.spatial is not None) is dives
    assert mission.spatial is not None
    depths = [mission.spatial.evaluate(i, 0.0)[2] for i in range(mission.spatial.n)]
    assert min(depths) == pytest.approx(10.0)
    assert max(depths) == pytest.approx(22.0, abs=0.1)
