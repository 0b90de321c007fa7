"""All subscriptions of the console: vehicles by their namespaces, and the topics that all nodes share."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rclpy.node import Node

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import MessageRefused, printable
from auv_sim.nodes.console.parameter_desk import NOT_SHOWN, plain_value
from auv_sim.nodes.console.vehicle_feed import PolledReader, VehicleFeed
from auv_sim.views.console.record.fault_log import FaultLog
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.record.wire_messages import text_of

#: Between two looks for vehicles, s.
_LOOK = 1.0
#: Most messages of a shared topic that are taken at a poll: a flood of them must not delay an abort.
MOST_AT_ONCE = 40
#: Depths of the queues of topics that all nodes publish.
_LOG_DEPTH, _DEPTH = 200, 100
_ROSOUT = Topic("/rosout", "rcl_interfaces/msg/Log", "every node", latched=True)
_PARAMETER_EVENTS = Topic("/parameter_events", "rcl_interfaces/msg/ParameterEvent", "every node")
_INFO = 20
_LEVELS = ((40, "error"), (30, "warning"))
#: A namespace with this topic is a vehicle.
_SIGN = f"/{topics.MISSION_STATE.name}"


class GraphFeed:
    """Hears all vehicles of the domain, or those of given namespaces.

    Args:
        node: of the console.
        namespaces: to hear; empty for all that are discovered.
        tracks: directory of kept tracks; None keeps none.
        domain: ROS domain.
        discovered: called with each new vehicle.
        publish: sends a message to every browser.
        faults: logs what fails.
    """

    def __init__(
        self, node: Node, namespaces: tuple[str, ...], tracks: Path | None, domain: int,
        discovered: Callable[[VehicleFeed], None], publish: Callable[[list[str | bytes]], None],
        faults: FaultLog,
    ) -> None:  # fmt: skip
        self._node, self._tracks, self._domain = node, tracks, domain
        self._discovered, self._publish = discovered, publish
        self._only, self._faults = namespaces, faults
        self.records: list[VehicleRecord] = []
        self._feeds: dict[str, VehicleFeed] = {}
        self._looked_at = -_LOOK
        shared: tuple[tuple[Topic, int, Callable[[Any], None]], ...] = (
            (topics.DIAGNOSTICS, _DEPTH, self._on_diagnostics),
            (_ROSOUT, _LOG_DEPTH, self._on_log),
            (_PARAMETER_EVENTS, _DEPTH, self._on_parameters),
        )
        self._shared = [(PolledReader(node, topic, topic.name, n), read) for topic, n, read in shared]
        for namespace in namespaces:
            self._add(namespace)

    def poll(self) -> None:
        """Take what has arrived."""
        now = time.monotonic()
        if now - self._looked_at >= _LOOK:
            self._looked_at = now
            with self._faults.guard("the look for vehicles"):
                self._look_for_vehicles()
        for feed in self._feeds.values():
            feed.poll()
        for polled, read in self._shared:
            self._take(polled, read)
        for feed in self._feeds.values():
            with self._faults.guard(f"{feed.record.namespace} course"):
                feed.course.look()

    def _take(self, polled: PolledReader, read: Callable[[Any], None]) -> None:
        """Read at most `MOST_AT_ONCE` messages of a topic."""
        for _ in range(MOST_AT_ONCE):
            with self._faults.guard(read.__name__), contextlib.suppress(MessageRefused):
                message = polled.take()
                if message is None:
                    return
                read(message)

    def _look_for_vehicles(self) -> None:
        if self._only:
            return
        for name, types in self._node.get_topic_names_and_types():
            if name.endswith(_SIGN) and topics.MISSION_STATE.type in types:
                namespace = name.removesuffix(_SIGN) or "/"
                if namespace not in self._feeds:
                    self._add(namespace)

    def _add(self, namespace: str) -> None:
        record = VehicleRecord(len(self.records), namespace, self._tracks)
        feed = VehicleFeed(self._node, record, self._domain, time.monotonic, self._faults)
        self.records.append(record)
        self._feeds[namespace] = feed
        self._discovered(feed)

    def _of(self, full_name: str) -> tuple[VehicleRecord | None, str]:
        """Return the vehicle of a node, and the node's own name."""
        namespace, _, name = full_name.rpartition("/")
        feed = self._feeds.get(namespace or "/")
        return (feed.record if feed else None), name

    def _on_diagnostics(self, message: Any) -> None:
        for status in message.status:
            record, name = self._of(status.name)
            if record is not None:
                level = status.level[0] if isinstance(status.level, bytes) else int(status.level)
                record.health.hear(name, level, printable(status.message), time.monotonic())

    def _on_log(self, message: Any) -> None:
        if message.level < _INFO:
            return
        record, name = self._of("/" + message.name.replace(".", "/"))
        if record is None:
            return
        level = next((word for least, word in _LEVELS if message.level >= least), "info")
        wall = message.stamp.sec + message.stamp.nanosec * 1e-9
        record.events.add(printable(message.msg), name, level, record.progress.mission_time, wall)

    def _on_parameters(self, event: Any) -> None:
        record, name = self._of(event.node)
        if record is None:
            return
        for parameter in (*event.new_parameters, *event.changed_parameters):
            if parameter.name.startswith(NOT_SHOWN):  # a mission's text is long, and no gain
                continue
            value = plain_value(parameter.value)
            message = text_of(
                "parameters_changed", vehicle=record.index, node=name, name=parameter.name, value=value
            )
            self._publish([message])
