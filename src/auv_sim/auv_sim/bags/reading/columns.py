"""Decode all messages of a topic at once into columns of numbers.

Messages whose only parts of variable length are frame ids have one size as long as the frame ids stay the
same, so that NumPy can read a topic as one array of bytes. Where they change, or in another byte order,
rosbags decodes one message after the other. Both take the order of fields from the table in
`auv_msgs_py.contract.codec`.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract.codec import HEADER, LAYOUTS, LITTLE_ENDIAN, STAMP, Layout, aligned, read_texts
from auv_sim.bags.definitions import typestore

#: Layouts whose numbers are no float64, which only rosbags decodes.
_OTHERS = {"sensor_msgs/msg/Range": Layout("header.stamp", ("header.frame_id",), {"range": 1})}
_BODY = len(HEADER)
_STAMP = np.dtype([("sec", "<i4"), ("nanosec", "<u4")])
assert _STAMP.itemsize == STAMP.size


class Columns(NamedTuple):
    """n messages of one topic.

    Attributes:
        layout: of the type.
        stamp_ns: shape (n,), int64; zeros for a type without a stamp.
        frames: the frame ids (frame_id, child_frame_id) of every message, one entry for each distinct set.
        values: shape (n, k): the message's k numbers in the order of its layout.
    """

    layout: Layout
    stamp_ns: NDArray[np.int64]
    frames: tuple[tuple[str, ...], ...]
    values: NDArray[np.float64]

    def column(self, field: str) -> NDArray[np.float64]:
        """Return one number of every message, by the dotted path of its field, shape (n,)."""
        values: NDArray[np.float64] = self.values[:, self.layout.column(field)]
        return values


def decode(type_name: str, messages: Sequence[bytes]) -> Columns:
    """Decode all messages of a topic.

    Args:
        type_name: one of `LAYOUTS`, or sensor_msgs/msg/Range.
        messages: n serialised messages, CDR header included.

    Raises:
        Exception: bytes that are no such message; of which type depends on what is wrong with them.
    """
    columns = None if type_name in _OTHERS else decode_at_once(type_name, messages)
    return decode_one_by_one(type_name, messages) if columns is None else columns


def decode_at_once(type_name: str, messages: Sequence[bytes]) -> Columns | None:
    """Decode as `decode` does; return None where the messages do not all have one layout."""
    layout = LAYOUTS[type_name]
    if not messages:
        return Columns(layout, np.zeros(0, np.int64), (), np.zeros((0, layout.doubles)))
    first = messages[0]
    if first[:2] != LITTLE_ENDIAN:
        return None
    texts, end = read_texts(first, layout)
    numbers_at = aligned(end) if layout.doubles else end
    size = numbers_at + 8 * layout.doubles
    joined = b"".join(messages)
    if len(first) != size or len(joined) != size * len(messages) or any(len(m) != size for m in messages):
        return None
    rows = np.frombuffer(joined, np.uint8).reshape(-1, size)
    fixed = rows[:, layout.texts_at : end]
    if not ((rows[:, :2] == rows[0, :2]).all() and (fixed == fixed[0]).all()):
        return None
    # A separate copy of the numbers is aligned, which the file's bytes are not.
    values = np.ascontiguousarray(rows[:, numbers_at:]).view("<f8").astype(np.float64, copy=False)
    stamp = np.zeros(len(messages), np.int64)
    if layout.stamp:
        stamps = np.ascontiguousarray(rows[:, _BODY : _BODY + STAMP.size]).view(_STAMP)[:, 0]
        stamp = stamps["sec"].astype(np.int64) * 1_000_000_000 + stamps["nanosec"]
    frames = tuple(text.decode() for text in texts)
    return Columns(layout, stamp, (frames,) if frames else (), values)


def decode_one_by_one(type_name: str, messages: Sequence[bytes]) -> Columns:
    """Decode as `decode` does, by rosbags' deserialiser: slow, for any frame ids and byte order."""
    layout = LAYOUTS.get(type_name) or _OTHERS[type_name]
    store = typestore()
    stamp = np.zeros(len(messages), np.int64)
    values = np.zeros((len(messages), layout.doubles))
    frames: dict[tuple[str, ...], None] = {}
    for row, message in enumerate(messages):
        decoded: Any = store.deserialize_cdr(message, type_name)
        if layout.stamp:
            time = attrgetter(layout.stamp)(decoded)
            stamp[row] = time.sec * 1_000_000_000 + time.nanosec
        if layout.texts:
            frames[tuple(attrgetter(field)(decoded) for field in layout.texts)] = None
        if layout.numbers:
            values[row] = np.hstack([attrgetter(field)(decoded) for field in layout.numbers])
    return Columns(layout, stamp, tuple(frames), values)
