"""The contract's numeric messages, as light as they can be: read from and written to their bytes. ROS-free.

Each class has the attributes of the ROS message of its name, so a conversion takes either, and `read` and
`serialized` for the CDR bytes that rclpy delivers and sends raw; `codec` has their layout. rclpy makes a
Python object of every nested part and a NumPy array of every covariance: reading an Odometry costs it 230 us
and writing one 31 us, and this module 2 us each. That was more than half of a lockstep step's processor time.
"""

from __future__ import annotations

import struct
from typing import Any, ClassVar

from auv_msgs_py.contract.codec import (
    HEADER,
    LAYOUTS,
    LITTLE_ENDIAN,
    STAMP,
    Getter,
    Layout,
    Setter,
    accessors,
    aligned,
    read_texts,
    written_texts,
)
from auv_msgs_py.contract.wire_parts import (
    Header,
    Pose,
    PoseWithCovariance,
    Time,
    TwistWithCovariance,
    Vector,
)

#: Where the first field begins, and the first text of a stamped message.
_BODY = len(HEADER)
_TEXTS = _BODY + STAMP.size
# Bound once: an attribute of an imported name is looked up anew at each call.
_pack_stamp, _pack_stamp_into, _unpack_stamp = STAMP.pack, STAMP.pack_into, STAMP.unpack_from
#: ROS type -> the class here that has its attributes.
LIGHT: dict[str, Any] = {}


class ForeignLayout(ValueError):
    """Bytes that only the middleware's own deserialiser can judge: big endian, or cut short."""


class Message:
    """Base of all classes here. A class names its ROS type and takes its layout from the table.

    Attributes:
        layout: of the type's bytes.
    """

    __slots__ = ()

    layout: ClassVar[Layout]
    _numbers: ClassVar[struct.Struct]
    _put: ClassVar[Setter]
    _get: ClassVar[Getter]
    _put_texts: ClassVar[Setter]
    _get_texts: ClassVar[Getter]

    def __init_subclass__(cls, type_name: str = "") -> None:
        if type_name:
            LIGHT[type_name] = cls
            cls.layout = LAYOUTS[type_name]
            cls._numbers = struct.Struct(f"<{cls.layout.doubles}d")
            cls._put, cls._get = accessors(cls.layout.numbers)
            cls._put_texts, cls._get_texts = accessors(dict.fromkeys(cls.layout.texts, 1))

    def read(self, data: bytes) -> None:
        """Take all values from a serialised message.

        Raises:
            ForeignLayout: the bytes are not little-endian CDR of this type.
        """
        raise NotImplementedError

    def serialized(self) -> bytes:
        """Return the message as CDR, equal to what rclpy would send."""
        raise NotImplementedError


class Float64(Message, type_name="std_msgs/msg/Float64"):
    """std_msgs/msg/Float64."""

    __slots__ = ("data",)

    def __init__(self, data: float = 0.0) -> None:
        self.data = data

    def read(self, data: bytes) -> None:
        if data[:2] != LITTLE_ENDIAN:
            raise ForeignLayout
        try:
            (self.data,) = self._numbers.unpack_from(data, _BODY)
        except struct.error:
            raise ForeignLayout from None

    def serialized(self) -> bytes:
        return HEADER + self._numbers.pack(self.data)


class Clock(Message, type_name="rosgraph_msgs/msg/Clock"):
    """rosgraph_msgs/msg/Clock."""

    __slots__ = ("clock",)

    def __init__(self) -> None:
        self.clock = Time()

    def read(self, data: bytes) -> None:
        if data[:2] != LITTLE_ENDIAN:
            raise ForeignLayout
        try:
            self.clock.sec, self.clock.nanosec = _unpack_stamp(data, _BODY)
        except struct.error:
            raise ForeignLayout from None

    def serialized(self) -> bytes:
        return HEADER + _pack_stamp(self.clock.sec, self.clock.nanosec)


class _Stamped(Message):
    """A header, perhaps further frame ids, then only float64.

    Frame ids hardly ever change, so their bytes are kept, for reading and for writing.
    """

    __slots__ = ("_buffer", "_seen", "_start", "_written", "header")

    def __init__(self, frame_id: str = "") -> None:
        self.header = Header()
        self.header.frame_id = frame_id
        self._seen, self._start = b"", 0
        self._written: tuple[str, ...] | None = None

    def read(self, data: bytes) -> None:
        if data[:2] != LITTLE_ENDIAN:
            raise ForeignLayout
        try:
            stamp = self.header.stamp
            stamp.sec, stamp.nanosec = _unpack_stamp(data, _BODY)
            if not self._start or data[_TEXTS : self._start] != self._seen:
                texts, end = read_texts(data, self.layout)
                self._start = aligned(end)
                self._seen = data[_TEXTS : self._start]
                self._put_texts(tuple(text.decode(errors="replace") for text in texts))
            self._put(self._numbers.unpack_from(data, self._start))
        except struct.error:
            self._start = 0
            raise ForeignLayout from None

    def serialized(self) -> bytes:
        texts = self._get_texts()
        if texts != self._written:
            # A buffer with everything that stays the same from message to message.
            self._written = texts
            self._buffer = bytearray(HEADER + bytes(STAMP.size) + written_texts(texts))
            self._buffer += bytes(self._numbers.size)
        buffer, stamp = self._buffer, self.header.stamp
        _pack_stamp_into(buffer, _BODY, stamp.sec, stamp.nanosec)
        self._numbers.pack_into(buffer, len(buffer) - self._numbers.size, *self._get())
        return bytes(buffer)


class Vector3Stamped(_Stamped, type_name="geometry_msgs/msg/Vector3Stamped"):
    """geometry_msgs/msg/Vector3Stamped."""

    __slots__ = ("vector",)

    def __init__(self, frame_id: str = "") -> None:
        super().__init__(frame_id)
        self.vector = Vector()


class PoseStamped(_Stamped, type_name="geometry_msgs/msg/PoseStamped"):
    """geometry_msgs/msg/PoseStamped."""

    __slots__ = ("pose",)

    def __init__(self, frame_id: str = "") -> None:
        super().__init__(frame_id)
        self.pose = Pose()


class TwistWithCovarianceStamped(_Stamped, type_name="geometry_msgs/msg/TwistWithCovarianceStamped"):
    """geometry_msgs/msg/TwistWithCovarianceStamped."""

    __slots__ = ("twist",)

    def __init__(self, frame_id: str = "") -> None:
        super().__init__(frame_id)
        self.twist = TwistWithCovariance()


class Odometry(_Stamped, type_name="nav_msgs/msg/Odometry"):
    """nav_msgs/msg/Odometry."""

    __slots__ = ("child_frame_id", "pose", "twist")

    def __init__(self, frame_id: str = "", child_frame_id: str = "") -> None:
        super().__init__(frame_id)
        self.child_frame_id = child_frame_id
        self.pose, self.twist = PoseWithCovariance(), TwistWithCovariance()
