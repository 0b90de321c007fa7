"""Text of a foreign message in what people read: short, and one line."""

from __future__ import annotations

from auv_msgs_py.errors import MessageRefused


def test_a_text_of_a_megabyte_does_not_travel_whole() -> None:
    error = MessageRefused("odom", f"frame_id '{'x' * 1_000_000}'", "map")
    assert len(str(error)) < 500


def test_a_text_cannot_begin_a_line_of_its_own() -> None:
    error = MessageRefused("mission_state", "'a\n[ERROR] b\x1b[31m'", "idle")
    assert str(error) == "mission_state: found 'a\\n[ERROR] b\\x1b[31m', expected idle"
