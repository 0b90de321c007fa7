"""The changes of parameters in a recording, as /parameter_events has them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import nanoseconds
from auv_msgs_py.settings.schema import flattened, nested, validated
from auv_sim.bags.reading.load import messages_of
from auv_sim.bags.reading.recording import Bag
from auv_sim.sim_parameters import SUITE

PARAMETER_EVENTS = "parameter_events"
#: Parameters that name the mission.
MISSION_NAMES = ("mission", "mission_text", "start_at")
#: rcl_interfaces/msg/ParameterType -> the field of a value.
_FIELDS = {1: "bool_value", 2: "integer_value", 3: "double_value", 4: "string_value", 9: "string_array_value"}


class Change(NamedTuple):
    """Parameters of one node that were changed at once.

    Attributes:
        stamp: time of the node, ns: in lockstep that of the last odometry that it had answered.
        log_ns: time of the recorder.
        node: its name.
        values: parameter -> new value.
    """

    stamp: int
    log_ns: int
    node: str
    values: dict[str, Any]

    def is_before(self, stamp: int, log_ns: int, lockstep: bool) -> bool:
        """Return whether the change was made before the odometry of a stamp and a time of recording, ns."""
        return self.stamp < stamp if lockstep else self.log_ns < log_ns


def changes_in(bag: Bag, namespace: str | None) -> list[Change]:
    """Return the changes of the pilot's nodes, in their order."""
    topic, odometry = bag.find(PARAMETER_EVENTS), bag.find(topics.ODOM.name, namespace)
    if topic is None or odometry is None:
        return []
    place = odometry.name.rsplit("/", 1)[0]
    found = []
    for log_ns, event in messages_of(topic):
        space, _, node = str(event.node).rpartition("/")
        if space == place and node in SUITE and event.changed_parameters:
            values = {one.name: _value(one.value) for one in event.changed_parameters}
            found.append(Change(nanoseconds(event.stamp), log_ns, node, values))
    return found


def changed(settings: Any, values: dict[str, Any]) -> Any:
    """Return the settings of a node with changed parameters; names that it does not have are left out.

    Raises:
        ConfigurationError: a value is not one of this version.
    """
    flat = flattened(settings)
    return validated(
        type(settings), nested(flat | {k: v for k, v in values.items() if k in flat}), "recorded"
    )


def chosen(changes: Iterable[Change], gains: bool, mission: bool) -> list[Change]:
    """Return the changes of gains, if they are asked for, and of the mission, if those are."""
    found = []
    for change in changes:
        values = {
            name: value
            for name, value in change.values.items()
            if (mission if name in MISSION_NAMES else gains)
        }
        if values:
            found.append(change._replace(values=values))
    return found


def _value(value: Any) -> Any:
    found = getattr(value, _FIELDS.get(int(value.type), "string_value"))
    return tuple(found) if int(value.type) == 9 else found
