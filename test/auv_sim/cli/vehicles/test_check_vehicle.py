"""check_vehicle over real DDS: a handful of planted mistakes, our simulator, our driver, and its manners."""

from __future__ import annotations

import io
import json
import subprocess
import sys
import time
from collections.abc import Callable

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock

from auv_msgs_py.node.graph_look import GraphTaken
from auv_path_following import vehicle
from auv_sim.checks.vehicle_check.items.all_items import check
from auv_sim.checks.vehicle_check.live.listener import VehicleListener
from auv_sim.checks.vehicle_check.live.self_test import Arrivals, find_all
from auv_sim.checks.vehicle_check.live.small_test import SmallTest
from auv_sim.checks.vehicle_check.planted import PLANTED
from auv_sim.cli.vehicles.check_vehicle import main
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.nodes.plant_node import RemusPlantNode

CommandLine = Callable[..., list[str]]
REMUS = vehicle.load("remus100")
CONSENT = ["--wiggle", "--yes-the-vehicle-may-move"]
#: What only the wire can show, and some of each other kind.
OVER_DDS = {
    "honest", "wrong-type", "qos-mismatch", "yaw-ned", "wall-clock", "rudder-sign",
    "bare", "bare-rudder-sign", "bare-noisy",
}  # fmt: skip


def test_planted_mistakes_are_found_over_the_wire(domain: int) -> None:
    planted = [planted for planted in PLANTED if planted.name in OVER_DDS]
    found = find_all(planted, REMUS)
    assert found == {p.name: {p.mistake} if p.mistake else set() for p in planted}


def test_a_lost_message_delays_one_step_and_not_all_that_follow() -> None:
    sent, heard = [1, 2, 3], [1, 3]
    messages = Arrivals(lambda: len(sent), lambda: len(heard))
    assert not messages.are_complete()
    messages.give_up()
    assert messages.are_complete()
    sent.append(4)
    assert not messages.are_complete()
    heard.append(4)
    assert messages.are_complete()


def test_the_simulator_passes(domain: int) -> None:
    rclpy.init(args=[], domain_id=domain)
    try:
        overrides = {"hold_until_running": False, "speed": 10.0, "initial.psi": 0.4, "current.Vx": 0.1}
        plant = RemusPlantNode(
            namespace="/auv", use_global_arguments=False,
            parameter_overrides=[Parameter(name, value=value) for name, value in overrides.items()],
        )  # fmt: skip
        clock = Parameter("use_sim_time", value=True)
        node = rclpy.create_node("check_vehicle", parameter_overrides=[clock])
        listener = VehicleListener(node, "/auv", hears_commands=False)
        small_test = SmallTest(listener, REMUS)
        executor = SingleThreadedExecutor()
        for each in (plant, node):
            executor.add_node(each)

        def until(condition: Callable[[], object]) -> None:
            deadline = time.monotonic() + 180.0
            while not condition():
                assert time.monotonic() < deadline
                executor.spin_once(timeout_sec=0.02)

        until(lambda: listener.recording.odom and listener.recording.water and listener.now() > 1.0)
        begin = listener.now()
        while small_test.tick():
            until(small_test.is_due)
        verdicts = check(listener.finish(begin, sim_time=True), REMUS)
        # How fast commands come through is this machine's affair at ten times real time.
        assert [v for v in verdicts if v.mistake is not None and "dead time" not in v.item] == []
        assert small_test.cut_short == ""
        plant.destroy_node()
        node.destroy_node()
    finally:
        rclpy.try_shutdown()


def test_the_driver_passes(
    command_line: CommandLine, spawn: Callable[..., object], domain: int, capsys: pytest.CaptureFixture[str]
) -> None:
    port = free_port()
    parameters = [f"address:=udpin:127.0.0.1:{port}", "clock_speed:=20.0"]
    flags = [word for parameter in parameters for word in ("-p", parameter)]
    spawn(command_line("auv_sim.nodes.mavlink.driver", "--ros-args", "-r", "__ns:=/auv", *flags))
    emulator = ["--address", f"udpout:127.0.0.1:{port}", "--speed", "20", "--initial", "0", "0", "25"]
    spawn(command_line("auv_sim.nodes.mavlink.emulator", *emulator))
    assert main([*CONSENT, "--wait", "180", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["passed"] is True
    assert {item["verdict"] for item in report["items"]} <= {"pass", "warning"}


def test_nothing_there_is_a_failure_and_named(domain: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--duration", "0.2", "--wait", "0.2", "--json"]) == 1
    items = json.loads(capsys.readouterr().out)["items"]
    assert {item["mistake"] for item in items if item["verdict"] == "fail"} == {"MISSING_TOPIC", "DEAF"}
    missing = [item["measured"] for item in items if item["mistake"] == "MISSING_TOPIC"]
    assert missing == [f"no publisher in ROS domain {domain}, discovery range LOCALHOST"] * 2


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--wiggle"], "--wiggle: found no terminal to ask at"),
        (["--yes-the-vehicle-may-move"], "--yes-the-vehicle-may-move: found no --wiggle"),
        (["--vehicle", "no_such_vehicle"], "no_such_vehicle"),
    ],
)
def test_bad_input_is_one_line_and_moves_nothing(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO())
    assert main(arguments) == 2
    told = capsys.readouterr().err.strip()
    assert complaint in told
    assert "\n" not in told


_UNTIL_COMMANDED = """
import sys, time, rclpy
rclpy.init(args=[], domain_id=int(sys.argv[1]))
node = rclpy.create_node("looker")
while not node.get_publishers_info_by_topic("/auv/rudder_cmd"):
    time.sleep(0.05)
"""


def test_it_does_not_take_the_rudder_from_another_node(
    command_line: CommandLine, spawn: Callable[..., object], domain: int, capsys: pytest.CaptureFixture[str]
) -> None:
    spawn(command_line("auv_path_following.nodes.heading_autopilot_node", "--ros-args", "-r", "__ns:=/auv"))
    # In another process: a second participant of one process is discovered up to 3 s later than the first.
    subprocess.run([sys.executable, "-c", _UNTIL_COMMANDED, str(domain)], check=True, timeout=180)
    assert main([*CONSENT, "--wait", "2"]) == 2
    assert "heading_autopilot sending commands" in capsys.readouterr().err


def test_the_self_test_stays_out_of_a_graph_that_has_a_clock(domain: int) -> None:
    rclpy.init(args=[], domain_id=domain)
    other = rclpy.create_node("gazebo")
    other.create_publisher(Clock, "/clock", 10)
    try:
        with pytest.raises(GraphTaken, match="found /clock published by /gazebo"):
            find_all([PLANTED[0]], REMUS)
    finally:
        other.destroy_node()
        rclpy.try_shutdown()
