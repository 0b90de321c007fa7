"""Numbers and vectors in messages of any type, by name: a dotted path, an index, or a joint."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.reading.recording import Bag, RecordedTopic

#: Columns of a joint; the first is the default.
_OF_JOINT = ("position", "velocity", "effort")
#: Most names listed in a line.
_LISTED = 12


def number_in(message: Any, part: str) -> float:
    """Return a number of a message; NaN if it has none of that name.

    Args:
        message: decoded.
        part: dotted path (`twist.linear.x`), index of an array (`data.2`, or 2 of a message whose array is
            `data`), or a joint's name, alone for its position or with `.velocity` or `.effort`. If empty,
            the only number `data`, or the position of the only joint.
    """
    if _has_joints(message):
        return _of_joint(message, part)
    if not part:
        data = getattr(message, "data", None)
        data = data[0] if isinstance(data, (Sequence, np.ndarray)) and len(data) == 1 else data
        return _number(data)
    found = _follow(message, part)
    return _number(_follow(message, f"data.{part}") if found is None else found)


def numbers_in(message: Any) -> list[str]:
    """Return the names by which `number_in` finds the numbers of a message."""
    if _has_joints(message):
        return list(message.name)
    return [path for path, value in _leaves(message) if not math.isnan(_number(value))]


def vector_in(message: Any, part: str) -> tuple[float, float, float] | None:
    """Return a vector x, y, z of a message by its dotted path (empty: the message); None if it has none."""
    found = _follow(message, part) if part else message
    return (float(found.x), float(found.y), float(found.z)) if _is_vector(found) else None


def vectors_in(message: Any) -> list[str]:
    """Return the dotted paths of the vectors in a message."""
    above = dict.fromkeys(path.rpartition(".")[0] for path, _ in _leaves(message))
    return [path for path in above if path and _is_vector(_follow(message, path))]


def check_part(bag: Bag, row: Topic, topic: RecordedTopic, is_vector: bool = False) -> None:
    """Check that a topic's messages have the part that counts.

    Args:
        bag: for the error.
        row: name in the wire contract.
        topic: as recorded, with its `part`.
        is_vector: whether the part is a vector rather than a number.

    Raises:
        ConfigurationError: no message has it; names the parts that there are. Or an unknown type.
    """
    decode, names, there = deserializer(topic), dict[str, None](), False
    for data in topic.messages:
        try:
            message = None if data is None else decode(data)
        except Exception:  # damaged bytes raise any exception; the reader reports them
            return
        if message is None:
            continue
        if len(names) <= _LISTED:
            names |= dict.fromkeys(vectors_in(message) if is_vector else numbers_in(message))
        there |= vector_in(message, topic.part) is not None if is_vector else _has_number(message, topic.part)
        if there and (topic.part or not _has_joints(message)):
            return
    if there and len(names) == 1:
        return
    found = f"{topic.type} without '{topic.part}'" if topic.part else topic.type
    if not topic.count or not names:
        expected = f"a type with {'a vector' if is_vector else 'a number'} as {row.name}"
    else:
        listed = ", ".join([*list(names)[:_LISTED], *(["..."] if len(names) > _LISTED else [])])
        one = f"one {'vector' if is_vector else 'number'} as {row.name}"
        expected = f"{one}: --topic {row.name}={topic.source or topic.name}:PART with PART one of {listed}"
    raise ConfigurationError(f"{bag.path}: {topic.source or topic.name}", found, expected)


def _has_number(message: Any, part: str) -> bool:
    """Return whether a message has a number, which may be NaN."""
    if _has_joints(message):
        return _joint(message, part) is not None
    found = getattr(message, "data", None) if not part else _follow(message, part)
    return not math.isnan(number_in(message, part)) or isinstance(found, float)


def _has_joints(message: Any) -> bool:
    return all(isinstance(getattr(message, key, None), (list, np.ndarray)) for key in ("name", "position"))


def _of_joint(message: Any, part: str) -> float:
    found = _joint(message, part)
    return math.nan if found is None else found


def _joint(message: Any, part: str) -> float | None:
    """Return the value of a joint; None if there is no such joint, or no value of it."""
    names = list(message.name)
    joint, column = part, _OF_JOINT[0]
    if part not in names and part.rpartition(".")[2] in _OF_JOINT:
        joint, _, column = part.rpartition(".")
    if not joint and len(names) == 1:
        joint = names[0]
    values = getattr(message, column, ())
    at = names.index(joint) if joint in names else len(values)
    return float(values[at]) if at < len(values) else None


def _follow(message: Any, path: str) -> Any:
    """Return what a dotted path leads to; None where it leads nowhere."""
    for word in path.split("."):
        if not word.isdecimal():
            message = getattr(message, word, None)
        elif isinstance(message, (Sequence, np.ndarray)) and int(word) < len(message):
            message = message[int(word)]
        else:
            return None
    return message


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float, np.number)) and not isinstance(value, (bool, np.bool_))


def _number(value: Any) -> float:
    return float(value) if _is_number(value) else math.nan


def _is_vector(value: Any) -> bool:
    return all(_is_number(getattr(value, axis, None)) for axis in "xyz") and not hasattr(value, "w")


def _leaves(message: Any, above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the dotted paths and values of a message, without headers, covariances and layouts.

    Of an array only so many elements as are listed, and one more: an image has a million.
    """
    if dataclasses.is_dataclass(message):
        for field in dataclasses.fields(message):
            if field.name not in ("header", "covariance", "layout"):
                yield from _leaves(getattr(message, field.name), f"{above}{field.name}.")
    elif isinstance(message, (list, np.ndarray)):
        for k, value in enumerate(message[: _LISTED + 1]):
            yield from _leaves(value, f"{above}{k}.")
    else:
        yield above[:-1], message
