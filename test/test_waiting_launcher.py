"""The launcher waits for an operator: missions are started, set and started again over DDS until Ctrl-C."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from std_srvs.srv import Trigger

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.settings import params_file
from auv_sim.sim_parameters import SUITE
from console_browser import ConsoleBrowser

OTHER = """\
version: 1
name: other
frame: ned
thrust: 6.48
segments: [{line: {start: [35, -10], length: 15, course_deg: 90}}]
"""


class Operator:
    """A node that calls what an operator calls, and reads `mission_status`."""

    def __init__(self, domain: int) -> None:
        rclpy.init(args=[], domain_id=domain)
        self.node = rclpy.create_node("operator", namespace="/auv")
        self.status: dict[str, str] = {}
        profile = qos.requested(topics.MISSION_STATUS, reliable=True)
        self.node.create_subscription(DiagnosticStatus, "mission_status", self._on_status, profile)

    def _on_status(self, message: DiagnosticStatus) -> None:
        self.status = {pair.key: pair.value for pair in message.values}

    def until(self, condition: Callable[[], object], patience: float = 180.0) -> None:
        deadline = time.monotonic() + patience
        while not condition():
            assert time.monotonic() < deadline, self.status
            rclpy.spin_once(self.node, timeout_sec=0.05)

    def call(self, kind: Any, service: str, request: Any) -> Any:
        client = self.node.create_client(kind, service)
        self.until(client.service_is_ready)
        future = client.call_async(request)
        self.until(future.done)
        return future.result()

    def trigger(self, service: str) -> bool:
        return bool(self.call(Trigger, service, Trigger.Request()).success)

    def set(self, name: str, value: str) -> str:
        wanted = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=value)
        request = SetParameters.Request(parameters=[Parameter(name=name, value=wanted)])
        return str(self.call(SetParameters, "ailos_guidance/set_parameters", request).results[0].reason)

    def is_it(self, mission: str, state: str) -> bool:
        return (self.status.get("mission"), self.status.get("state")) == (mission, state)


@pytest.fixture
def operator(domain: int) -> Iterator[Operator]:
    made = Operator(domain)
    yield made
    made.node.destroy_node()
    rclpy.try_shutdown()


def answer_with(browser: ConsoleBrowser, field: str, request: str, patience: float = 180.0) -> Any:
    """Ask until every node has answered the console: on a loaded machine one may take too long."""
    deadline = time.monotonic() + patience
    while field not in (answer := browser.ask(request)):
        assert time.monotonic() < deadline, answer
    return answer[field]


def shown_mission(browser: ConsoleBrowser) -> object:
    """The name of the mission whose course the page draws."""
    return browser.texts.get("course", {}).get("mission", {}).get("name")


def check_gains(browser: ConsoleBrowser, directory: Path) -> None:
    """The page's form has the parameters of the nodes; its file can be flown with."""
    form = answer_with(browser, "nodes", "parameters")
    rows = {(node["node"], row["name"]): row for node in form for row in node["parameters"]}
    k1 = rows[topics.AUTOPILOT, "autopilot.nism.k1"]
    assert (k1["type"], k1["value"], k1["default"], k1["unit"]) == ("double", 0.4, 0.8, "rad/s")
    assert (k1["minimum"], k1["maximum"], k1["read_only"], k1["safety"]) == (0.0, 10.0, False, False)
    assert k1["doc"]
    assert rows[topics.GUIDANCE, "holding.abort_after"]["safety"]
    assert {row["safety"] for (_, name), row in rows.items() if name.startswith("gate.")} == {True}
    assert rows[topics.AUTOPILOT, "vehicle"]["read_only"]
    assert (topics.GUIDANCE, "mission_text") not in rows
    file = directory / "changed.yaml"
    file.write_text(answer_with(browser, "text", "parameter_file"))
    assert params_file.load(file, SUITE)[topics.AUTOPILOT].autopilot.nism.k1 == 0.4


def test_missions_follow_each_other_until_ctrl_c(
    operator: Operator,
    domain: int,
    short_mission: Path,
    tmp_path: Path,
    command_line: Callable[..., list[str]],
    spawn: Callable[..., subprocess.Popen[str]],
    node_processes: Callable[[int], dict[str, int]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    run = tmp_path / "run"
    asked = ["--mission", short_mission, "--console", "--start-at", "subpath 3", "--initial", 35, -10, 90]
    asked += ["--composed", "--domain", domain, "--out", run]
    launcher = spawn(command_line("auv_sim.cli.mission", *asked))
    assert launcher.stdout is not None
    before = list(iter(launcher.stdout.readline, "Ctrl-C ends the nodes\n"))
    line = f"ROS_DOMAIN_ID={domain} ros2 service call /auv/start std_srvs/srv/Trigger\n"
    assert before[-1] == f"start the mission: {line}"
    browser = ConsoleBrowser(before[-3].removeprefix("console: ").strip())
    assert before[-2].startswith("to look only: http://127.0.0.1:")
    operator.until(lambda: operator.is_it("short", "idle"))
    assert operator.set("start_at", "") == ""
    check_gains(browser, tmp_path)
    assert browser.ask("check", text=OTHER)["lines"] == ["other: 1 subpaths, 15.0 m, 8 s: no fault found"]
    assert "colour" in browser.ask("load", text=OTHER + "colour: red\n")["message"]
    assert browser.ask("load", text=OTHER)["ok"]
    # The page may show the mission before for a moment, which could have been started.
    browser.until(lambda: shown_mission(browser) == "other" and browser.texts["tick"]["can"]["start"])
    started = browser.ask("start")
    assert started["ok"], started
    operator.until(lambda: operator.is_it("other", "complete"))
    # A writer of a latched topic keeps one report: the launcher must have read this one before the next. One
    # that is lost is sent again after 3 s.
    launcher_has_read = time.monotonic() + 4.0
    operator.until(lambda: time.monotonic() > launcher_has_read)
    os.kill(node_processes(launcher.pid)["console"], signal.SIGKILL)  # a mission does without it
    assert operator.set("mission", str(run / "config" / "mission.yaml")) == ""
    assert operator.set("start_at", "subpath 3") == ""
    operator.until(lambda: operator.is_it("short", "complete") and not operator.status["begun at [s]"])
    assert operator.trigger("start")
    operator.until(lambda: operator.is_it("short", "complete") and operator.status["begun at [s]"])
    # Guidance answers after it has reported, so that the launcher has the report as well.
    assert not operator.trigger("hold")
    assert launcher.poll() is None
    launcher.send_signal(signal.SIGINT)
    out, err = launcher.communicate(timeout=180)
    assert (launcher.returncode, err) == (0, ""), out
    flown = [line for line in out.splitlines() if ": complete, flown " in line]
    assert [line.split(":")[0] for line in flown] == ["other", "short"], out
    summary = json.loads((run / "summary.json").read_text())
    assert (summary["outcome"], summary["completed"]) == ("complete", True)
    assert summary["flown_share"] == 1.0, "of the rest, and of the last mission alone"
    assert summary["steps"] < 40 / 0.05
