"""Takes messages off subscriptions in batches: one wake-up for all topics instead of one for each message.

A recorder in lockstep receives some twenty messages a step. One by one, each of them costs a wake-up, a lock
and a callback, several times the cost of taking it from the reader's queue. So the queues are deep, no
executor serves them, and everything that has arrived is fetched every few milliseconds. The times of sending
and receipt are the middleware's, not those of a clock that is read afterwards.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from operator import itemgetter

from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from auv_msgs_py.contract.conversions import stamp_of
from auv_msgs_py.contract.qos import message_class
from auv_msgs_py.contract.topics import CLOCK
from auv_msgs_py.contract.wire import Clock, ForeignLayout
from auv_msgs_py.node.private_rclpy import take_polled
from auv_msgs_py.values.errors import MessageRefused
from auv_sim.bags.sequence_watch import SequenceWatch
from auv_sim.bags.writing.bag_writer import Channel

#: Least number of /clock times kept, for late messages.
_REMEMBERED = 10_000
#: A message sent this long before the newest /clock is a latched one, or the machine's clock was set, ns.
_LONG_AGO = 10_000_000_000
#: Sort key of messages.
_WHEN = itemgetter(0, 1, 2)


class PolledTopic:
    """A raw subscription that the recorder polls.

    Args:
        node: the recorder.
        name: full topic name.
        type_name: ROS type.
        profile: the requested QoS.
        channel: of the writer.
        fixed: whether the QoS must not change (lockstep waits for exactly this reader).
        is_clock: whether it has the time of the recording.
    """

    def __init__(
        self, node: Node, name: str, type_name: str, profile: QoSProfile, channel: Channel, fixed: bool,
        is_clock: bool,
    ) -> None:  # fmt: skip
        self.name = name
        self.channel = channel
        self.fixed = fixed
        #: Which messages are recorded, by their bytes; None: all.
        self.keeps: Callable[[bytes], bool] | None = None
        #: Whether a message has arrived; number of publishers.
        self.known = False
        self.publishers = 1
        self.watch = SequenceWatch()
        self._node = node
        self._fetched: list[ReceivedMessage] = []
        self._type = message_class(type_name)
        self.is_clock = is_clock
        self._subscribe(profile)

    def _subscribe(self, profile: QoSProfile) -> None:
        self.profile = profile
        self._subscription: Subscription = self._node.create_subscription(
            self._type, self.name, lambda _: None, profile, raw=True
        )
        self._take = take_polled(self._node, self._subscription)

    def resubscribe(self, profile: QoSProfile) -> None:
        """Request another QoS, unless a message has arrived: it would be lost with the old subscription."""
        self._fetch(self._fetched)
        if not self._fetched:
            self.close()
            self._subscribe(profile)

    def close(self) -> None:
        """End the subscription."""
        self._subscription.destroy()

    def take(self, batch: list[ReceivedMessage]) -> None:
        """Append everything that has arrived."""
        if self._fetched:
            batch += self._fetched
            self._fetched = []
        self._fetch(batch)

    def _fetch(self, batch: list[ReceivedMessage]) -> None:
        take, kind, order = self._take, self._type, 0 if self.is_clock else 1
        while (taken := take(kind, True)) is not None:
            data, info = taken
            received = info["received_timestamp"]
            sequence = info.get("publication_sequence_number") or 0
            batch.append((info["source_timestamp"] or received, order, sequence, received, self, data))


#: One message: time of sending (ns, the machine's clock), 0 for /clock and 1 for others, sequence number,
#: time of receipt (ns), topic, bytes.
ReceivedMessage = tuple[int, int, int, int, PolledTopic, bytes]


class Timestamps:
    """Log time and publish time of each message.

    Args:
        simulated: whether both are the time of /clock when the message was sent; else the machine's clock.
    """

    def __init__(self, simulated: bool) -> None:
        self.simulated = simulated
        #: Simulated time, ns; None before the first /clock.
        self.now: int | None = None
        # Times of sending of /clock, in order; its times; time of sending of the newest, ns.
        self._sent: list[int] = []
        self._clock_times: list[int] = []
        self._newest = 0
        self._message = Clock()

    def begin(self, batch: list[ReceivedMessage]) -> None:
        """Give what was sent before the first /clock the time of that message."""
        first = next((data for _, order, _, _, _, data in batch if order == 0), None)
        self.now = (self._clock(first) or 0) if first is not None else 0

    def tick(self, sent_ns: int, data: bytes) -> None:
        """Move the time: a /clock message was sent at `sent_ns`."""
        clock = self._clock(data) if self.simulated else None
        if clock is None:
            return
        if self._sent and sent_ns < self._newest:  # the machine's clock was set back
            self._sent, self._clock_times = [], []
        self.now, self._newest = clock, sent_ns
        self._sent.append(sent_ns)
        self._clock_times.append(clock)
        if len(self._sent) > 2 * _REMEMBERED:
            del self._sent[:-_REMEMBERED], self._clock_times[:-_REMEMBERED]

    def of(self, sent_ns: int, received_ns: int) -> tuple[int, int]:
        """Return log time and publish time of a message, ns.

        A topic is emptied a moment before /clock is. What is sent in between comes with the next batch, when
        newer times have been read: it gets the time of the /clock before it, not the newest.
        """
        if not self.simulated:
            return received_ns, sent_ns
        now = self.now or 0
        if self._newest - _LONG_AGO <= sent_ns < self._newest:
            now = self._clock_times[max(bisect_right(self._sent, sent_ns) - 1, 0)]
        return now, now

    def _clock(self, data: bytes) -> int | None:
        """Return the time of a /clock message, ns; None for bytes that hold none."""
        try:
            self._message.read(data)
            return stamp_of(self._message.clock, CLOCK.name)
        except (ForeignLayout, MessageRefused):
            return None


def drain(topics: list[PolledTopic]) -> list[ReceivedMessage]:
    """Everything that has come on all topics, in the order in which it was sent."""
    batch: list[ReceivedMessage] = []
    clocks: list[PolledTopic] = []
    for topic in topics:
        if topic.is_clock:
            clocks.append(topic)
        else:
            topic.take(batch)
    # Last, so that no message is there without the time at which it was sent.
    for topic in clocks:
        topic.take(batch)
    batch.sort(key=_WHEN)
    return batch
