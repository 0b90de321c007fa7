"""Faults: each turns the messages of one topic into others."""

from __future__ import annotations

from collections import deque
from typing import Any, get_args

from rclpy.serialization import deserialize_message, serialize_message

from auv_sim.nodes.message_faults import changed
from auv_sim.sim_parameters import Fault

FAULTS: tuple[Fault, ...] = tuple(fault for fault in get_args(Fault) if fault != "none")

#: Most messages kept for the fault reverse.
_MEMORY = 1000


class Injector:
    """Turns each serialized message of a topic into those that are sent in its place.

    stop        nothing.
    delay       the message, `delay` seconds later.
    nan         its first number is NaN; a text becomes ``nan``.
    freeze      the content of the last good message, with the stamp of this one.
    jump        its first number is larger by `jump`.
    reverse     the last good messages in reverse order, as they were, and the first of them from then on.
    flood       `copies` of the message, spread over the time to the next one.
    frameless   an empty frame_id.
    timeless    a stamp of 4294967295 ns, which is invalid.
    cut         the first half of its bytes.
    forge       the message, and behind the first one the text ``complete`` once.
    weak        a tenth of its first number.

    Of an odometry, for a vehicle that dives:

    depth_nan, depth_freeze, depth_turn  z is NaN, that of the last good message, or of the other sign.
    depth_jump  z is 30 m deeper (ENU: lower).
    planar      depth, roll and pitch are 0.
    rolled      the roll is larger by 75 deg.

    Args:
        kind: the message class.
        delay: s.
        jump: in the unit of the topic.
        copies: of each message of a flood.
    """

    def __init__(self, kind: type[Any], delay: float = 2.0, jump: float = 100.0, copies: int = 100) -> None:
        self.kind = kind
        self.delay, self.jump, self.copies = delay, jump, copies
        self._fault: Fault = "none"
        self._forged = False
        self._past: deque[bytes] = deque(maxlen=_MEMORY)
        self._under_way: deque[tuple[float, bytes]] = deque()
        self._came = 0.0

    @property
    def fault(self) -> Fault:
        """The fault in force."""
        return self._fault

    @fault.setter
    def fault(self, fault: Fault) -> None:
        self._fault = fault
        self._forged = False
        self._under_way.clear()

    def pass_on(self, data: bytes, now: float) -> list[bytes]:
        """Return what to send for a message that arrived at `now`, s."""
        match self._fault:
            case "none":
                self._came = now
                self._past.append(data)
                return [data]
            case "stop":
                return []
            case "delay":
                self._under_way.append((now + self.delay, data))
                return self.due(now)
            case "reverse":
                return [self._past.pop() if len(self._past) > 1 else self._past[0]] if self._past else []
            case "cut":
                return [data[: len(data) // 2]]
            case "forge" if self._forged:
                return [data]
            case "forge":
                self._forged = True
                return [data, bytes(serialize_message(self.kind(data="complete")))]
            case "flood":
                gap = min(now - self._came, 1.0) / self.copies
                self._came = now
                self._under_way.extend((now + k * gap, data) for k in range(1, self.copies))
                return [data]
            case _:
                return [self._changed(data)]

    def due(self, now: float) -> list[bytes]:
        """Return the delayed messages that are due."""
        found = []
        while self._under_way and self._under_way[0][0] <= now:
            found.append(self._under_way.popleft()[1])
        return found

    def _changed(self, data: bytes) -> bytes:
        message = deserialize_message(data, self.kind)
        last = deserialize_message(self._past[-1], self.kind) if self._past else None
        return bytes(serialize_message(changed(self._fault, message, last, self.jump)))
