"""The topics of a recording under way: definitions, schemas, and their entries in metadata.yaml."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from mcap import records
from rosbags.interfaces import Qos
from rosbags.rosbag2.metadata import dump_qos_v9

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags import metadata
from auv_sim.bags.definitions import Definition, definition
from auv_sim.bags.metadata import TopicMetadata
from auv_sim.bags.writing.channel import Channel
from auv_sim.bags.writing.mcap_file import McapFile


class TopicTable:
    """Channels by topic name, each announced in a file before its first message there.

    Args:
        definitions: types that need not be looked up.
    """

    def __init__(self, definitions: Mapping[str, Definition] | None) -> None:
        self._definitions = definitions if definitions is not None else {}
        self._channels: dict[str, Channel] = {}
        self._schemas: dict[tuple[str, str, bytes], int] = {}

    def __iter__(self) -> Iterator[Channel]:
        return iter(self._channels.values())

    def add(self, name: str, type_name: str, qos: Sequence[Qos]) -> Channel:
        """Add a topic, see `BagWriter.add_topic`."""
        if name in self._channels:
            raise ConfigurationError(name, "a topic that is recorded already", "a new topic")
        try:
            self._definition(type_name)
        except ConfigurationError as error:
            raise ConfigurationError(name, f"the type {type_name}", error.expected) from None
        channel = self._channels[name] = Channel(name, type_name, list(dump_qos_v9(list(qos))))
        return channel

    def find(self, name: str) -> Channel | None:
        """Return a topic that was added before."""
        return self._channels.get(name)

    def copy(self, channel: records.Channel, schema: records.Schema | None, qos: Sequence[Qos]) -> Channel:
        """Add a topic of another file with its description there."""
        type_name = schema.name if schema else ""
        made = Channel(channel.topic, type_name, list(dump_qos_v9(list(qos))), (channel, schema))
        self._channels[channel.topic] = made
        return made

    def begin_file(self) -> None:
        """Forget the numbers that channels and schemas had in the file before."""
        self._schemas = {}
        for channel in self:
            channel.number = 0

    def announce(self, channel: Channel, file: McapFile) -> int:
        """Write a channel's record, and its schema's; return the channel's number in the file."""
        if channel.original is not None:
            known, schema = channel.original
            number = self._schema(file, schema.name, schema.encoding, schema.data) if schema else 0
            described, encoding = known.metadata, known.message_encoding
        else:
            text, type_hash = self._definition(channel.type)
            number = self._schema(file, channel.type, "ros2msg", text.encode())
            qos = metadata.dump(channel.qos).rstrip("\n")
            described, encoding = {"offered_qos_profiles": qos, "topic_type_hash": type_hash}, "cdr"
        channel.number = file.channel(channel.name, number, described, encoding)
        return channel.number

    def metadata(self) -> list[TopicMetadata]:
        """Return the topics' entries in metadata.yaml."""
        return [self._metadata(channel) for channel in self]

    def _metadata(self, channel: Channel) -> TopicMetadata:
        if channel.original is None:
            type_hash, encoding = self._definition(channel.type).type_hash, "cdr"
        else:
            known, _ = channel.original
            type_hash, encoding = known.metadata.get("topic_type_hash", ""), known.message_encoding
        messages = channel.count + channel.repeated
        return TopicMetadata(channel.name, channel.type, messages, channel.qos, type_hash, encoding)

    def _definition(self, type_name: str) -> Definition:
        """Return the given definition where ROS 2 Jazzy lacks the type or differs; else the standard one."""
        given = self._definitions.get(type_name)
        if given is None:
            return definition(type_name)
        try:
            standard = definition(type_name)
        except ConfigurationError:
            return given
        return standard if not given.text or given.text.split() == standard.text.split() else given

    def _schema(self, file: McapFile, *described: Any) -> int:
        if described not in self._schemas:
            self._schemas[described] = file.schema(*described)
        return self._schemas[described]
