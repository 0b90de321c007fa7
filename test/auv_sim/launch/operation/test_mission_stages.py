"""What ends a mission before its path does."""

from __future__ import annotations

from pathlib import Path

import pytest

from auv_sim.launch import mission_plan
from auv_sim.launch.operation import mission_stages
from auv_sim.launch.operation.mission_stages import STALL_BOUND, MissionStages
from auv_sim.launch.options import Options
from auv_sim.launch.outcome import MissionFailed


def test_a_mission_fails_where_time_stands_still_and_has_to_pass(
    short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Nodes:
        stamp, mission_time = 7, 0.0

        def dead(self) -> None: ...

    now = [0.0]
    monkeypatch.setattr(mission_stages.time, "monotonic", lambda: now[0])
    plan = mission_plan.make(Options(mission=str(short_mission), wait=True), tmp_path)
    stages = MissionStages(plan, Nodes(), None, Nodes(), None, None, None)  # type: ignore[arg-type]
    stages._check_progress(True)
    for has_to_pass in (True, False, True):
        now[0] += STALL_BOUND - 1.0
        stages._check_progress(has_to_pass)
    now[0] += 2.0
    with pytest.raises(MissionFailed, match="time stood still"):
        stages._check_progress(True)
