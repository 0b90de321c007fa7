"""The byte layouts of the contract's messages, for single messages and for whole recordings. ROS-free.

CDR as ROS 2 writes it: four bytes of header (the second is 1 for little endian), then each field in turn. A
number is aligned to its size, counted from the end of the header. A text is its length with the final NUL
(uint32), then its bytes.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from itertools import groupby
from typing import Any, NamedTuple

LITTLE_ENDIAN = b"\x00\x01"
#: The header of every message that is written here.
HEADER = LITTLE_ENDIAN + b"\x00\x00"
STAMP = struct.Struct("<iI")
LENGTH = struct.Struct("<I")


class Layout(NamedTuple):
    """The fields of a type in the order of their bytes, as dotted paths: a stamp, then texts, then float64.

    Attributes:
        stamp: the builtin_interfaces/msg/Time; empty for a type without one.
        texts: the strings.
        numbers: the number of float64 in each further field: 1, or the length of an array.
    """

    stamp: str
    texts: tuple[str, ...]
    numbers: Mapping[str, int]

    @property
    def doubles(self) -> int:
        """Number of float64."""
        return sum(self.numbers.values())

    @property
    def texts_at(self) -> int:
        """Where the texts begin, bytes from the beginning of the message."""
        return len(HEADER) + (STAMP.size if self.stamp else 0)

    def column(self, field: str) -> int:
        """Return the position of a field's first float64 among all of them.

        Raises:
            ValueError: the type has no such number.
        """
        fields = list(self.numbers)
        return sum(self.numbers[name] for name in fields[: fields.index(field)])


def _each(path: str, names: str) -> dict[str, int]:
    return {f"{path}.{name}": 1 for name in names}


def _pose(path: str) -> dict[str, int]:
    return _each(f"{path}.position", "xyz") | _each(f"{path}.orientation", "xyzw")


def _twist(path: str) -> dict[str, int]:
    return _each(f"{path}.linear", "xyz") | _each(f"{path}.angular", "xyz")


def _with_covariance(path: str, fields: dict[str, int]) -> dict[str, int]:
    return fields | {f"{path}.covariance": 36}


_STAMPED = "header.stamp", ("header.frame_id",)

#: ROS type -> its layout. The contract's other types have arrays of variable length, or no such fields.
LAYOUTS: dict[str, Layout] = {
    "std_msgs/msg/Float64": Layout("", (), {"data": 1}),
    "rosgraph_msgs/msg/Clock": Layout("clock", (), {}),
    "geometry_msgs/msg/Vector3Stamped": Layout(*_STAMPED, _each("vector", "xyz")),
    "geometry_msgs/msg/PoseStamped": Layout(*_STAMPED, _pose("pose")),
    "geometry_msgs/msg/TwistWithCovarianceStamped": Layout(
        *_STAMPED, _with_covariance("twist", _twist("twist.twist"))
    ),
    "nav_msgs/msg/Odometry": Layout(
        "header.stamp",
        ("header.frame_id", "child_frame_id"),
        _with_covariance("pose", _pose("pose.pose")) | _with_covariance("twist", _twist("twist.twist")),
    ),
}


def aligned(position: int) -> int:
    """Return the next place for a float64, bytes from the beginning of the message."""
    return position + -(position - len(HEADER)) % 8


def read_texts(data: bytes, layout: Layout) -> tuple[list[bytes], int]:
    """Return the texts of a little-endian message, undecoded, and where the last one ends.

    Raises:
        struct.error: the message ends before their lengths are complete.
    """
    texts, at = [], layout.texts_at
    for _ in layout.texts:
        at += -at % 4
        (length,) = LENGTH.unpack_from(data, at)
        at += LENGTH.size
        texts.append(data[at : at + length].rstrip(b"\0"))
        at += length
    return texts, at


def written_texts(texts: tuple[str, ...]) -> bytes:
    """Return the bytes of texts that follow a stamp, up to the next place for a float64."""
    start = len(HEADER) + STAMP.size
    written = bytearray(start)
    for text in texts:
        encoded = text.encode() + b"\0"
        written += bytes(-len(written) % 4) + LENGTH.pack(len(encoded)) + encoded
    written += bytes(aligned(len(written)) - len(written))
    return bytes(written[start:])


#: Sets the fields of a message from a tuple.
Setter = Callable[[Any, tuple[Any, ...]], None]
#: Returns the fields of a message as a tuple.
Getter = Callable[[Any], tuple[Any, ...]]


def accessors(fields: Mapping[str, int]) -> tuple[Setter, Getter]:
    """Compile two functions that set and return fields of a message, given by dotted path and length.

    They are compiled, as the methods of a dataclass are, because a loop over the paths takes three times as
    long, and nodes call them for every message. A field of more than one value is a tuple inside the message.
    """
    paths = {path: path.rpartition(".") for path in fields}
    parents = list(dict.fromkeys(parent for parent, _, _ in paths.values()))
    local = {parent: f"part{k}" for k, parent in enumerate(parents)}
    fetched = [f"{local[parent]} = " + f"message.{parent}".rstrip(".") for parent in parents]
    targets = {path: f"{local[parent]}.{name}" for path, (parent, _, name) in paths.items()}
    returned = "".join(f"{'*' * (length > 1)}{targets[path]}, " for path, length in fields.items())
    functions = {
        "put(message, values)": [*fetched, *_assignments(targets, fields), "return"],
        "get(message)": [*fetched, f"return ({returned})"],
    }
    made: dict[str, Any] = {}
    for head, lines in functions.items():
        exec("\n    ".join([f"def {head}:", *lines]), made)  # noqa: S102 - source made from the table above
    return made["put"], made["get"]


def _assignments(targets: Mapping[str, str], fields: Mapping[str, int]) -> list[str]:
    """Return one line for each array and for each row of single values between arrays."""
    lines, at = [], 0
    for array, row in groupby(fields, lambda path: path if fields[path] > 1 else ""):
        names = [targets[path] for path in row]
        size = fields[array] if array else len(names)
        values = "values" if size == sum(fields.values()) else f"values[{at}:{at + size}]"
        lines.append(f"{names[0]} = {values}" if array else f"{', '.join(names)}, = {values}")
        at += size
    return lines
