"""What a mission reports when it is over, and how it is judged."""

from __future__ import annotations

import dataclasses
import io
import json
import math
import shlex
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from auv_sim.cli import mission as mission_command
from auv_sim.flight import closed_loop
from auv_sim.flight.figures.mission_summary import CornerSummary
from auv_sim.flight.metrics import summarise
from auv_sim.flight.run_record import Run
from auv_sim.launch import launcher, mission_plan, mission_results
from auv_sim.launch.options import Options
from auv_sim.launch.outcome import Outcome


def test_figures_have_units_and_the_next_command_is_quoted(short_mission: Path, tmp_path: Path) -> None:
    resolved = mission_plan.make(Options(mission=str(short_mission)), tmp_path)
    summary = summarise(closed_loop.fly(resolved.scenario()), resolved.mission.path)
    printed, directory = io.StringIO(), tmp_path / "my [first] run"
    console = Console(file=printed, width=140, highlight=False)
    mission_results.show(resolved, directory, Outcome("complete", "", 10.0, 40.0), summary, console)
    for head in ("time (s)", "rms distance (m)", "largest (m)", "rms heading error (°)", "rudder (°/m)"):
        assert head in printed.getvalue()
    # The launcher's 40 s are those that it saw; the mission's own time is in the table.
    assert "flown in 10.0 s of wall time, 4 times real time" in printed.getvalue().splitlines()
    last = printed.getvalue().splitlines()[-1].removeprefix("Look further:")
    assert shlex.split(last) == ["python3", "scripts/bag.py", "report", str(directory)]


def test_what_was_not_reached_has_no_figure(short_mission: Path, tmp_path: Path) -> None:
    resolved = mission_plan.make(Options(mission=str(short_mission)), tmp_path)
    summary = summarise(closed_loop.fly(resolved.scenario()), resolved.mission.path)
    corner = CornerSummary(joint=2, x=0.0, y=0.0, largest_distance=math.nan)
    early = dataclasses.replace(
        summary, corners=(corner,), largest_distance_off_corners=math.nan, navigation_error=0.25
    )
    told = io.StringIO()
    mission_results.show(
        resolved, tmp_path, Outcome("interrupted", "", 1.0, 1.0), early, Console(file=told, width=140)
    )
    assert "at most -" not in told.getvalue()
    assert "true distances; odometry off by at most 0.25 m" in told.getvalue()


@pytest.fixture
def skips_a_fifth(short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """The launcher's bag: a complete mission whose virtual point ran ahead while the vehicle cut the arc."""
    run = closed_loop.fly(mission_plan.make(Options(mission=str(short_mission)), tmp_path).scenario())
    on_the_arc = run.subpath(3) == 1
    cut = dataclasses.replace(run, x=run.x - np.where(on_the_arc, 8.0, 0.0))
    monkeypatch.setattr(mission_results, "load", lambda _: cut)
    monkeypatch.setattr(launcher, "fly", lambda *_: Outcome("complete", "", 10.0, 40.0))
    return cut


@pytest.mark.parametrize(("least", "code"), [((), 1), (("--flown", "0.4"), 0), (("--flown", "0.99"), 1)])
def test_complete_means_flown(
    least: tuple[str, ...], code: int, skips_a_fifth: Run, short_mission: Path, tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    directory = tmp_path / "run"
    assert mission_command.main(["--mission", str(short_mission), "--out", str(directory), *least]) == code
    record = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    said = capsys.readouterr()
    assert 0.4 < record["flown_share"] < 0.6 and record["completed"]
    (begin, end), *_ = record["missed"]
    assert f"of the path; missed {begin:.1f} to {end:.1f} m" in said.out
    if code:
        assert record["outcome"] == "incomplete" and "short: incomplete" in said.out
        reason = said.err.removeprefix("mission incomplete: ").strip()
        assert reason == record["reason"]
        assert reason.startswith("found 5") and "expected at least 99 %: missed 1" in reason
    else:
        assert (record["outcome"], record["reason"], said.err) == ("complete", "", "")
        assert "short: complete" in said.out


def test_complete_is_not_reported_where_the_recording_does_not_reach_the_end(
    short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """However much was flown: whatever mission_state said, it may have been forged."""
    run = closed_loop.fly(mission_plan.make(Options(mission=str(short_mission)), tmp_path).scenario())
    short = run.select(run.s < 3.0)
    monkeypatch.setattr(mission_results, "load", lambda _: short)
    monkeypatch.setattr(launcher, "fly", lambda *_: Outcome("complete", "", 10.0, 40.0))
    asked = ["--mission", str(short_mission), "--flown", "0", "--quiet", "--out", str(tmp_path / "run")]
    assert mission_command.main(asked) == 1
    record = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    assert (record["outcome"], record["completed"]) == ("incomplete", False)
    assert "without the path's end" in capsys.readouterr().err


def test_an_aborted_mission_stays_aborted(
    skips_a_fifth: Run, short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(launcher, "fly", lambda *_: Outcome("aborted", "left the geofence", 10.0, 40.0))
    directory = tmp_path / "run"
    assert mission_command.main(["--mission", str(short_mission), "--out", str(directory), "--quiet"]) == 1
    assert json.loads((directory / "summary.json").read_text(encoding="utf-8"))["outcome"] == "aborted"


def test_a_share_that_is_none_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        mission_command.main(["--flown", "99"])
    assert ended.value.code == 2
    assert "found 99, expected a share from 0 to 1" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "least"),
    [(Options(), 0.99), (Options(sea="rough"), 0.8), (Options(sea="rough", flown=0.95), 0.95)],
)
def test_at_sea_less_of_the_path_is_enough_unless_asked_otherwise(options: Options, least: float) -> None:
    """There the vehicle's own navigation may be off by more than a cell's reach."""
    assert options.least_flown == least
