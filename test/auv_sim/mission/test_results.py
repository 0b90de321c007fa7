"""What is told when a mission is over."""

from __future__ import annotations

import io
import shlex
from pathlib import Path

from rich.console import Console

from auv_sim import closed_loop
from auv_sim.analysis.metrics import summarise
from auv_sim.mission import plan, results
from auv_sim.mission.launcher import Outcome
from auv_sim.mission.plan import Options


def test_figures_have_units_and_the_next_command_is_quoted(short_mission: Path, tmp_path: Path) -> None:
    resolved = plan.make(Options(mission=str(short_mission)), tmp_path)
    summary = summarise(closed_loop.fly(resolved.scenario()), resolved.mission.path)
    told, directory = io.StringIO(), tmp_path / "my [first] run"
    console = Console(file=told, width=140, highlight=False)
    results.show(resolved, directory, Outcome("complete", "", 10.0, 40.0), summary, console)
    for head in ("time (s)", "rms distance (m)", "largest (m)", "rms heading error (°)", "rudder (°/m)"):
        assert head in told.getvalue()
    last = told.getvalue().splitlines()[-1].removeprefix("Look further:")
    assert shlex.split(last) == ["python3", "scripts/bag.py", "report", str(directory)]
