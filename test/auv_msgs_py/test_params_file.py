"""Parameter files as ROS 2 takes them."""

from __future__ import annotations

import pytest

from auv_msgs_py import params_file, yaml_file
from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.settings import Pair, setting, settings


@settings
class Gains:
    k1: float = setting(0.8, "one")
    k2: float = setting(1.5, "two")


@settings
class Pilot:
    gains: Gains = setting(factory=Gains, doc="gains")
    place: Pair = setting((0.0, 0.0), "a pair")
    name: str = setting("x", "a name")


CLASSES = {"pilot": Pilot, "observer": Gains}


@pytest.fixture
def loaded(tmp_path):
    def load(text):
        path = tmp_path / "params.yaml"
        path.write_text(text, encoding="utf-8")
        return params_file.load(path, CLASSES)

    return load


def test_nodes_that_are_not_mentioned_have_their_defaults(loaded):
    assert loaded("/**/pilot:\n  ros__parameters:\n    gains: {k1: 3}\n") == {
        "pilot": Pilot(gains=Gains(k1=3.0)),
        "observer": Gains(),
    }


@pytest.mark.parametrize("pattern", ["pilot", "/pilot", "/auv/pilot", "/**/pilot"])
@pytest.mark.parametrize("body", ["gains: {k1: 3}", "gains.k1: 3", "{gains.k1: 3}", "gains:\n      k1: 3"])
def test_every_spelling_that_ros_takes(loaded, pattern, body):
    assert loaded(f"{pattern}:\n  ros__parameters:\n    {body}\n")["pilot"].gains == Gains(k1=3.0)


def test_two_entries_for_one_node_add_up(loaded):
    text = (
        "/**/pilot:\n  ros__parameters:\n    gains: {k1: 3}\n"
        "/auv/pilot:\n  ros__parameters:\n    gains: {k2: 4}\n"
    )
    assert loaded(text)["pilot"].gains == Gains(k1=3.0, k2=4.0)


def test_dotted_and_nested_keys_of_one_group_add_up(loaded):
    text = "/**/pilot:\n  ros__parameters:\n    gains.k1: 3\n    gains: {k2: 4}\n"
    assert loaded(text)["pilot"].gains == Gains(k1=3.0, k2=4.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("- 1\n", "found [1], expected a mapping of node names"),
        ("", "found None, expected a mapping of node names"),
        (
            "/**/pilto:\n  ros__parameters: {}\n",
            "/**/pilto: found an unknown node, expected one of /**/pilot, ",
        ),
        ("/**/pilot: 3\n", "/**/pilot: found 3, expected one key, ros__parameters"),
        ("/**/pilot:\n  parameters: {}\n", "expected one key, ros__parameters"),
        ("/**/pilot:\n  ros__parameters: 3\n", "/**/pilot.ros__parameters: found 3, expected a mapping"),
        (
            "/**/pilot:\n  ros__parameters: {gains: {k9: 1}}\n",
            "pilot: gains.k9: found an unknown key",
        ),
        (
            "/**/pilot:\n  ros__parameters: {gains.k1: fast}\n",
            "pilot: gains.k1: found 'fast', expected a number",
        ),
        (
            "/**/pilot:\n  ros__parameters: {gains: 3, gains.k1: 1}\n",
            "pilot: gains: found 3, expected a mapping",
        ),
        (
            "/**/pilot:\n  ros__parameters: {gains.k1: 1, gains: 3}\n",
            "pilot: gains: found 3, expected a mapping",
        ),
    ],
)
def test_a_wrong_file_gets_one_line(loaded, text, said):
    with pytest.raises(ConfigurationError) as caught:
        loaded(text)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_as_ros_is_read_back(tmp_path):
    configurations = {
        "pilot": Pilot(gains=Gains(k1=0.1, k2=1e-7), place=(1.0, -2.0), name="1e3"),
        "observer": Gains(k1=2.0),
    }
    data = params_file.as_ros(configurations)
    assert data["/**/pilot"]["ros__parameters"] == {
        "gains.k1": 0.1,
        "gains.k2": 1e-7,
        "place": [1.0, -2.0],
        "name": "1e3",
    }
    path = tmp_path / "params.yaml"
    yaml_file.dump(data, path)
    assert params_file.load(path, CLASSES) == configurations


def test_a_block_for_all_nodes_and_use_sim_time_are_understood(tmp_path):
    path = tmp_path / "params.yaml"
    path.write_text("/**: {ros__parameters: {k1: 0.5, use_sim_time: true}}\n")
    loaded = params_file.load(path, {"one": Gains, "two": Gains})
    assert [node.k1 for node in loaded.values()] == [0.5, 0.5]
