"""Errors are one line that a terminal may show, whatever stood in the file."""

from __future__ import annotations

import pytest

from auv_msgs_py.errors import ConfigurationError, MessageRefused, SuiteError, printable


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


@pytest.mark.parametrize("kind", [ConfigurationError, MessageRefused])
def test_no_error_carries_a_terminal_escape_or_a_page(kind):
    error = kind("m.yaml\x1b[2J", "'\x1b[31m" + "x" * 5000, "text\nor numbers")
    assert str(error).startswith("m.yaml\\x1b[2J: found '\\x1b[31mxx")
    assert str(error).isprintable()
    assert len(str(error)) < 1000
    assert str(SuiteError("a\x1b")) == "a\\x1b"
