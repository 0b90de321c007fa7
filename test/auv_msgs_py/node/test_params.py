"""Parameters: ranges, live changes, refusals."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter

from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.settings.schema import nested
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from auv_sim.nodes.plant_node import RemusPlantNode
from auv_sim.sim_parameters import SUITE
from node_bench import Bench


def test_gains_may_change_in_flight_and_wiring_may_not(bench: Bench) -> None:
    node = bench.start(HeadingAutopilotNode)

    def change(**values: Any) -> Any:
        parameters = [Parameter(name.replace("__", "."), value=value) for name, value in values.items()]
        return node.set_parameters_atomically(parameters)

    assert change(autopilot__nism__k1=0.5).successful
    assert node.autopilot.config.controller.gains.k1 == 0.5
    for wrong in (-1.0, math.nan, 1e9):
        refused = change(autopilot__nism__k1=wrong)
        assert not refused.successful
        assert node.autopilot.config.controller.gains.k1 == 0.5
    assert not change(lockstep=True).successful
    described = node.describe_parameter("autopilot.nism.k1")
    assert "[rad/s]" in described.description
    assert described.floating_point_range[0].to_value == 10.0
    assert node.describe_parameter("vehicle").read_only


def test_what_the_vehicle_cannot_bear_is_refused_in_flight_and_changes_nothing(
    bench: Bench, tmp_path: Path
) -> None:
    measured = tmp_path / "measured.yaml"
    measured.write_text(
        "name: measured\nlength: 2.0\nthrust_max: 10\nrudder: {max_angle_deg: 25, max_rate_deg_s: 10}\n"
        "cruise: {thrust: 8, speed: 2}\nturning: {radius: 9.5}\n"
    )
    own = {"enabled": True, "max_rate": 0.3, "max_acceleration": 0.2, "max_jerk": 0.5}
    given = {f"autopilot__reference__{name}": value for name, value in own.items()}
    node = bench.start(HeadingAutopilotNode, vehicle=str(measured), **given)
    before, limits = node.parameters, node.autopilot.config.reference.limits

    name = "autopilot.reference.max_jerk"
    (result,) = node.set_parameters([Parameter(name, value=0.0)])
    assert not result.successful
    assert (
        "nothing to derive reference.max_jerk from, which is 0" in result.reason and "\n" not in result.reason
    )
    assert node.get_parameter(name).value == 0.5
    assert node.parameters is before and node.autopilot.config.reference.limits is limits

    (result,) = node.set_parameters([Parameter(name, value=0.6)])
    assert result.successful and node.autopilot.config.reference.limits.jerk == 0.6


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


def test_a_parameter_may_say_auto_where_0_means_that(bench: Bench) -> None:
    node = bench.start(GuidanceNode, guidance__switching__radius="auto")
    assert node.get_parameter("guidance.switching.radius").value == 0.0
    assert node.parameters.guidance.switching.radius == 0.0
    with pytest.raises(ConfigurationError, match="found 'auto', expected a number"):
        bench.start(GuidanceNode, guidance__ailos__lookahead="auto")


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
        (
            HeadingAutopilotNode,
            {"autopilot.nism.k1": True},
            "autopilot.nism.k1: found True, expected a number",
        ),
        (RemusPlantNode, {"seed": True}, "seed: found True, expected a whole number"),
        (HeadingAutopilotNode, {"lockstep": 1}, "lockstep: found 1, expected true or false"),
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


@pytest.mark.parametrize("at_first", [False, True])
def test_a_node_keeps_the_clock_that_it_was_started_with(bench: Bench, at_first: bool) -> None:
    node = bench.start(HeadingAutopilotNode, use_sim_time=at_first)
    (result,) = node.set_parameters([Parameter("use_sim_time", value=not at_first)])
    assert not result.successful
    assert "parameter use_sim_time: found" in result.reason and "at the start only" in result.reason
    assert node.get_clock().ros_time_is_active is at_first
    (result,) = node.set_parameters([Parameter("use_sim_time", value=at_first)])
    assert result.successful


def _with_file(text: str, folder: Path) -> dict[str, Any]:
    file = folder / "params.yaml"
    file.write_text(text)
    return {"cli_args": ["--ros-args", "--params-file", str(file)]}


def test_a_shared_block_may_hold_what_other_nodes_have(bench: Bench, tmp_path: Path) -> None:
    shared = "/**: {ros__parameters: {robot: torpedo, autopilot.nism.k1: 0.5}}\n"
    node = HeadingAutopilotNode(**_with_file(shared, tmp_path))
    assert node.autopilot.config.controller.gains.k1 == 0.5
    node.destroy_node()
    own = "/**/heading_autopilot: {ros__parameters: {robot: torpedo}}\n"
    with pytest.raises(ConfigurationError, match="parameter robot: found an unknown name"):
        HeadingAutopilotNode(**_with_file(shared + own, tmp_path))


def test_a_dump_of_a_node_is_a_parameter_file(bench: Bench, tmp_path: Path) -> None:
    node = bench.start(GuidanceNode)
    names = node.list_parameters([], 0).names
    assert "start_type_description_service" in names
    flat = {name: node.get_parameter(name).value for name in names}
    file = tmp_path / "dump.yaml"
    yaml_file.dump({"/auv/ailos_guidance": {"ros__parameters": nested(flat)}}, file)
    assert params_file.load(file, SUITE, "/auv")["ailos_guidance"] == node.parameters
