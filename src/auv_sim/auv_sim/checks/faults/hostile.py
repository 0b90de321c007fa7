"""A hostile participant: publishes on every topic of the contract what no vehicle or node would.

    python3 -m auv_sim.checks.faults.hostile 300        # for 300 s, in namespace /auv of ROS_DOMAIN_ID

`scripts/fault_matrix.py --hostile 300` flies a graph beside it and judges.
"""

from __future__ import annotations

import contextlib
import math
import random
import sys
import time
from collections.abc import Iterator, Sequence
from typing import Any

import rclpy
from rclpy.serialization import serialize_message

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.private_rclpy import RCLError
from auv_msgs_py.node.transport import WirePublisher

#: All that it publishes on.
TOPICS = (*topics.CONTRACT, topics.RECORDED_STEPS, topics.GRAPH_CLAIMS)
#: Period of the messages on every topic, s; period of the floods, s; messages of a flood, sent in 1 s.
_PERIOD, _FLOOD_EVERY, _FLOOD = 0.05, 5.0, 1000
_NUMBERS = (math.nan, math.inf, 1e308, -1e308, 5e-324, 0.3, 1e6)
_WORDS = ("complete", "idle", "aborted", "holding", "", "\x1b[2J", "x" * 1_000_000)
_STAMPS = ((0, 0), (1, 5), (-5, 0), (2**31 - 1, 2**32 - 1), (1_900_000_000, 0))
_FRAMES = ("map", "base_link", "", "moon", "x" * 10_000)


class Malice:
    """Makes the messages, in an order that depends on the seed alone.

    Args:
        seed: of the order.
    """

    def __init__(self, seed: int = 0) -> None:
        self._chance = random.Random(seed)  # noqa: S311 - malice that can be repeated

    def of(self, topic: Topic) -> bytes:
        """Return the next message of a topic, serialised, or bytes that are none."""
        if self._chance.random() < 0.2:
            return self._chance.randbytes(self._chance.randrange(4, 200))
        message = qos.message_class(topic.type)()
        self._fill(message)
        if topic is topics.GRAPH_CLAIMS:
            claim = Claim(
                holder="/hostile", namespace="/auv", names=(topics.GUIDANCE,), clock=True, held=True
            )
            message.data = self._chance.choice(("{}", "[" * 500, claim.encode()))
        if topic is topics.ODOM and self._chance.random() < 0.5:  # right in all but one thing
            message.header.frame_id, message.child_frame_id = "map", "base_link"
            message.pose.pose.orientation.z, message.pose.pose.orientation.w = 0.0, 1.0
        data = bytes(serialize_message(message))
        return data[: self._chance.randrange(4, len(data))] if self._chance.random() < 0.1 else data

    def _fill(self, message: Any) -> None:
        """Give every field a value that is extreme or wrong; ROS allows it."""
        for name, kind in message.get_fields_and_field_types().items():
            field = getattr(message, name)
            if kind in ("double", "float"):
                setattr(message, name, self._chance.choice(_NUMBERS))
            elif kind == "string":
                words = _FRAMES if "frame" in name else _WORDS[:-1]
                rare = name == "data" and self._chance.random() < 0.01
                setattr(message, name, _WORDS[-1] if rare else self._chance.choice(words))
            elif kind.startswith("uint64"):
                setattr(message, name, self._chance.choice((0, 2**63, 2**64 - 1)))
            elif kind == "builtin_interfaces/Time":
                field.sec, field.nanosec = self._chance.choice(_STAMPS)
            elif hasattr(field, "get_fields_and_field_types"):
                self._fill(field)


def publish(seconds: float, namespace: str = "/auv", seed: int = 0) -> None:
    """Publish for `seconds` s of wall time."""
    rclpy.init(args=[])
    node = rclpy.create_node("hostile", namespace=namespace, start_parameter_services=False)
    publishers = {
        topic: node.create_publisher(
            qos.message_class(topic.type), topic.name, qos.offered(topic), publisher_class=WirePublisher
        )
        for topic in TOPICS
    }
    malice, floods = Malice(seed), _rounds()

    def send(topic: Topic) -> None:
        # The middleware does not send more bytes than the largest message of a type has.
        with contextlib.suppress(RCLError):
            publishers[topic].publish(malice.of(topic))

    end = time.monotonic() + seconds
    next_flood = time.monotonic() + _FLOOD_EVERY
    try:
        while time.monotonic() < end:
            for topic in TOPICS:
                send(topic)
            if time.monotonic() > next_flood:
                next_flood = time.monotonic() + _FLOOD_EVERY
                flooded = next(floods)
                for _ in range(_FLOOD):
                    send(flooded)
                    time.sleep(1.0 / _FLOOD)
            time.sleep(_PERIOD)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _rounds() -> Iterator[Topic]:
    while True:
        yield from TOPICS


def main(argv: Sequence[str]) -> int:
    """Publish; the arguments are seconds and, optionally, a namespace."""
    publish(float(argv[0]), argv[1] if len(argv) > 1 else "/auv")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
