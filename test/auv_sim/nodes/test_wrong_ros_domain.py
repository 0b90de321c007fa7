"""A wrong ROS_DOMAIN_ID costs one line, whichever command starts ROS."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import ModuleType

import pytest

from auv_sim.cli import console, live_view
from auv_sim.cli.vehicles import check_vehicle
from auv_sim.nodes import plant_node
from auv_sim.nodes.display import display_node

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
    start: Callable[[], int], named: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "foxglove", ModuleType("foxglove"))  # not installed with the suite
    monkeypatch.setenv("ROS_DOMAIN_ID", named)
    assert start() == 2
    assert capsys.readouterr().err == f"ROS_DOMAIN_ID: found '{named}', expected a ROS domain from 0 to 232\n"
