"""Who is named when a step gets no answer, without ROS."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from auv_sim.nodes.lockstep import Lockstep


class Simulator:
    """As much of the simulator as lockstep asks for."""

    parameters = SimpleNamespace(recorded=False, answer_timeout=0.0)
    mission_running = True
    steps, stamp, fault = 7, 1_350_000_000, ""

    def listen(self, *_: Any) -> None: ...

    def create_timer(self, *_: Any, **__: Any) -> None: ...

    def gate_waits_for(self) -> str:
        return ""

    def publish_step(self) -> None: ...

    def fail(self, text: str) -> None:
        self.fault = text


def reports(**waiting: str) -> DiagnosticArray:
    return DiagnosticArray(
        status=[
            DiagnosticStatus(hardware_id=name, values=[KeyValue(key="waiting_for", value=topic)])
            for name, topic in waiting.items()
        ]
    )


@pytest.mark.parametrize(
    ("waiting", "named"),
    [
        ({}, "heading_autopilot did not send rudder_cmd"),
        ({"heading_autopilot": "desired_yaw"}, "ailos_guidance did not send desired_yaw"),
        (
            {"heading_autopilot": "desired_yaw", "ailos_guidance": "current_estimate"},
            "current_observer did not send current_estimate",
        ),
        (
            {
                "heading_autopilot": "desired_yaw",
                "ailos_guidance": "current_estimate",
                "current_observer": "recorder to subscribe to current_estimate",
            },
            "current_observer waits for recorder to subscribe to current_estimate",
        ),
        (
            {"heading_autopilot": "desired_yaw", "ailos_guidance": "odom"},
            "ailos_guidance did not send desired_yaw",
        ),
    ],
)
def test_the_node_that_owes_something_is_named(waiting: dict[str, str], named: str) -> None:
    simulator: Any = Simulator()
    lockstep = Lockstep(simulator)
    lockstep.on_mission_state()
    lockstep._on_diagnostics(reports(**waiting))
    lockstep._check()
    assert simulator.fault == f"step 7 (t = 1.35 s) got no answer within 0 s: {named}"
