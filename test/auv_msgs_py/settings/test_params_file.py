"""Parameter files as ROS 2 takes them."""

from __future__ import annotations

import pytest

from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.values.errors import ConfigurationError


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
    def load(text, **where):
        path = tmp_path / "params.yaml"
        path.write_text(text, encoding="utf-8")
        return params_file.load(path, CLASSES, **where)

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


def _blocks(**blocks):
    """Block by block, what k1 is."""
    names = {"two": "/auv2/pilot", "one": "/auv1/pilot", "any": "/**/pilot", "bare": "pilot"}
    return "".join(f"{names[name]}: {{ros__parameters: {{gains.k1: {k1}}}}}\n" for name, k1 in blocks.items())


@pytest.mark.parametrize(
    ("blocks", "first", "second"),
    [
        ({"one": 3, "any": 4}, "/auv1/pilot", "/**/pilot"),
        ({"any": 3, "bare": 4}, "/**/pilot", "pilot"),
        ({"one": 3, "two": 4}, "/auv1/pilot", "/auv2/pilot"),
    ],
)
def test_two_blocks_for_one_node_are_refused(loaded, blocks, first, second):
    with pytest.raises(ConfigurationError) as caught:
        loaded(_blocks(**blocks))
    assert f"{second}: found a second block for pilot, after {first}" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_known_namespace_separates_vehicles(loaded):
    text = _blocks(two=4, one=3)
    assert loaded(text, namespace="/auv1")["pilot"].gains == Gains(k1=3.0)
    assert loaded(text, namespace="/auv2")["pilot"].gains == Gains(k1=4.0)
    assert loaded(text, namespace="auv2/")["pilot"].gains == Gains(k1=4.0)


@pytest.mark.parametrize("pattern", ["/*/pilot", "/**/pilot", "/fleet/**/pilot", "/fleet/*/pilot"])
def test_wildcards_stand_for_a_namespace_as_they_do_in_ros(loaded, pattern):
    text = f"{pattern}: {{ros__parameters: {{gains.k1: 3}}}}\n"
    namespace = "/auv1" if pattern == "/*/pilot" else "/fleet/auv1"
    assert loaded(text, namespace=namespace)["pilot"].gains == Gains(k1=3.0)


@pytest.mark.parametrize("namespace", ["/", "", "/auv", "/fleet/auv1", None])
@pytest.mark.parametrize("pattern", ["/**/pilot", "pilot", "/pilot", "/**/**/pilot"])
def test_what_is_for_every_namespace_is_for_the_root_too(loaded, pattern, namespace):
    text = f"{pattern}: {{ros__parameters: {{gains.k1: 3}}}}\n"
    assert loaded(text, namespace=namespace)["pilot"].gains == Gains(k1=3.0)


@pytest.mark.parametrize("pattern", ["/auv2/pilot", "/*/pilot", "/auv/1/pilot"])
def test_gains_that_would_reach_no_node_are_refused(loaded, pattern):
    with pytest.raises(ConfigurationError) as caught:
        loaded(f"{pattern}: {{ros__parameters: {{gains.k1: 3}}}}\n", namespace="/fleet/auv1")
    said = f"{pattern}: found another namespace than /fleet/auv1, expected /**/pilot or /fleet/auv1/pilot"
    assert said in str(caught.value)


def test_a_mistake_in_another_vehicles_block_is_a_mistake_all_the_same(loaded):
    text = "/auv1/pilot: {ros__parameters: {}}\n/auv2/pilot: {ros__parameters: {gains.k9: 1}}\n"
    with pytest.raises(ConfigurationError, match=r"gains\.k9: found an unknown key"):
        loaded(text, namespace="/auv1")


def test_mistakes_in_several_nodes_are_all_named(loaded):
    text = "pilot:\n  ros__parameters: {gains: {k1: a}, name: 3}\nobserver:\n  ros__parameters: {k3: 1}\n"
    with pytest.raises(ConfigurationError) as caught:
        loaded(text)
    assert str(caught.value).partition("params.yaml: ")[2] == (
        "pilot: gains.k1: found 'a', expected a number; name: found 3, expected a text;"
        " observer: k3: found an unknown key, expected only the documented keys (is it misspelt?)"
    )


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


@pytest.mark.parametrize(
    "body", ["{gains.k1: 3, gains.k1.x: 9}", "{gains: {k1: 3, k1.x: 9}}", "{gains.k1.x: 9}"]
)
def test_a_name_that_is_too_deep_is_not_ignored(loaded, body):
    with pytest.raises(ConfigurationError, match=r"params\.yaml: pilot: gains\.k1"):
        loaded(f"/**/pilot:\n  ros__parameters:\n    {body}\n")


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


@pytest.mark.parametrize("namespace", ["/auv1", "/auv1/deep", None])
def test_a_block_for_all_nodes_of_a_namespace(tmp_path, namespace):
    path = tmp_path / "params.yaml"
    path.write_text("/auv1/**: {ros__parameters: {k1: 0.5}}\n")
    assert params_file.load(path, {"one": Gains}, namespace)["one"].k1 == 0.5


def test_a_nodes_own_block_adds_to_that_for_all_nodes(tmp_path):
    path = tmp_path / "params.yaml"
    path.write_text("/**: {ros__parameters: {k1: 0.5}}\n/**/two: {ros__parameters: {k1: 3, k2: 4}}\n")
    loaded = params_file.load(path, {"one": Gains, "two": Gains})
    assert loaded == {"one": Gains(k1=0.5), "two": Gains(k1=3.0, k2=4.0)}


def test_a_block_for_all_nodes_gives_each_what_it_has(tmp_path):
    path = tmp_path / "params.yaml"
    path.write_text("/**: {ros__parameters: {k1: 3, gains: {k2: 4}, robot: torpedo}}\n")
    notices = []
    loaded = params_file.load(path, CLASSES, notices=notices)
    assert loaded == {"pilot": Pilot(gains=Gains(k2=4.0)), "observer": Gains(k1=3.0)}
    assert notices == [f"{path}: /**: no node here has robot: ignored"]
    path.write_text("/**/observer: {ros__parameters: {k1: 3, robot: torpedo}}\n")
    with pytest.raises(ConfigurationError, match=r"observer: robot: found an unknown key"):
        params_file.load(path, CLASSES)


@pytest.mark.parametrize(("body", "said"), [("gains: 3", "gains: found 3"), ("gains.k1.x: 9", "gains.k1")])
def test_a_block_for_all_nodes_cannot_break_a_group(tmp_path, body, said):
    path = tmp_path / "params.yaml"
    path.write_text(f"/**: {{ros__parameters: {{{body}}}}}\n")
    with pytest.raises(ConfigurationError, match=said):
        params_file.load(path, {"pilot": Pilot})


def test_parameters_that_every_ros_node_has_are_left_to_ros(loaded):
    own = "use_sim_time: true, start_type_description_service: true, qos_overrides: {/clock: {depth: 1}}"
    text = f"/auv/pilot: {{ros__parameters: {{gains: {{k1: 3}}, {own}}}}}\n"
    assert loaded(text, namespace="/auv")["pilot"].gains == Gains(k1=3.0)
