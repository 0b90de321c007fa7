"""Topics of manoeuvres in a recording of another maker: other names, and other types of the same numbers."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.other_makers.foreign_motion import VELOCITIES
from auv_sim.bags.reading.other_makers.message_parts import check_part
from auv_sim.bags.reading.recording import Bag, RecordedTopic

#: Topics that are read, by the names of the wire contract.
READ = (
    topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_CMD, topics.THRUST_CMD, topics.STERNPLANE_CMD,
)  # fmt: skip
#: Types of commands that need no part: one number named `data`. The contract's is the first.
_NUMBERS = tuple(
    f"std_msgs/msg/{kind}"
    for kind in ("Float64", "Float32", "Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32")
)


def missing(bag: Bag, topic: Topic) -> ConfigurationError:
    """Return the error of a topic without messages."""
    listed = ", ".join(sorted(bag.topics)) or "no topic"
    expected = (
        f"messages ({topic.type}) before the last odometry, or --topic {topic.name}=NAME with one of {listed}"
    )
    return ConfigurationError(str(bag.path), f"no {topic.name}", expected)


def renamed(bag: Bag, names: Mapping[str, str]) -> Bag:
    """Return the bag with topics under their names of the wire contract.

    Args:
        bag: as recorded.
        names: name of the wire contract -> full name of a topic, with `:` and a part of its messages where
            these have more than one number or vector.

    Raises:
        ConfigurationError: there is no such topic, it is of another type, or has two names; or the velocity
            through the water is that of the odometry.
    """
    sources: dict[str, RecordedTopic] = {}
    rows = {topic.name: topic for topic in READ}
    for name, other in names.items():
        text, _, part = other.partition(":")
        full = "/" + text.strip("/")
        if full not in bag.topics:
            listed = ", ".join(sorted(bag.topics)) or "none"
            raise ConfigurationError(f"--topic {name}", full, f"a topic of {bag.path}: {listed}")
        if any(topic.source == full and topic.part == part for topic in sources.values()):
            raise ConfigurationError(
                f"--topic {name}", f"{other}, which is given twice", "a topic of its own"
            )
        sources[name] = dataclasses.replace(bag.topics[full], part=part, source=full)
    for name, topic in sources.items():
        _check_type(bag, rows[name], topic)
    chosen = sources.pop(topics.ODOM.name, None)
    odometry = bag.odometry if chosen is None else chosen.source
    _check_velocity(bag, sources.get(topics.WATER_VELOCITY.name), odometry)
    replaced = {topic.source for topic in sources.values()} - {odometry}
    kept = {
        key: topic
        for key, topic in bag.topics.items()
        if key not in replaced and key.rsplit("/", 1)[-1] not in sources
    }
    for name, topic in sources.items():
        own = topic.source.rsplit("/", 1)[0] + "/" + name
        kept[own] = dataclasses.replace(topic, name=own)
    return dataclasses.replace(bag, topics=kept, odometry=odometry)


def _check_velocity(bag: Bag, velocity: RecordedTopic | None, odometry: str | None) -> None:
    """Refuse the only odometry as the velocity through the water: its twist is over ground."""
    others = {name for name, topic in bag.topics.items() if topic.type == topics.ODOM.type}
    if velocity is not None and velocity.source in others:
        others = {odometry} if odometry else others
        if others == {velocity.source}:
            raise ConfigurationError(
                f"--topic {topics.WATER_VELOCITY.name}", f"{velocity.source}, the odometry itself",
                "a velocity through the water of its own",
            )  # fmt: skip


def topics_of(bag: Bag, namespace: str | None) -> dict[Topic, RecordedTopic | None]:
    """Return the topics of `READ`; None for planes that are missing.

    Raises:
        ConfigurationError: one is missing, of another type, or of several vehicles.
    """
    found: dict[Topic, RecordedTopic | None] = {}
    for row in READ:
        try:
            topic = bag.find(row.name, namespace)
        except ConfigurationError as error:
            expected = error.expected.replace("--odometry", f"--topic {row.name}=NAME")
            raise ConfigurationError(error.where, error.found, expected) from None
        if topic is not None and topic.count:
            _check_type(bag, row, topic)
        elif row is not topics.STERNPLANE_CMD:
            raise missing(bag, row)
        found[row] = topic
    return found


def _check_type(bag: Bag, row: Topic, topic: RecordedTopic) -> None:
    """Check the type of a topic, or the part that was given."""
    where = f"{bag.path}: {topic.source or topic.name}"
    if row is topics.ODOM:
        if topic.type != row.type or topic.part:
            found = f"a part, {topic.part}," if topic.type == row.type else topic.type
            raise ConfigurationError(where, found, f"{row.type} as {row.name}")
    elif row is topics.WATER_VELOCITY:
        if topic.part or topic.type not in VELOCITIES:
            check_part(bag, row, topic, is_vector=True)
    elif topic.type not in _NUMBERS or topic.part:
        check_part(bag, row, topic)
