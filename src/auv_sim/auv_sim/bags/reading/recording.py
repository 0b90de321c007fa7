"""A recording in memory: its topics and messages, whatever storage they come from."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from mcap.records import Attachment, Channel, Metadata, Schema

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError


@dataclass
class RecordedTopic:
    """One topic, its messages in the order of the file.

    Attributes:
        name, type: full topic name, ROS type.
        definition, encoding: the type's definition as the bag has it, and its notation (``ros2msg``).
        qos: what the publishers offered, as YAML.
        original: the records that describe it in an MCAP file.
        log_ns, publish_ns, sequence, sizes: for each message, ns and bytes.
        messages: serialised; None where only the size was requested.
        part: name of what counts in each message, where it was given.
        source: name in the recording, where the topic was renamed.
    """

    name: str
    type: str
    definition: str = ""
    encoding: str = ""
    qos: str = ""
    original: tuple[Channel, Schema | None] | None = None
    log_ns: list[int] = field(default_factory=list)
    publish_ns: list[int] = field(default_factory=list)
    sequence: list[int] = field(default_factory=list)
    sizes: list[int] = field(default_factory=list)
    messages: list[bytes | None] = field(default_factory=list)
    part: str = ""
    source: str = ""

    @property
    def count(self) -> int:
        """Number of messages."""
        return len(self.log_ns)

    def put(self, sequence: int, log_ns: int, publish_ns: int, data: bytes, keep: bool) -> None:
        """Append a message."""
        self.log_ns.append(log_ns)
        self.publish_ns.append(publish_ns)
        self.sequence.append(sequence)
        self.sizes.append(len(data))
        self.messages.append(data if keep else None)


@dataclass
class Bag:
    """A recording.

    Attributes:
        path: of the recording.
        odometry: full name of the topic that counts as the vehicle's odometry, where one was chosen.
        files: the storage files, with the number of messages in each.
        topics: by full name.
        notes: one line for each damage; empty for a whole recording.
        size: bytes of the files.
        texts: the flown configuration that the recorder stored, by file name.
        records: further metadata and attachments of MCAP files, from other recorders.
        profile: of MCAP files.
        vehicle: namespace of the one vehicle whose part of a recording of several this is.
        repeated: messages at the begin of a file that an earlier one has; they are left out.
        order: (topic, number of the message in it) for every message, in the order of the files.
    """

    path: Path
    files: dict[Path, int] = field(default_factory=dict)
    topics: dict[str, RecordedTopic] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    size: int = 0
    texts: dict[str, str] = field(default_factory=dict)
    records: list[Metadata | Attachment] = field(default_factory=list)
    profile: str = "ros2"
    order: list[tuple[RecordedTopic, int]] = field(default_factory=list)
    odometry: str | None = None
    vehicle: str | None = None
    repeated: int = 0

    @property
    def count(self) -> int:
        """Number of messages."""
        return sum(topic.count for topic in self.topics.values())

    @property
    def span_ns(self) -> tuple[int, int]:
        """First and last log time; zeros for an empty bag."""
        held = [topic.log_ns for topic in self.topics.values() if topic.count]
        return (min(map(min, held)), max(map(max, held))) if held else (0, 0)

    @property
    def vehicles(self) -> list[str]:
        """The namespaces in which a vehicle's odometry and its mission's state were recorded."""
        return sorted(
            space or "/"
            for space, _, last in (name.rpartition("/") for name in self.topics)
            if last == topics.ODOM.name and f"{space}/{topics.MISSION_STATE.name}" in self.topics
        )

    def find(self, name: str, namespace: str | None = None) -> RecordedTopic | None:
        """Return the topic whose name ends in `name`, of one vehicle; for odometry see `_find_odometry`.

        Raises:
            ConfigurationError: several vehicles have it, and none is chosen.
        """
        found = [
            topic
            for topic in self.topics.values()
            if topic.name.rsplit("/", 1)[-1] == name and _is_of(topic, namespace, name)
        ]
        if name == topics.ODOM.name and (self.odometry is not None or not found):
            return self._find_odometry(namespace)
        if len(found) > 1:
            listed = " and ".join(sorted(topic.name for topic in found))
            raise ConfigurationError(
                str(self.path), f"several topics {name}: {listed}", "one vehicle, or its namespace"
            )
        return found[0] if found else None

    def _find_odometry(self, namespace: str | None) -> RecordedTopic | None:
        """Return the chosen odometry, else the only one of its type; a simulator's truth does not count.

        Raises:
            ConfigurationError: the chosen one is missing, or none is chosen and there are several.
        """
        kind, truth = topics.ODOM.type, topics.TRUE_ODOM.name
        there = sorted(
            topic.name
            for topic in self.topics.values()
            if topic.type == kind and topic.name.rsplit("/", 1)[-1] != truth and _is_of(topic, namespace)
        )
        listed = " and ".join(there)
        if self.odometry is not None:
            chosen = self.topics.get("/" + self.odometry.strip("/"))
            if chosen is None or chosen.type != kind:
                expected = f"one of {listed}" if there else f"a topic of type {kind}"
                raise ConfigurationError("--odometry", self.odometry, expected)
            return chosen
        if len(there) > 1:
            found = f"no topic {topics.ODOM.name}, but {listed}"
            raise ConfigurationError(str(self.path), found, "--odometry with one of them")
        return self.topics[there[0]] if there else None

    def in_order(self) -> Iterator[tuple[RecordedTopic, int]]:
        """Yield every message by log time; messages of one time stay in the order of the file."""
        yield from sorted(self.order, key=lambda entry: entry[0].log_ns[entry[1]])


def _is_of(topic: RecordedTopic, namespace: str | None, name: str | None = None) -> bool:
    """Return whether a topic is of a vehicle: directly in its namespace if named, else anywhere below."""
    if namespace is None:
        return True
    above = f"/{namespace.strip('/')}/".replace("//", "/")
    return topic.name.startswith(above) if name is None else topic.name == above + name


#: Choose topics by name and type: True keeps a topic's messages, False only their sizes.
TopicFilter = Callable[[str, str], bool]
