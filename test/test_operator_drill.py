"""An operator steers a flight over the graph; a rerun of its recording gives the same bits."""

from __future__ import annotations

import json
import math
import os
import re
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParametersAtomically

from auv_msgs_py.contract import qos, topics
from auv_sim.bags.content.recorded_mission import mission_in
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.load import load_messages
from auv_sim.bags.verbs.rerun import rerun
from auv_sim.cli.bag import main as bag_command
from console_browser import ConsoleBrowser, address_of
from node_bench import Bench

#: Length that takes lockstep a minute of wall time, m: no pause of a process outlasts a mission.
LENGTH = 30_000.0
MISSION = """\
version: 1
name: {name}
frame: ned
thrust: 6.48
segments: [{{line: {{start: [0, 0], length: 30000, course_deg: {course}}}}}]
{more}
"""


def mission(name: str, course: float, more: str = "") -> str:
    """Return a mission along a line from the origin."""
    return MISSION.format(name=name, course=course, more=more)


class Operator:
    """An operator who has only services, parameters and topics."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self.call = bench.call
        self.s = 0.0
        self.state = self.mission = ""
        read = {topics.PATH_PARAMETER: self._at, topics.MISSION_STATE: self._is}
        for topic, keep in (*read.items(), (topics.MISSION_STATUS, self._has)):
            kind = qos.message_class(topic.type)
            bench.node.create_subscription(
                kind, topic.name, keep, qos.requested(topic, reliable=False, depth=1)
            )

    def _at(self, message: Any) -> None:
        self.s = message.data

    def _is(self, message: Any) -> None:
        self.state = message.data

    def _has(self, message: Any) -> None:
        self.mission = {pair.key: pair.value for pair in message.values}["mission"]

    def flies(self, after: float = 0.0) -> None:
        """Wait until a new message says that the mission runs, and another that P is after a place."""
        self.s, self.state = 0.0, ""
        self._bench.until(lambda: self.state == "running" and self.s > after)

    def set(self, node: str, **values: Any) -> str:
        """Set parameters; return why they were refused."""
        client = self._bench.node.create_client(SetParametersAtomically, f"{node}/set_parameters_atomically")
        self._bench.until(client.service_is_ready)
        request = SetParametersAtomically.Request()
        for name, value in values.items():
            text = isinstance(value, str)
            kind = ParameterType.PARAMETER_STRING if text else ParameterType.PARAMETER_DOUBLE
            kind = ParameterType.PARAMETER_BOOL if isinstance(value, bool) else kind
            found = ParameterValue(type=kind)
            field = {1: "bool_value", 3: "double_value", 4: "string_value"}[kind]
            setattr(found, field, value)
            request.parameters.append(Parameter(name=name.replace("__", "."), value=found))
        future = client.call_async(request)
        self._bench.until(future.done)
        return str(future.result().result.reason)


def check_rows(browser: ConsoleBrowser, run: Path) -> None:
    """The console's rows and the lines about its browser are those of the recording."""
    stamps, values = [], []
    for _, message in load_messages(run / "bag", "odom"):
        stamps.append(message.header.stamp.sec + message.header.stamp.nanosec * 1e-9)
        place, twist = message.pose.pose.position, message.twist.twist.linear
        values.append((place.x, place.y, place.z, math.hypot(twist.x, twist.y)))
    recorded = np.array(values, np.float32)
    t = browser.column("t")
    at = np.searchsorted(stamps, t - 0.01)
    assert len(t) > 5
    assert np.array(stamps)[at] == pytest.approx(t, abs=1e-3)
    for k, name in enumerate("xyz"):
        assert np.array_equal(recorded[at, k], browser.column(name).astype(np.float32)), name
    ground = np.hypot(browser.column("ve"), browser.column("vn"))
    assert ground == pytest.approx(recorded[at, 3], abs=1e-5)
    errors = {np.float32(message.vector.y) for _, message in load_messages(run / "bag", "path_error")}
    seen = browser.column("ye").astype(np.float32)
    assert set(seen[np.isfinite(seen)]) <= errors
    said = [log.msg for _, log in load_messages(run / "bag", "rosout") if log.name == topics.CONSOLE]
    # Every request has a socket of its own, and is repeated where a node answers too late.
    deeds = [re.sub(r"^/auv: browser \d+: ", "", line) for line in said]
    assert "set heading_autopilot autopilot.nism.k1 1" in deeds
    assert deeds[-1] == "abort"


def check_missions(run: Path) -> None:
    """Each mission of the recording has figures of its own, on its own path, from where it began."""
    flight = mission_in(read_bag(run / "bag"))
    assert [(part.mission.name, part.place, part.ended[0]) for part in flight.parts if part.mission] == [
        ("first", "", "holding"), ("other", "50 m", "holding"), ("goal", "", "aborted"),
    ]  # fmt: skip
    first, second, third = flight.parts
    assert first.run and second.run and third.run
    assert first.run.t[-1] < second.run.t[0] < second.run.t[-1] < third.run.t[0]
    assert second.summary is not None
    away = np.abs(second.run.x[second.run.thrust_cmd > 0.0])  # north of a path that goes east
    assert second.summary.largest_distance == pytest.approx(away.max(), abs=0.05)
    assert 0.0 <= second.summary.flown_share < 0.5
    assert bag_command(["report", str(run), "--out", str(run / "page")]) == 0
    text = (run / "page" / "report.html").read_text(encoding="utf-8")
    table = json.loads(text.split('type="application/json">')[1].split("</script>")[0])["table"]
    assert [row[:3] for row in table] == [
        ["mission", "began at", "outcome"], ["1 first", "start", "holding"],
        ["2 other", "50 m", "holding"], ["3 goal", "start", "aborted"],
    ]  # fmt: skip
    assert (run / "page" / "mission_3" / "track.png").exists()


