"""Settings: strict, frozen, self-describing; and errors that a person can act on."""

from __future__ import annotations

import dataclasses
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.settings.explanations import key_path
from auv_msgs_py.settings.schema import (
    Pair,
    flattened,
    leaves,
    nested,
    setting,
    settings,
    validated,
)
from auv_msgs_py.values.errors import ConfigurationError, SuiteError


@settings
class Inner:
    gain: float = setting(0.8, "a gain", unit="1/s", gt=0.0, le=10.0, live=True)
    count: int = setting(3, "a number of things", ge=1, lt=9)


@settings
class Outer:
    mode: Literal["off", "on"] = setting("off", "which way")
    flag: bool = setting(False, "yes or no")
    names: list[str] = setting(factory=lambda: ["a"], doc="some names")
    inner: Inner = setting(factory=Inner, doc="inside")


@settings
class Strict:
    name: str = setting(doc="required")
    place: Pair = setting(doc="required pair", unit="m")


def test_defaults_stand_in_the_class_and_files_override_single_keys():
    outer = validated(Outer, {"inner": {"gain": 2}}, "f.yaml")
    assert outer == Outer(inner=Inner(gain=2.0))
    assert isinstance(outer.inner.gain, float)
    assert (outer.inner.count, outer.mode, outer.names) == (3, "off", ["a"])


def test_settings_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        Inner().gain = 1.0


def test_a_wrong_value_in_code_is_refused_too():
    with pytest.raises(ValueError, match="greater than 0"):
        Inner(gain=-1.0)


@pytest.mark.parametrize(
    ("cls", "data", "said"),
    [
        (Outer, {"inner": {"gain": "fast"}}, "f.yaml: inner.gain: found 'fast', expected a number"),
        (Outer, {"inner": {"gain": 0}}, "f.yaml: inner.gain: found 0, expected a number greater than 0"),
        (Outer, {"inner": {"gain": 11}}, "f.yaml: inner.gain: found 11, expected a number of at most 10"),
        (Outer, {"inner": {"count": 0}}, "f.yaml: inner.count: found 0, expected a number of at least 1"),
        (Outer, {"inner": {"count": 9}}, "f.yaml: inner.count: found 9, expected a number less than 9"),
        (Outer, {"inner": {"count": 2.5}}, "f.yaml: inner.count: found 2.5, expected a whole number"),
        (Outer, {"inner": {"gain": True}}, "f.yaml: inner.gain: found True, expected a number"),
        (Outer, {"inner": {"gain": None}}, "f.yaml: inner.gain: found an empty value, expected a number"),
        (Outer, {"inner": {"gain": float("nan")}}, "f.yaml: inner.gain: found nan, expected a finite number"),
        (Outer, {"inner": {"gain": float("inf")}}, "f.yaml: inner.gain: found inf, expected a finite number"),
        (Outer, {"flag": "yes"}, "f.yaml: flag: found 'yes', expected true or false"),
        (Outer, {"mode": "of"}, "f.yaml: mode: found 'of', expected one of 'off' or 'on'"),
        (Outer, {"names": "a"}, "f.yaml: names: found 'a', expected a list"),
        (Outer, {"names": ["a", 3]}, "f.yaml: names[1]: found 3, expected a text"),
        (Outer, {"inner": [1]}, "f.yaml: inner: found [1], expected a mapping of keys to values"),
        (Outer, {"inner": {"gian": 1}}, "f.yaml: inner.gian: found an unknown key"),
        (Outer, [], "f.yaml: found [], expected a mapping of keys to values"),
        (Strict, {"place": [1, 2]}, "f.yaml: name: found nothing, expected this key (it has no default)"),
        (Strict, {"name": "x", "place": [1]}, "f.yaml: place[1]: found nothing, expected one more item"),
        (Strict, {"name": "x", "place": [1, 2, 3]}, "f.yaml: place: found"),
    ],
    ids=lambda value: value if isinstance(value, str) else None,
)
def test_a_wrong_value_gets_one_line_with_key_and_reason(cls, data, said):
    with pytest.raises(ConfigurationError) as caught:
        validated(cls, data, "f.yaml")
    assert str(caught.value).startswith(said)
    assert "\n" not in str(caught.value)
    assert "pydantic" not in str(caught.value)
    assert isinstance(caught.value, SuiteError)


