"""docs/troubleshooting.md quotes the messages as they are: each is produced here."""

from __future__ import annotations

import dataclasses
import importlib.util
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.serialization import serialize_message

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.node.graph_look import GraphLook
from auv_msgs_py.values.errors import SuiteError
from auv_path_following import config_files
from auv_path_following.missions import mission_file
from auv_sim.checks.vehicle_check.items.discovered import check_graph
from auv_sim.checks.vehicle_check.samples import Recording
from auv_sim.flight.closed_loop import fly
from auv_sim.flight.metrics import summarise
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.nodes.held_commands import orders_of
from auv_sim.nodes.stepping.lockstep import Lockstep
from conftest import SHORT_MISSION
from doc_pages import ROOT, listings
from hulls import REMUS

PAGE = "docs/troubleshooting.md"
(MISSION,) = listings("docs/tutorial.md", "yaml")


def of(action: Callable[[], object]) -> str:
    """Return the message of the error that an action raises."""
    with pytest.raises(SuiteError) as found:
        action()
    return str(found.value)


def wrong_python(_: Path) -> str:
    place = importlib.util.spec_from_file_location("set_up", ROOT / "scripts" / "_bootstrap.py")
    assert place and place.loader
    set_up: Any = importlib.util.module_from_spec(place)
    place.loader.exec_module(set_up)
    with pytest.raises(set_up.SetUpError) as found:
        set_up.check_python((3, 10))
    return str(found.value)


def old_pydantic(directory: Path) -> str:
    (directory / "pydantic-1.10.14.dist-info").mkdir()
    metadata = directory / "pydantic-1.10.14.dist-info" / "METADATA"
    metadata.write_text("Name: pydantic\nVersion: 1.10.14\n", encoding="utf-8")
    code = "import sys; sys.path.insert(0, sys.argv[1]); import auv_msgs_py"
    return subprocess.run(
        [sys.executable, "-c", code, directory], capture_output=True, text=True, check=False
    ).stderr.strip()


def no_file(_: Path) -> str:
    return of(lambda: config_files.find("missions", "my_survey"))


def wrong_key(directory: Path) -> str:
    file = directory / "my_survey.yaml"
    file.write_text(MISSION.replace("smoothing:", "smothing:"), encoding="utf-8")
    return of(lambda: mission_file.load(str(file)))


def tight_turn(directory: Path) -> str:
    file = directory / "my_survey.yaml"
    file.write_text(MISSION.replace("radius: 12", "radius: 3"), encoding="utf-8")
    return of(lambda: mission_plan.make(Options(mission=str(file)), directory / "run"))


def no_publisher(_: Path) -> str:
    nothing = Recording(endpoints=[], listened_in="ROS domain 42, discovery range LOCALHOST")
    verdict = check_graph(nothing)[0]
    return f"{verdict.item}: {verdict.measured}"


def clock_taken(_: Path) -> str:
    look: Any = SimpleNamespace(claim=SimpleNamespace(holder="/auv/mission_launcher"))
    return of(lambda: GraphLook._refuse(look, "/clock published by /sim/gazebo"))


def wrong_frames(_: Path) -> str:
    return of(lambda: FrameTable(FrameIds()).of_pose("odom", "world", "base_link"))


def no_answer(_: Path) -> str:
    heard: list[tuple[Any, Callable[[Any], None]]] = []
    timers: list[Callable[[], None]] = []
    simulator: Any = SimpleNamespace(
        parameters=SimpleNamespace(
            recorded=False, answer_timeout=0.0, shared_clock=False, recorded_vehicles=1
        ),
        mission_running=True, steps=7, stamp=1_350_000_000, fault="",
        gate_waits_for=lambda: "", publish_step=lambda: None,
        advance=lambda _: None, listen=lambda topic, callback, **_: heard.append((topic, callback)),
        create_timer=lambda _, callback, **__: timers.append(callback),
    )  # fmt: skip
    simulator.fail = lambda text: setattr(simulator, "fault", text)
    Lockstep(simulator, orders_of(REMUS)).on_mission_state()
    waits = [KeyValue(key="waiting_for", value="desired_yaw")]
    status = DiagnosticStatus(hardware_id="heading_autopilot", values=waits)
    for topic, callback in heard:
        if topic is topics.DIAGNOSTICS:
            callback(serialize_message(DiagnosticArray(status=[status])))
    for callback in timers:
        callback()
    return str(simulator.fault)


def incomplete(_: Path) -> str:
    """Too few degrees of rudder to turn on the arc of a mission."""
    flight = mission_plan.scenario(Options(mission=str(SHORT_MISSION)))
    rudder = dataclasses.replace(flight.vehicle.rudder, max_angle_deg=1.0)
    weak = dataclasses.replace(flight.vehicle, rudder=rudder)
    late = dataclasses.replace(flight, vehicle=weak, controller_vehicle=flight.vehicle, time_limit=120.0)
    return summarise(fly(late), flight.path).shortfall()


#: In the order of the page.
PRODUCERS = (
    wrong_python, old_pydantic, no_file, wrong_key, tight_turn, no_publisher, clock_taken, wrong_frames,
    no_answer, incomplete,
)  # fmt: skip


@pytest.mark.parametrize("number", range(len(PRODUCERS)), ids=[p.__name__ for p in PRODUCERS])
def test_a_message_is_quoted_as_it_is(number: int, tmp_path: Path) -> None:
    quoted = listings(PAGE, "text")[number].strip()
    message = PRODUCERS[number](tmp_path)
    pattern = ".*".join(re.escape(part) for part in quoted.split("..."))
    assert re.fullmatch(pattern, message, re.DOTALL), f"quoted: {quoted}\nproduced: {message}"


def test_every_quoted_message_is_produced() -> None:
    assert len(listings(PAGE, "text")) == len(PRODUCERS) == 10
