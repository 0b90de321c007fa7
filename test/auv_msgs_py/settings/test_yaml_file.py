"""YAML as people expect it, and every unreadable file in one line with its place."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.errors import ConfigurationError


@settings
class Sample:
    gain: float = setting(1.0, "a gain")


@pytest.fixture
def parsed(tmp_path):
    def parse(text):
        path = tmp_path / "f.yaml"
        path.write_text(text, encoding="utf-8")
        return yaml_file.parse(path)

    return parse


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("off", "off"),
        ("on", "on"),
        ("yes", "yes"),
        ("true", True),
        ("False", False),
        ("1e-3", 1e-3),
        ("1E3", 1e3),
        ("-2.5e+1", -25.0),
        (".5", 0.5),
        ("5.", 5.0),
        ("-20", -20),
        ("+7", 7),
        ("0", 0),
        (".inf", math.inf),
        ("2024-01-01", "2024-01-01"),
        ("12:30", "12:30"),  # YAML 1.1 would make it 750
        ("1_000", "1_000"),
        ("010", "010"),  # 8 for YAML 1.1, 10 for YAML 1.2: neither is guessed
        ("'1'", "1"),
        ("~", None),
    ],
)
def test_scalars_mean_what_they_look_like(parsed, text, value):
    found = parsed(f"key: {text}\n")["key"]
    assert found == value
    assert type(found) is type(value)


def test_not_a_number_is_read_and_then_refused(parsed, tmp_path):
    assert math.isnan(parsed("gain: .nan")["gain"])
    with pytest.raises(ConfigurationError, match=r"gain: found nan, expected a finite number"):
        yaml_file.load(tmp_path / "f.yaml", Sample)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a: 1\nb: 2\na: 3\n", "line 3, column 1: found text that cannot be read (the key 'a' stands there"),
        ("a: {x: 1, x: 2}\n", "line 1, column 11: found text that cannot be read (the key 'x' stands there"),
        ("a: [1, 2\n", "line 2, column 1: found text that cannot be read"),
        ("? [1, 2]\n: 3\n", "line 1, column 3: found text that cannot be read (a list or mapping as key)"),
        ("a: !!python/object/apply:os.system ['true']\n", "line 1, column 4: found text that cannot be read"),
        ("a: \x01\n", "found text that cannot be read"),
    ],
)
def test_what_is_not_yaml_is_reported_with_line_and_column(parsed, tmp_path, text, said):
    with pytest.raises(ConfigurationError) as caught:
        parsed(text)
    message = str(caught.value)
    assert message.startswith(str(tmp_path / "f.yaml"))
    assert said in message
    assert "\n" not in message


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(ConfigurationError, match="no such file"):
        yaml_file.parse(tmp_path / "missing.yaml")
    with pytest.raises(ConfigurationError, match="found a directory, expected a YAML file"):
        yaml_file.parse(tmp_path)
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"a: \xff\xfe")
    with pytest.raises(ConfigurationError, match="cannot be read"):
        yaml_file.parse(binary)


@pytest.mark.parametrize("text", ["", "# nothing but this\n", "~\n"])
def test_an_empty_file_is_reported(parsed, tmp_path, text):
    assert parsed(text) is None
    with pytest.raises(ConfigurationError, match="found an empty file, expected a mapping"):
        yaml_file.load(tmp_path / "f.yaml", Sample)


def test_anchors_are_shared_and_merged(parsed):
    assert parsed("a: &a {x: 1}\nb: {<<: *a, y: 2}\n") == {"a": {"x": 1}, "b": {"x": 1, "y": 2}}


#: What a hostile file holds -> the reason for its refusal.
HOSTILE = {
    "a: " + "[" * 100_000: "more than 64 lists and mappings inside each other",
    "{a: " * 100_000: "more than 64 lists and mappings inside each other",
    "- " * 100_000: "more than 64 lists and mappings inside each other",
    "a: !!int x": "the tag 'tag:yaml.org,2002:int' on 'x'",
    "a: !!timestamp 2": "the tag 'tag:yaml.org,2002:timestamp' on '2'",
    "a: !!binary =": "the tag 'tag:yaml.org,2002:binary' on '='",
    "a: !!set {x}": "the tag 'tag:yaml.org,2002:set'",
    "a: " + "1" * 5000: "a number of 5000 characters",
    "a: 0." + "1" * 5000: "a number of 5002 characters",
    'name: "a\\0b"': "the control character U+0000 in a text",
    'name: "\\e[2J"': "the control character U+001B in a text",
    "a: &a [*a]": "the alias 'a' without its anchor before it",
    "a: *b": "the alias 'b' without its anchor before it",
    "a: {<<: 3}": "<< with something other than mappings",
    "a: 1\n---\nb: 2": "a second document",
    "[" + "a," * 300_000: "more than 200000 values, aliases expanded",
    "a0: &a0 [x, x]\n" + "".join(f"a{k}: &a{k} [*a{k - 1}, *a{k - 1}]\n" for k in range(1, 60)): "more than",
    "a0: &a0 {x: 1}\n"
    + "".join(f"a{k}: &a{k} {{<<: [*a{k - 1}, *a{k - 1}]}}\n" for k in range(1, 60)): "more than",
    f"a: &a {'x' * 100_000}\nb: [" + "*a, " * 1000 + "]": "more than 200000 values, aliases expanded",
}


@pytest.mark.parametrize("text", HOSTILE, ids=lambda text: text[:20])
def test_what_would_exhaust_the_machine_is_refused_with_its_place(parsed, text):
    with pytest.raises(ConfigurationError) as caught:
        parsed(text)
    message = str(caught.value)
    assert f"found text that cannot be read ({HOSTILE[text]}" in message
    assert "f.yaml: line " in message
    assert message.isprintable()


def test_a_file_that_is_too_large_is_not_parsed(tmp_path):
    path = tmp_path / "f.yaml"
    path.write_bytes(b"#" * (yaml_file.MOST_BYTES + 1))
    with pytest.raises(
        ConfigurationError, match="found 4,000,001 bytes, expected a file of at most 4,000,000 bytes"
    ):
        yaml_file.parse(path)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("!!str 1", "1"),
        ("!!float 1", 1.0),
        ("!!int 1", 1),
        ("!!bool true", True),
        ("!!null ~", None),
    ],
)
def test_tags_of_the_core_schema_are_read(parsed, text, value):
    found = parsed(f"a: {text}")["a"]
    assert found == value
    assert type(found) is type(value)


def test_a_merged_key_yields_to_an_own_one_and_to_an_earlier_one(parsed):
    text = "a: &a {x: 1, y: 1}\nb: &b {x: 2, z: 2}\nc: {z: 3, <<: [*a, *b]}\n"
    assert parsed(text)["c"] == {"x": 1, "y": 1, "z": 3}


_text = st.text(st.characters(codec="utf-8", exclude_categories=("C", "Zl", "Zp")), max_size=12)
_scalar = st.floats(allow_nan=False) | st.integers(-(10**6), 10**6) | st.booleans() | _text
_looks_like_a_number = st.sampled_from(
    ["1e3", "-2E-5", "off", "true", "010", "12:30", "1.", "null", "0x1F", ""]
)


@given(st.dictionaries(_text, _scalar | _looks_like_a_number | st.lists(_scalar, max_size=3), max_size=4))
def test_what_is_dumped_is_read_back(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("dump", numbered=True) / "f.yaml"
    yaml_file.dump(data, path)
    assert yaml_file.parse(path) == data


@pytest.mark.parametrize("text", ["a:\n\tb: 1\n", "a:\n  b: 1\n\tc: 2\n", "\ta: 1\n", "\ufeffa:\n\tb: 1\n"])
def test_indentation_by_a_tab_is_reported_as_a_tab(text: str) -> None:
    with pytest.raises(ConfigurationError, match=r"line \d, column \d: found a tab, expected spaces"):
        yaml_file.parse_text(text, "mine.yaml")


def test_a_tab_elsewhere_is_no_indentation() -> None:
    with pytest.raises(ConfigurationError, match="found text that cannot be read"):
        yaml_file.parse_text("a: &\tb\n", "mine.yaml")