def test_a_drill_is_recorded_and_flown_again_by_a_rerun(
    bench: Bench,
    domain: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    command_line: Callable[..., list[str]],
    spawn: Callable[..., subprocess.Popen[str]],
) -> None:
    run = tmp_path / "run"
    operator = Operator(bench)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    console = spawn(command_line("auv_sim.cli.console", "--domain", domain, "--port", 0))
    browser = ConsoleBrowser(address_of(console))
    file = tmp_path / "first.yaml"
    file.write_text(mission("first", 20.0), encoding="utf-8")
    asked = ["--mission", file, "--composed", "--domain", domain, "--out", run, "--quiet"]
    flight = spawn(command_line("auv_sim.cli.mission", *asked))
    operator.flies(20.0 / LENGTH)
    browser.until(lambda: len(browser.rows) > 5)
    before = browser.column("t")
    assert operator.set(topics.GUIDANCE, mission_text="version: 1").startswith("mission_text: ")
    assert operator.call("hold").success
    assert operator.set(topics.AUTOPILOT, autopilot__nism__k1=0.55) == ""
    assert "out of range" in operator.set(topics.AUTOPILOT, autopilot__nism__k1=-1.0)
    assert operator.call("resume").success
    operator.flies(40.0 / LENGTH)
    os.kill(console.pid, signal.SIGSTOP)  # no node waits for it
    assert operator.call("hold").success
    tight = mission("other", 90.0, "geofence: [[0, 0], [1, 0], [1, 1]]")
    assert "geofence" in operator.set(topics.GUIDANCE, mission_text=tight)
    assert operator.set(topics.GUIDANCE, mission_text=mission("other", 90.0), start_at="50 m") == ""
    assert operator.call("resume").success
    operator.flies(80.0 / LENGTH)
    assert operator.call("hold").success
    console.kill()
    port = browser.address.rpartition(":")[2].partition("/")[0]
    console = spawn(command_line("auv_sim.cli.console", "--domain", domain, "--port", port))
    address_of(console)
    browser.until(lambda: browser.texts["tick"]["fresh"] and browser.texts["tick"]["state"] == "holding")
    assert browser.ask("set", node=topics.AUTOPILOT, name="autopilot.nism.k1", value=1)["message"] == ""
    refused = browser.ask("set", node=topics.AUTOPILOT, name="autopilot.nism.k1", value="much")
    assert refused["message"] == "autopilot.nism.k1: found 'much', expected a value of type double"
    assert operator.set(topics.GUIDANCE, accept_goal=True, start_at="") == ""
    assert not browser.ask("goal", x=20000.0, y="far", z=0.0, yaw=0.0)["ok"]
    assert browser.ask("goal", x=20000.0, y=20000.0, z=0.0, yaw=0.0)["ok"]
    bench.until(lambda: operator.mission == "goal")
    assert operator.call("resume").success
    operator.flies(0.05)
    assert browser.ask("abort")["message"] == "abort was called"
    assert flight.wait(180) == 1
    check_missions(run)
    browser.until(lambda: not browser.texts["tick"]["fresh"])
    assert set(before) <= set(browser.column("t")), "the track of the console that was killed"
    assert browser.ask("abort") == {
        "kind": "answer", "id": 1, "ok": False, "message": "no node offers /auv/abort",
    }  # fmt: skip
    assert "ailos_guidance is silent" in [alarm["text"] for alarm in browser.texts["alarms"]["alarms"]]
    check_rows(browser, run)

    statuses = [
        {pair.key: pair.value for pair in message.values}
        for _, message in load_messages(run / "bag", "mission_status")
    ]
    flown = list(dict.fromkeys((one["mission"], one["reason"]) for one in statuses))
    assert flown == [
        ("first", "waiting for the start service"), ("first", "started"),
        ("first", "hold was called"), ("first", "resume was called"),
        ("other", "hold was called"), ("other", "resume was called"),
        ("goal", "hold was called"), ("goal", "resume was called"), ("goal", "abort was called"),
    ]  # fmt: skip
    again = rerun(run / "bag")
    for name in ("rudder_cmd", "thrust_cmd", "desired_yaw", "path_parameter"):
        recorded, new = again.recorded[name], again.new[name]
        there = np.isfinite(recorded)
        assert math.isfinite(recorded[there].sum()) and there.sum() > 200
        differs = np.flatnonzero(recorded[there] != new[there])
        assert differs.size == 0, (name, differs[:5], again.t[there][differs[:5]])