def test_a_misspelt_key_is_shown_as_it_stands_in_the_file_not_as_missing():
    with pytest.raises(
        ConfigurationError, match=r"^f.yaml: nmae: found an unknown key.*; name: found nothing"
    ):
        validated(Strict, {"nmae": "x", "place": [1, 2]}, "f.yaml")


def test_all_wrong_keys_are_named_in_one_line():
    with pytest.raises(ConfigurationError) as caught:
        validated(Outer, {"inner": {"gain": -1, "gian": 2}, "flag": "yes", "mode": "of"}, "f.yaml")
    assert str(caught.value) == (
        "f.yaml: mode: found 'of', expected one of 'off' or 'on'; flag: found 'yes', expected true or false;"
        " inner.gain: found -1, expected a number greater than 0;"
        " inner.gian: found an unknown key, expected only the documented keys (did you mean gain?)"
    )


def test_a_key_unlike_any_other_is_asked_for():
    with pytest.raises(
        ConfigurationError, match=r"inner\.colour: found an unknown key.*\(is it misspelt\?\)"
    ):
        validated(Outer, {"inner": {"colour": 2}}, "f.yaml")


def test_hundreds_of_wrong_keys_are_counted():
    with pytest.raises(ConfigurationError, match=r"names\[30\]: found 30.*; and 69 more$") as caught:
        validated(Outer, {"names": list(range(100))}, "f.yaml")
    assert "names[31]" not in str(caught.value)


def test_data_that_no_file_can_hold_is_refused_in_a_line():
    loop: list[object] = []
    loop.append(loop)
    with pytest.raises(ConfigurationError, match="an unsupported type"):
        validated(Outer, {"names": loop}, "f.yaml")


def test_long_values_are_cut_in_the_message():
    with pytest.raises(ConfigurationError) as caught:
        validated(Outer, {"flag": "x" * 1000}, "f.yaml")
    assert len(str(caught.value)) < 150


def test_key_path_reads_like_the_file():
    assert key_path(("segments", 2, "line", "length")) == "segments[2].line.length"
    assert key_path((0, "a")) == "[0].a"
    assert key_path(("a", "tagged-union[x]", "b")) == "a.b"


def test_leaves_know_everything_about_every_setting():
    by_name = {leaf.name: leaf for leaf in leaves(Outer)}
    assert list(by_name) == ["mode", "flag", "names", "inner.gain", "inner.count"]
    gain = by_name["inner.gain"]
    assert (gain.default, gain.doc, gain.unit, gain.live) == (0.8, "a gain", "1/s", True)
    assert (gain.minimum, gain.maximum) == (0.0, 10.0)
    count = by_name["inner.count"]
    assert (count.minimum, count.maximum, count.live, count.unit) == (1, 9, False, "")
    assert by_name["mode"].minimum is None


def test_a_parameter_without_default_is_the_authors_mistake():
    with pytest.raises(TypeError, match=r"Strict\.name has no default"):
        leaves(Strict)


@given(st.builds(Inner, gain=st.floats(0.01, 10.0), count=st.integers(1, 8)), st.booleans())
def test_flattening_and_nesting_are_inverse(inner, flag):
    outer = Outer(inner=inner, flag=flag)
    flat = flattened(outer)
    assert flat["inner.gain"] == inner.gain
    assert set(flat) == {leaf.name for leaf in leaves(Outer)}
    assert validated(Outer, nested(flat), "f.yaml") == outer


@pytest.mark.parametrize("names", [("inner.gain", "inner.gain.x"), ("inner.gain.x", "inner.gain")])
def test_a_name_below_a_value_is_refused(names):
    with pytest.raises(ConfigurationError) as error:
        validated(Outer, nested(dict.fromkeys(names, 1.0)), "f.yaml")
    assert str(error.value).startswith("f.yaml: inner.gain.x: found an unknown key, expected only the")
