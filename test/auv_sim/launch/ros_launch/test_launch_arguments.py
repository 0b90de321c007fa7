"""The launch arguments are the options of the mission command, with the same values and the same refusals."""

from __future__ import annotations

import dataclasses
import shlex

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.cli import mission
from auv_sim.launch.options import Options, checked_options
from auv_sim.launch.ros_launch import launch_arguments as arguments
from auv_sim.launch.ros_launch import supervisor

MISSION, VEHICLE = arguments.of_mission(), arguments.of_vehicle()
DEFAULTS = {argument.name: argument.default for argument in MISSION}


def options_of(**values: str) -> Options:
    words = arguments.command_line(MISSION, DEFAULTS | values)
    return checked_options(vars(mission.parser_of_one().parse_args(words)))


def test_every_option_is_an_argument_and_nothing_else_is() -> None:
    assert [argument.name for argument in MISSION] == list(vars(mission.parser_of_one().parse_args([])))
    assert {argument.name for argument in MISSION} == {field.name for field in dataclasses.fields(Options)}
    assert all(argument.help for argument in MISSION)


def test_the_defaults_are_those_of_the_command() -> None:
    assert arguments.command_line(MISSION, DEFAULTS) == []
    assert options_of() == Options()


@settings(max_examples=20)
@given(
    st.tuples(*[st.integers(-50, 50).map(lambda tenths: tenths / 10)] * 2),
    st.floats(0.1, 50.0),
    st.booleans(),
    st.integers(0, 232),
)
def test_values_arrive_as_from_the_command(
    current: tuple[float, float], speed: float, composed: bool, domain: int
) -> None:
    given_options = options_of(
        current=f"{current[0]!r} {current[1]!r}", speed=repr(speed), composed=str(composed),
        domain=str(domain), mission="-odd name", out="a b/c",
    )  # fmt: skip
    assert (given_options.current, given_options.speed) == (current, speed)
    assert (given_options.composed, given_options.domain) == (composed, domain)
    assert (given_options.mission, str(given_options.out)) == ("-odd name", "a b/c")


def test_a_refusal_is_the_command_s_own(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(ConfigurationError, match="--seed: found together with --no-sim"):
        options_of(no_sim="true", seed="1")
    with pytest.raises(SystemExit) as ended:
        options_of(speed="fast")
    assert ended.value.code == 2
    assert "argument --speed: invalid number value: 'fast'" in capsys.readouterr().err
    with pytest.raises(ConfigurationError, match="composed:=maybe: found 'maybe', expected true or false"):
        options_of(composed="maybe")


def test_a_vehicle_has_no_argument_that_only_a_simulator_could_obey() -> None:
    assert set(VEHICLE) < set(MISSION)
    for argument in VEHICLE:
        example = {"vehicle_driver": "mavlink", "switching": "off", "domain": "7"}.get(argument.name, "x")
        value = "true" if argument.is_flag else example
        words = arguments.command_line(VEHICLE, {each.name: each.default for each in VEHICLE})
        given_values = vars(supervisor.parser().parse_args([*words, *argument.option(value)]))
        driven = argument.name in ("vehicle_driver", "vehicle_address")
        mode = {"vehicle_driver": "mavlink", "no_sim": False} if driven else {"no_sim": True}
        given_values |= mode | {"vehicle_address": "udpin:127.0.0.1:9"} if driven else mode
        for name in ("nodes_only", "no_recorder", "fleet", "on_exit"):
            del given_values[name]
        checked_options(given_values)


def test_a_list_is_quoted_as_in_a_shell() -> None:
    (initial,) = (argument for argument in MISSION if argument.name == "initial")
    assert initial.option("0 -40 180") == ["--initial", *shlex.split("0 -40 180")]
    assert initial.option(" ") == []
