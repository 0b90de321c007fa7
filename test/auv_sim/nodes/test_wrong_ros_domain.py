"""A wrong ROS_DOMAIN_ID costs one line, whichever command starts ROS."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from auv_sim.cli import console, live_view
from auv_sim.cli.vehicles import check_vehicle
from auv_sim.nodes import plant_node
from auv_sim.nodes.display import display_node

#: Signals that a command handles while it runs.
HANDLED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
COMMANDS = {
    "console": lambda: console.main(["--port", "0"]),
    "live_view": lambda: live_view.main(["--port", "0"]),
    "check_vehicle": lambda: check_vehicle.main([]),
    "display": lambda: display_node.main([]),
    "plant_node": lambda: plant_node.main([]),
}


@pytest.mark.parametrize("named", ["home", "233"])
@pytest.mark.parametrize("start", COMMANDS.values(), ids=COMMANDS)
def test_a_ros_domain_that_is_none_costs_one_line(
    start: Callable[[], int],
    named: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
) -> None:
    monkeypatch.setitem(sys.modules, "foxglove", ModuleType("foxglove"))  # not installed with the suite
    monkeypatch.setenv("ROS_DOMAIN_ID", named)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    before = [signal.getsignal(number) for number in HANDLED]
    assert start() == 2
    assert [signal.getsignal(number) for number in HANDLED] == before
    assert not (tmp_path / "auv_sim").exists()
    assert capsys.readouterr().err == f"ROS_DOMAIN_ID: found '{named}', expected a ROS domain from 0 to 232\n"
