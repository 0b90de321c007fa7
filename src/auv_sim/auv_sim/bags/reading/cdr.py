"""Serialised messages to columns of numbers, all messages of a topic at once.

A message whose only variable parts are its frame ids has the same layout throughout a recording, so a
topic is one NumPy structured array laid over the joined bytes. Where that does not hold (frame ids that
change length, another byte order) every message is decoded on its own by rosbags.
"""

from __future__ import annotations

import dataclasses
import struct
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_sim.bags.definitions import typestore

_LITTLE_ENDIAN_CDR = b"\x00\x01"
_HEADER = 4


class _Layout(NamedTuple):
    """Stamp first if there is one, then the strings, then nothing but float64."""

    stamped: bool
    strings: int
    doubles: int


LAYOUTS = {
    "std_msgs/msg/Float64": _Layout(False, 0, 1),
    "geometry_msgs/msg/Vector3Stamped": _Layout(True, 1, 3),
    "geometry_msgs/msg/TwistWithCovarianceStamped": _Layout(True, 1, 6 + 36),
    "nav_msgs/msg/Odometry": _Layout(True, 2, 7 + 36 + 6 + 36),
}


class Columns(NamedTuple):
    """n messages of one topic.

    Attributes:
        stamp_ns: shape (n,), int64; zeros for a type without a header.
        frames: the frame ids (frame_id, child_frame_id) of every message, one entry for each distinct set.
        values: shape (n, k): the message's k numbers in the order of its definition.
    """

    stamp_ns: NDArray[np.int64]
    frames: tuple[tuple[str, ...], ...]
    values: NDArray[np.float64]


def decode(type_name: str, messages: Sequence[bytes]) -> Columns:
    """Decode all messages of a topic.

    Args:
        type_name: one of `LAYOUTS`.
        messages: n serialised messages, CDR header included.
    """
    columns = decode_at_once(type_name, messages)
    return decode_one_by_one(type_name, messages) if columns is None else columns


def decode_at_once(type_name: str, messages: Sequence[bytes]) -> Columns | None:
    """Like `decode`, or None when the messages do not all have one layout."""
    layout = LAYOUTS[type_name]
    if not messages:
        return Columns(np.zeros(0, np.int64), (), np.zeros((0, layout.doubles)))
    first = messages[0]
    if first[:2] != _LITTLE_ENDIAN_CDR:
        return None
    strings_start = _HEADER + (8 if layout.stamped else 0)
    end, frames = _strings(first, strings_start, layout.strings)
    # CDR aligns a float64 to 8 bytes counted from behind its header.
    doubles_start = _HEADER + (end - _HEADER + 7) // 8 * 8
    size = doubles_start + 8 * layout.doubles
    joined = b"".join(messages)
    if len(first) != size or len(joined) != size * len(messages) or any(len(m) != size for m in messages):
        return None
    rows = np.frombuffer(joined, np.uint8).reshape(-1, size)
    same = (rows[:, :2] == rows[0, :2]).all() and (
        rows[:, strings_start:end] == rows[0, strings_start:end]
    ).all()
    if not same:
        return None
    # A separate copy of the numbers is aligned, which the file's bytes are not.
    values = np.ascontiguousarray(rows[:, doubles_start:]).view("<f8").astype(np.float64, copy=False)
    stamp = np.zeros(len(messages), np.int64)
    if layout.stamped:
        seconds = np.ascontiguousarray(rows[:, _HEADER : _HEADER + 4]).view("<i4")[:, 0]
        nanoseconds = np.ascontiguousarray(rows[:, _HEADER + 4 : _HEADER + 8]).view("<u4")[:, 0]
        stamp = seconds.astype(np.int64) * 1_000_000_000 + nanoseconds
    return Columns(stamp, (frames,) if frames else (), values)


def _strings(message: bytes, position: int, number: int) -> tuple[int, tuple[str, ...]]:
    """Where the strings end, and the strings themselves (each: length with its final NUL, bytes)."""
    texts: list[str] = []
    for _ in range(number):
        position = _HEADER + (position - _HEADER + 3) // 4 * 4
        (length,) = struct.unpack_from("<I", message, position)
        position += 4
        texts.append(message[position : position + length].rstrip(b"\0").decode())
        position += length
    return position, tuple(texts)


def decode_one_by_one(type_name: str, messages: Sequence[bytes]) -> Columns:
    """Like `decode`, by rosbags' own deserialiser: slow, for any layout and byte order."""
    layout = LAYOUTS[type_name]
    store = typestore()
    stamp = np.zeros(len(messages), np.int64)
    values = np.zeros((len(messages), layout.doubles))
    frames: dict[tuple[str, ...], None] = {}
    for row, message in enumerate(messages):
        decoded: Any = store.deserialize_cdr(message, type_name)
        if layout.stamped:
            stamp[row] = decoded.header.stamp.sec * 1_000_000_000 + decoded.header.stamp.nanosec
            child = (decoded.child_frame_id,) if layout.strings == 2 else ()
            frames[(decoded.header.frame_id, *child)] = None
        values[row] = _numbers(decoded)
    return Columns(stamp, tuple(frames), values)


def _numbers(message: Any) -> list[float]:
    """Every float64 of a message in the order of its definition."""
    found: list[float] = []
    for field in dataclasses.fields(message):
        value = getattr(message, field.name)
        if field.name == "header" or isinstance(value, str):
            continue
        if dataclasses.is_dataclass(value):
            found += _numbers(value)
        elif isinstance(value, np.ndarray):
            found += value.tolist()
        elif not field.name.startswith("__"):
            found.append(value)
    return found
