"""Adds MCAP files to a recording, joined by topic over all files."""

from __future__ import annotations

from pathlib import Path

from mcap.records import Channel, Schema

from auv_sim.bags.reading.recording import Bag, RecordedTopic, TopicFilter
from auv_sim.bags.reading.storage.mcap_scan import ScanResult, scan
from auv_sim.bags.texts import TEXTS

#: The metadata record in which rosbag2 repeats metadata.yaml.
_REPEATED = "rosbag2"
#: Most publishers of one latched topic.
_LATCHED = 100


def read_mcap(bag: Bag, file: Path, keeps: TopicFilter) -> None:
    """Add a file to a recording.

    Raises:
        ConfigurationError: it cannot be opened, or is no MCAP file at all.
    """
    by_number: dict[int, RecordedTopic] = {}
    order: list[tuple[RecordedTopic, int]] = []

    def take(channel: int, sequence: int, log_ns: int, publish_ns: int, data: bytes) -> None:
        topic = by_number.get(channel)
        if topic is None:
            topic = by_number[channel] = RecordedTopic("", "")
        order.append((topic, topic.count))
        topic.put(sequence, log_ns, publish_ns, data, True)

    result = scan(file, take)
    bag.notes += [f"{file.name}: {note}" for note in result.notes]
    _take_records(bag, result)
    renumbered: dict[int, tuple[RecordedTopic, int, int]] = {}
    for number, channel in result.channels.items():
        here = by_number.setdefault(number, RecordedTopic("", ""))
        topic = _joined(bag, file, channel, result.schemas.get(channel.schema_id), here)
        if topic is not None:
            repeated = _repeats(topic, here)
            bag.repeated += repeated
            renumbered[id(here)] = topic, topic.count - repeated, repeated
            _append(topic, here, repeated, keeps(channel.topic, topic.type))
    nameless = [t for number, t in by_number.items() if number not in result.channels]
    if nameless:
        number = sum(topic.count for topic in nameless)
        bag.notes.append(f"{file.name}: {number} messages belong to no known topic")
    for here, k in order:
        if id(here) in renumbered:
            topic, offset, repeated = renumbered[id(here)]
            if k >= repeated:
                bag.order.append((topic, offset + k))


def _take_records(bag: Bag, result: ScanResult) -> None:
    """Add the file's profile, texts, and other records."""
    bag.profile = result.profile
    for record in result.metadata:
        if record.name == TEXTS:
            bag.texts |= record.metadata
        elif record.name != _REPEATED and record not in bag.records:
            bag.records.append(record)  # once: a recorder repeats it in every file
    bag.records += result.attachments


def _joined(
    bag: Bag, file: Path, channel: Channel, schema: Schema | None, here: RecordedTopic
) -> RecordedTopic | None:
    """Return the recording's topic of a channel; None, with a note, for one of another type."""
    type_name = schema.name if schema else ""
    topic = bag.topics.get(channel.topic)
    if topic is None:
        topic = bag.topics[channel.topic] = RecordedTopic(channel.topic, type_name)
        topic.qos = channel.metadata.get("offered_qos_profiles", "")
        topic.original = channel, schema
        if schema:
            topic.definition = schema.data.decode("utf-8", "replace")
            topic.encoding = schema.encoding
    elif topic.original is not None and not _alike(*topic.original, channel, schema):
        if here.count:
            found = f"{here.count} messages of a second type '{type_name}' on {channel.topic} left out"
            bag.notes.append(f"{file.name}: {found}")
        return None
    return topic


def _append(topic: RecordedTopic, here: RecordedTopic, repeated: int, keep: bool) -> None:
    """Append a file's messages to a topic, without those that are repeated."""
    topic.log_ns += here.log_ns[repeated:]
    topic.publish_ns += here.publish_ns[repeated:]
    topic.sequence += here.sequence[repeated:]
    topic.sizes += here.sizes[repeated:]
    topic.messages += here.messages[repeated:] if keep else [None] * (here.count - repeated)


def _repeats(topic: RecordedTopic, here: RecordedTopic) -> int:
    """Return how many messages of a further file repeat the last ones of the files before it.

    A recorder begins each file with the latched messages, under their original numbers and times.
    """
    if "transient_local" not in topic.qos:
        return 0
    known = set(
        zip(topic.sequence[-_LATCHED:], topic.publish_ns[-_LATCHED:], topic.sizes[-_LATCHED:], strict=True)
    )
    repeated = 0
    for message in zip(here.sequence, here.publish_ns, here.sizes, strict=True):
        if message not in known:
            break
        repeated += 1
    return repeated


def _alike(a: Channel, a_schema: Schema | None, b: Channel, b_schema: Schema | None) -> bool:
    """Return whether two channels of one name hold the same kind of message."""
    if a.message_encoding != b.message_encoding or (a_schema is None) != (b_schema is None):
        return False
    return a_schema is None or (a_schema.name, a_schema.encoding) == (b_schema.name, b_schema.encoding)  # type: ignore[union-attr]
