"""Parameters: ranges, live changes, refusals."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.runtime import SuiteNode
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from auv_sim.nodes.plant_node import RemusPlantNode
from node_bench import Bench


def test_gains_may_change_in_flight_and_wiring_may_not(bench: Bench) -> None:
    node = bench.start(HeadingAutopilotNode)

    def change(**values: Any) -> Any:
        parameters = [Parameter(name.replace("__", "."), value=value) for name, value in values.items()]
        return node.set_parameters_atomically(parameters)

    assert change(autopilot__nism__k1=0.5).successful
    assert node.autopilot.controller.config.k1 == 0.5
    for wrong in (-1.0, math.nan, 1e9):
        refused = change(autopilot__nism__k1=wrong)
        assert not refused.successful
        assert node.autopilot.controller.config.k1 == 0.5
    assert not change(lockstep=True).successful
    described = node.describe_parameter("autopilot.nism.k1")
    assert "[rad/s]" in described.description
    assert described.floating_point_range[0].to_value == 10.0
    assert node.describe_parameter("vehicle").read_only


def test_the_parameter_service_refuses_with_a_reason(bench: Bench) -> None:
    bench.start(GuidanceNode)
    client = bench.node.create_client(SetParametersAtomically, "ailos_guidance/set_parameters_atomically")
    bench.until(client.service_is_ready)
    request = SetParametersAtomically.Request(
        parameters=[Parameter("guidance.switching.mode", value="sometimes").to_parameter_msg()]
    )
    future = client.call_async(request)
    bench.until(future.done)
    result = future.result().result
    assert not result.successful
    assert "guidance.switching.mode: found 'sometimes', expected one of 'off', 'g0' or 'all'" in result.reason


@pytest.mark.parametrize(
    ("make", "parameters", "expected"),
    [
        (GuidanceNode, {"mission": "nowhere"}, "nowhere: found no such mission file"),
        (HeadingAutopilotNode, {"vehicle": "nowhere"}, "nowhere: found no such vehicle file"),
        (
            HeadingAutopilotNode,
            {"autopilot.nism.k1": "fast"},
            "autopilot.nism.k1: found 'fast', expected a number",
        ),
        (
            HeadingAutopilotNode,
            {"autopilot.nism.k1": -1.0},
            "autopilot.nism.k1: found -1.0, expected a number",
        ),
        (HeadingAutopilotNode, {"autopilot.nism.kk": 1.0}, "autopilot.nism.kk: found an unknown name"),
        (
            RemusPlantNode,
            {"body_frame": "base_link_frd"},
            "frame_id 'map' with child_frame_id 'base_link_frd'",
        ),
        (RemusPlantNode, {"step": 0.0}, "step: found 0.0, expected a number from 0.001"),
    ],
)
def test_a_parameter_that_cannot_be_used_is_named(
    bench: Bench, make: Callable[..., SuiteNode], parameters: dict[str, Any], expected: str
) -> None:
    overrides = [Parameter(name, value=value) for name, value in parameters.items()]
    with pytest.raises(ConfigurationError) as error:
        make(namespace="/auv", parameter_overrides=overrides, use_global_arguments=False)
    assert expected in str(error.value)
    assert "\n" not in str(error.value)
