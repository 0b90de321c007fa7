"""What a mission prints above its bar."""

from __future__ import annotations

import io

import pytest
from rich.console import Console

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_sim.launch.progress_display import ProgressDisplay

PATH = CompositePath([Line(0.0, 0.0, 50.0, 0.0)])


@pytest.mark.parametrize("quiet", [False, True])
def test_a_quiet_mission_prints_what_is_needed_and_nothing_else(
    quiet: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    drawn = io.StringIO()
    with ProgressDisplay(PATH, Console(file=drawn, quiet=quiet), quiet) as progress:
        progress.say("flies to [50, 0]")
        progress.say("console: http://127.0.0.1:8642/?token=[x]", needed=True)
    lines = (drawn.getvalue() + capsys.readouterr().out).splitlines()
    assert ("flies to [50, 0]" in lines) is not quiet
    assert "console: http://127.0.0.1:8642/?token=[x]" in lines
