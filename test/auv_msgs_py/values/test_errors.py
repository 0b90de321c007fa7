"""Text of a foreign message in what people read: short, and one line."""

from __future__ import annotations

import pickle

import pytest

from auv_msgs_py.values.errors import ConfigurationError, MessageRefused, SuiteError, printable


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a b é 深", "a b é 深"),
        ("\x1b]0;x\x07", "\\x1b]0;x\\x07"),
        ("a\nb\r\t", "a\\nb\\r\\t"),
        ("a\u202eb", "a\\u202eb"),  # text that runs backwards
        ("\udcff", "\\udcff"),  # a file name that is not UTF-8
        ("\0", "\\x00"),
    ],
)
def test_printable(text, shown):
    assert printable(text) == shown


def test_a_text_of_a_megabyte_does_not_travel_whole() -> None:
    error = MessageRefused("odom", f"frame_id '{'x' * 1_000_000}'", "map")
    assert len(str(error)) < 500


def test_a_text_cannot_begin_a_line_of_its_own() -> None:
    error = MessageRefused("mission_state", "'a\n[ERROR] b\x1b[31m'", "idle")
    assert str(error) == "mission_state: found 'a\\n[ERROR] b\\x1b[31m', expected idle"


@pytest.mark.parametrize("kind", [ConfigurationError, MessageRefused])
def test_no_error_carries_a_terminal_escape_or_a_page(kind):
    error = kind("m.yaml\x1b[2J", "'\x1b[31m" + "x" * 5000, "text\nor numbers")
    assert str(error).startswith("m.yaml\\x1b[2J: found '\\x1b[31mxx")
    assert str(error).isprintable()
    assert len(str(error)) < 1000


def test_an_error_that_quotes_a_log_keeps_its_lines():
    assert str(SuiteError("a node ended:\n  | \x1b[31mlast line")) == "a node ended:\n  | \\x1b[31mlast line"


@pytest.mark.parametrize(
    "error", [ConfigurationError("a.yaml: b", "c", "d"), MessageRefused("odom", "e", "f"), SuiteError("g")]
)
def test_an_error_comes_back_from_a_worker_process(error: SuiteError) -> None:
    back = pickle.loads(pickle.dumps(error))  # noqa: S301
    assert type(back) is type(error)
    assert (str(back), vars(back)) == (str(error), vars(error))
