"""Takes messages off subscriptions in batches: one wake-up for all topics instead of one for each message.

A recorder in lockstep gets some twenty messages a step. Handed over one by one each of them costs a wake-up,
a lock and a callback, which is several times what taking it from the reader's queue costs. So the queues are
deep, no executor looks at them, and every few milliseconds everything that has come is fetched at once. When
each message was sent and received is what the middleware says, not a clock that is read afterwards.
"""

from __future__ import annotations

from bisect import bisect_right
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

#: At least so many times of /clock are remembered, for messages that come late.
_REMEMBERED = 10_000
#: A message sent this long before the newest /clock is a latched one, or the machine's clock was set, ns.
_LONG_AGO = 10_000_000_000
#: What messages are sorted by.
_WHEN = itemgetter(0, 1, 2)


class PolledTopic:
    """A raw subscription that is emptied when it suits the recorder.

    Args:
        node: the recorder.
        name: full topic name.
        type_name: ROS type.
        profile: the QoS to ask for.
        channel: where its messages go.
        fixed: the QoS must stay as it is (lockstep waits for exactly this reader).
    """

    def __init__(
        self, node: Node, name: str, type_name: str, profile: QoSProfile, channel: Channel, fixed: bool
    ) -> None:
        self.name = name
        self.channel = channel
        self.fixed = fixed
        #: Whether a message has come, and from how many publishers they may come.
        self.known = False
        self.publishers = 1
        self.watch = SequenceWatch()
        self._node = node
        self._fetched: list[Taken] = []
        self._type = message_class(type_name)
        self.is_clock = name == CLOCK.name
        self._subscribe(profile)

    def _subscribe(self, profile: QoSProfile) -> None:
        self.profile = profile
        self._subscription: Subscription = self._node.create_subscription(
            self._type, self.name, lambda _: None, profile, raw=True
        )
        self._take = take_polled(self._node, self._subscription)

    def resubscribe(self, profile: QoSProfile) -> None:
        """Ask for another QoS, unless something has come by now: it would go with the old subscription."""
        self._fetch(self._fetched)
        if not self._fetched:
            self.close()
            self._subscribe(profile)

    def close(self) -> None:
        """Leave the topic."""
        self._subscription.destroy()

    def take(self, batch: list[Taken]) -> None:
        """Append everything that has come."""
        if self._fetched:
            batch += self._fetched
            self._fetched = []
        self._fetch(batch)

    def _fetch(self, batch: list[Taken]) -> None:
        take, kind, order = self._take, self._type, 0 if self.is_clock else 1
        while (taken := take(kind, True)) is not None:
            data, info = taken
            received = info["received_timestamp"]
            sequence = info.get("publication_sequence_number") or 0
            batch.append((info["source_timestamp"] or received, order, sequence, received, self, data))


#: One message: when it was sent (ns, the machine's clock), 0 for /clock and 1 for all else, its publisher's
#: number of it, when it was received (ns), its topic, its bytes.
Taken = tuple[int, int, int, int, PolledTopic, bytes]


class Timestamps:
    """Log time and publish time of each message.

    Args:
        simulated: both are what /clock said when the message was sent; else the machine's clock.
    """

    def __init__(self, simulated: bool) -> None:
        self.simulated = simulated
        #: Simulated time, ns; None before the first /clock.
        self.now: int | None = None
        # When each /clock was sent, in that order, what it said, and when the newest was sent, ns.
        self._sent: list[int] = []
        self._said: list[int] = []
        self._newest = 0
        self._message = Clock()

    def begin(self, batch: list[Taken]) -> None:
        """Give what was sent before the first /clock the time of that message."""
        first = next((data for _, order, _, _, _, data in batch if order == 0), None)
        self.now = (self._clock(first) or 0) if first is not None else 0

    def tick(self, sent_ns: int, data: bytes) -> None:
        """Move the time: a /clock message was sent at `sent_ns`."""
        said = self._clock(data) if self.simulated else None
        if said is None:
            return
        if self._sent and sent_ns < self._newest:  # the machine's clock was set back
            self._sent, self._said = [], []
        self.now, self._newest = said, sent_ns
        self._sent.append(sent_ns)
        self._said.append(said)
        if len(self._sent) > 2 * _REMEMBERED:
            del self._sent[:-_REMEMBERED], self._said[:-_REMEMBERED]

    def of(self, sent_ns: int, received_ns: int) -> tuple[int, int]:
        """Return log time and publish time of a message, ns.

        A topic is emptied a moment before /clock is. What is sent in between comes with the next batch, when
        newer times have been read: it gets the time of the /clock before it, not the newest.
        """
        if not self.simulated:
            return received_ns, sent_ns
        now = self.now or 0
        if self._newest - _LONG_AGO <= sent_ns < self._newest:
            now = self._said[max(bisect_right(self._sent, sent_ns) - 1, 0)]
        return now, now

    def _clock(self, data: bytes) -> int | None:
        """Return the time of a /clock message, ns; None for bytes that hold none."""
        try:
            self._message.read(data)
            return stamp_of(self._message.clock, CLOCK.name)
        except (ForeignLayout, MessageRefused):
            return None


def drain(topics: list[PolledTopic]) -> list[Taken]:
    """Everything that has come on all topics, in the order in which it was sent."""
    batch: list[Taken] = []
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
