"""Messages of a recorded topic as objects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.recording import RecordedTopic


def deserializer(topic: RecordedTopic) -> Callable[[bytes], Any]:
    """Return a decoder for messages of a topic, by ROS 2 Jazzy's definitions or the bag's own.

    Raises:
        ConfigurationError: the type is in neither.
    """
    store = typestore()
    if topic.type not in store.fielddefs:
        store = get_typestore(Stores.ROS2_JAZZY)
        try:
            if topic.encoding == "ros2msg":
                types = get_types_from_msg(topic.definition, topic.type)
            else:
                types = get_types_from_idl(topic.definition)
            store.register({name: kind for name, kind in types.items() if name not in store.fielddefs})
            store.fielddefs[topic.type]
        except Exception:
            # A damaged definition makes the parser raise any exception.
            raise ConfigurationError(
                topic.name, f"the type {topic.type or 'of no name'}", "a type whose definition is known"
            ) from None
    return lambda data: store.deserialize_cdr(data, topic.type)
