"""Whose line a message is, of the topics that all nodes of a graph share. ROS-free.

A recorder of one vehicle receives the lines of every vehicle in the graph. The name of the node is read from
the bytes, because decoding a whole message costs more than recording it.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence

#: Topics of all nodes in a graph.
SHARED = ("/diagnostics", "/rosout", "/parameter_events")
_HEADER = 4
_STAMP = 8


def node_of(topic: str, data: bytes) -> str:
    """Return the full name of the node that a message comes from; empty where there is none.

    Args:
        topic: one of `SHARED`.
        data: CDR. A DiagnosticArray is of the node that its first status names.
    """
    order = "<" if data[1:2] == b"\x01" else ">"
    try:
        if topic == "/parameter_events":
            return _text(data, _HEADER + _STAMP, order)
        if topic == "/rosout":
            return "/" + _text(data, _HEADER + _STAMP + 1, order).replace(".", "/")
        (length,) = struct.unpack_from(f"{order}I", data, _HEADER + _STAMP)  # of frame_id
        at = _aligned(_HEADER + _STAMP + 4 + length)
        (statuses,) = struct.unpack_from(f"{order}I", data, at)
        return _text(data, at + 5, order) if statuses else ""
    except (struct.error, UnicodeDecodeError):
        return ""


def is_within(node: str, namespace: str) -> bool:
    """Return whether a node is in a namespace, or below it."""
    return node.startswith(f"/{namespace.strip('/')}/".replace("//", "/"))


def without(topic: str, namespaces: Sequence[str]) -> Callable[[bytes], bool] | None:
    """Return which messages of a topic to keep where those of some namespaces are left out; None: all."""
    if topic not in SHARED or not namespaces:
        return None
    return lambda data: not any(is_within(node_of(topic, data), each) for each in namespaces)


def only(topic: str, namespace: str) -> Callable[[bytes], bool] | None:
    """Return which messages of a topic to keep where only those of one namespace are kept; None: all."""
    if topic not in SHARED:
        return None
    return lambda data: is_within(node_of(topic, data), namespace)


def _text(data: bytes, at: int, order: str) -> str:
    """Return the string that begins at the next multiple of four bytes."""
    at = _aligned(at)
    (length,) = struct.unpack_from(f"{order}I", data, at)
    return data[at + 4 : at + 3 + length].decode()


def _aligned(at: int) -> int:
    return _HEADER + -(-(at - _HEADER) // 4) * 4
