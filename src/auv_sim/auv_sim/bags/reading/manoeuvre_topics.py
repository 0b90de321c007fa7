"""Topics of manoeuvres in a recording of another maker: other names, and other types of the same numbers."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.recording import Bag, RecordedTopic

#: Topics that are read, by the names of the wire contract.
READ = (
    topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_CMD, topics.THRUST_CMD, topics.STERNPLANE_CMD,
)  # fmt: skip
#: Types of commands: one number named `data`. The contract's is the first.
_NUMBERS = tuple(f"std_msgs/msg/{kind}" for kind in ("Float64", "Float32", "Int16", "Int32", "UInt16"))
#: The contract's velocity through the water without its covariance, which ends the message; its bytes.
_WITHOUT_COVARIANCE, _COVARIANCE = "geometry_msgs/msg/TwistStamped", 36 * 8
#: Types that are read.
_TYPES: dict[Topic, tuple[str, ...]] = {
    topics.ODOM: (topics.ODOM.type,),
    topics.WATER_VELOCITY: (topics.WATER_VELOCITY.type, _WITHOUT_COVARIANCE),
    **dict.fromkeys(READ[2:], _NUMBERS),
}


def missing(bag: Bag, topic: Topic) -> ConfigurationError:
    """Return the error of a topic without messages."""
    listed = ", ".join(sorted(bag.topics)) or "no topic"
    expected = (
        f"messages ({topic.type}) before the last odometry, or --topic {topic.name}=NAME with one of {listed}"
    )
    return ConfigurationError(str(bag.path), f"no {topic.name}", expected)


def renamed(bag: Bag, names: Mapping[str, str]) -> Bag:
    """Return the bag with topics under their names of the wire contract.

    Raises:
        ConfigurationError: there is no such topic, it is of another type, or has two names.
    """
    sources: dict[str, str] = {}
    rows = {topic.name: topic for topic in READ}
    for name, other in names.items():
        full = "/" + other.strip("/")
        if full not in bag.topics:
            listed = ", ".join(sorted(bag.topics)) or "none"
            raise ConfigurationError(f"--topic {name}", full, f"a topic of {bag.path}: {listed}")
        if full in sources.values():
            raise ConfigurationError(f"--topic {name}", f"{full}, which is given twice", "a topic of its own")
        sources[name] = full
    for name, full in sources.items():
        _check_type(bag, rows[name], bag.topics[full])
    odometry = sources.pop(topics.ODOM.name, bag.odometry)
    kept = {
        key: topic
        for key, topic in bag.topics.items()
        if key not in sources.values() and key.rsplit("/", 1)[-1] not in sources
    }
    for name, full in sources.items():
        own = full.rsplit("/", 1)[0] + "/" + name
        kept[own] = dataclasses.replace(bag.topics[full], name=own)
    return dataclasses.replace(bag, topics=kept, odometry=odometry)


def topics_of(bag: Bag, namespace: str | None) -> dict[Topic, RecordedTopic | None]:
    """Return the topics of `READ`, the velocity as the contract's type; None for planes that are missing.

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
            topic = _with_covariance(topic) if row is topics.WATER_VELOCITY else topic
        elif row is not topics.STERNPLANE_CMD:
            raise missing(bag, row)
        found[row] = topic
    return found


def _check_type(bag: Bag, row: Topic, topic: RecordedTopic) -> None:
    if topic.type not in _TYPES[row]:
        several = "one of " if len(_TYPES[row]) > 1 else ""
        expected = f"{several}{', '.join(_TYPES[row])} as {row.name}"
        raise ConfigurationError(f"{bag.path}: {topic.name}", topic.type, expected)


def _with_covariance(topic: RecordedTopic) -> RecordedTopic:
    """Return a velocity through the water as the contract's type."""
    if topic.type != _WITHOUT_COVARIANCE:
        return topic
    messages = [data if data is None else bytes(data) + bytes(_COVARIANCE) for data in topic.messages]
    return dataclasses.replace(topic, type=topics.WATER_VELOCITY.type, messages=messages)
