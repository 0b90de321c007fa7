"""The node that is named when a step gets no answer, without ROS."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.serialization import serialize_message

from auv_msgs_py.values.errors import MessageRefused
from auv_sim.nodes.held_commands import orders_of
from auv_sim.nodes.stepping.lockstep import Lockstep
from auv_sim.nodes.stepping.wait_reports import WaitReports
from hulls import REMUS


class Simulator:
    """The part of the simulator that lockstep uses."""

    parameters = SimpleNamespace(recorded=False, shared_clock=False, answer_timeout=0.0, recorded_vehicles=1)
    mission_running = True
    steps, stamp, fault = 7, 1_350_000_000, ""

    def listen(self, *_: Any, **__: Any) -> None: ...

    def create_timer(self, *_: Any, **__: Any) -> None: ...

    def gate_waits_for(self) -> str:
        return ""

    def publish_step(self) -> None:
        self.published = getattr(self, "published", 0) + 1

    def advance(self, command: Any) -> None: ...

    def fail(self, text: str) -> None:
        self.fault = text


def reports(**waiting: str) -> DiagnosticArray:
    return DiagnosticArray(
        status=[
            DiagnosticStatus(hardware_id=name, values=[KeyValue(key="waiting_for", value=topic)])
            for name, topic in waiting.items()
        ]
    )


def refusal(node: str, text: str) -> DiagnosticArray:
    values = [KeyValue(key="condition refused", value=text)]
    return DiagnosticArray(status=[DiagnosticStatus(hardware_id=node, values=values)])


TOO_FAST = "desired_yaw_rate: found 13.96, expected from -10 to 10"
TOO_FAR = "rudder_cmd: found 0.9, expected from -0.61 to 0.61"


@pytest.mark.parametrize(
    ("node", "text", "waits", "named"),
    [
        ("heading_autopilot", TOO_FAST, "desired_yaw_rate", f"heading_autopilot refused {TOO_FAST}"),
        ("heading_autopilot", TOO_FAST, "odom, desired_yaw_rate", f"heading_autopilot refused {TOO_FAST}"),
        ("remus_plant", TOO_FAR, "", f"remus_plant refused {TOO_FAR}"),
        # Of an earlier step: what is waited for now is another topic.
        ("heading_autopilot", TOO_FAST, "desired_yaw", "ailos_guidance did not send desired_yaw"),
    ],
)
def test_a_refused_message_is_named_with_its_value_and_not_its_sender(
    node: str, text: str, waits: str, named: str
) -> None:
    simulator: Any = Simulator()
    lockstep = Lockstep(simulator, orders_of(REMUS))
    lockstep.on_mission_state()
    lockstep._reports.hear(serialize_message(refusal(node, text)))
    lockstep._reports.hear(serialize_message(reports(**{node: waits})))
    lockstep._check()
    assert simulator.fault == f"step 7 (t = 1.35 s) got no answer within 0 s: {named}"


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
    lockstep = Lockstep(simulator, orders_of(REMUS))
    lockstep.on_mission_state()
    lockstep._reports.hear(serialize_message(reports(**waiting)))
    lockstep._check()
    assert simulator.fault == f"step 7 (t = 1.35 s) got no answer within 0 s: {named}"


def answer(lockstep: Lockstep, thrust: float) -> None:
    lockstep.on_command("rudder_cmd", 0.0)
    lockstep.on_command("thrust_cmd", thrust)


def say(simulator: Any, lockstep: Lockstep, running: bool) -> None:
    simulator.mission_running = running
    lockstep.on_mission_state()


def test_under_thrust_a_forged_state_holds_nothing_up() -> None:
    simulator: Any = Simulator()
    lockstep = Lockstep(simulator, orders_of(REMUS))
    say(simulator, lockstep, True)
    answer(lockstep, 6.0)
    assert simulator.published == 2
    say(simulator, lockstep, False)
    for step in range(3, 6):
        answer(lockstep, 6.0)
        assert simulator.published == step


def test_the_end_of_a_mission_is_waited_for_though_it_was_forged_before() -> None:
    """The step without thrust is the last one, in whatever order it and the state arrive."""
    simulator: Any = Simulator()
    lockstep = Lockstep(simulator, orders_of(REMUS))
    say(simulator, lockstep, True)
    say(simulator, lockstep, False)
    answer(lockstep, 6.0)
    say(simulator, lockstep, True)
    answer(lockstep, 0.0)
    assert simulator.published == 2  # guidance has not said yet that its mission is over
    say(simulator, lockstep, False)
    assert simulator.published == 2
    say(simulator, lockstep, True)
    assert simulator.published == 3


def test_a_forged_start_costs_one_step_at_rest() -> None:
    """Guidance answers it without thrust and says its state again."""
    simulator: Any = Simulator()
    lockstep = Lockstep(simulator, orders_of(REMUS))
    say(simulator, lockstep, True)
    answer(lockstep, 0.0)
    say(simulator, lockstep, False)
    assert simulator.published == 1
    say(simulator, lockstep, True)
    answer(lockstep, 6.0)
    assert simulator.published == 3


def test_a_node_of_another_vehicle_is_no_culprit() -> None:
    kept = WaitReports("/auv1")
    for namespace, waits in (("/auv2", "current_estimate"), ("/auv1", "desired_yaw"), ("/auv2", "odom")):
        array = reports(heading_autopilot=waits)
        array.status[0].name = f"{namespace}/heading_autopilot"
        kept.take_in(array, 1.0)
    assert kept.culprit(("rudder_cmd",), 0.0) == "ailos_guidance did not send desired_yaw"


def test_only_reports_of_the_own_nodes_are_decoded() -> None:
    simulator: Any = Simulator()
    simulator.parameters = SimpleNamespace(
        recorded=False, shared_clock=True, answer_timeout=0.0, recorded_vehicles=1
    )
    simulator.get_namespace = lambda: "/auv1"
    simulator.advertise = lambda _: SimpleNamespace(publish=lambda _: None)
    lockstep = Lockstep(simulator, orders_of(REMUS))
    lockstep.on_mission_state()
    for namespace, waits in (("/auv1", "desired_yaw"), ("/auv2", "odom")):
        array = reports(heading_autopilot=waits)
        array.status[0].name = f"{namespace}/heading_autopilot"
        lockstep._reports.hear(serialize_message(array))
    lockstep._reports.hear(b"/auv2/no report")
    with pytest.raises(MessageRefused):
        lockstep._reports.hear(b"/auv1/no report")
    lockstep._check()
    assert simulator.fault.endswith("ailos_guidance did not send desired_yaw")
