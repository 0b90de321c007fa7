"""The autopilot's references: received, checked, and compared with the mission's state."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import finite
from auv_msgs_py.contract.mission_word import MissionState, MissionWord
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.contract.wire import Float64
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import MessageRefused
from auv_path_following.control.reference_watch import ReferenceWatch
from auv_path_following.nodes.steering import PlanarSteering

if TYPE_CHECKING:
    from std_msgs.msg import String


class ReferenceInput:
    """Subscribe to the references and to the mission's state.

    Args:
        node: the autopilot.
        steering: the references that it needs, and their bounds.
        put: called with topic and value of each reference.
        starts: called when a mission starts, only free running.
        stopped: consequence of a stop, for the diagnostics.
    """

    def __init__(
        self,
        node: SuiteNode,
        steering: PlanarSteering,
        put: Callable[[str, float], None],
        starts: Callable[[], None],
        stopped: str,
    ) -> None:
        self._node, self._put, self._starts, self._stopped = node, put, starts, stopped
        self._steering = steering
        self._watch = ReferenceWatch()
        self._missing = ""
        self.mission = MissionWord()
        for topic in steering.references:
            node.listen(topic, self._on_reference(topic))
        node.listen(topics.MISSION_STATE, self._on_mission_state)

    def take(self, values: tuple[float | None, ...]) -> None:
        """Take guidance's answer to one odometry; None for a missing reference."""
        parts = zip(self._steering.references, values, strict=True)
        missing = [topic.name for topic, value in parts if value is None]
        if missing:
            self._missing = ", ".join(missing)
        else:
            self._watch.put(self._steering.reference(values), self._node.now())  # type: ignore[arg-type]

    def obeyed(self) -> Any | None:
        """Return the reference to follow; None: stop."""
        watch, p = self._watch, self._node.parameters
        if p.lockstep:
            return watch.newest
        word = self.mission.at(time.monotonic())
        reference = watch.allowed(self._node.now(), word, p.reference_timeout)
        silent = f"guidance is silent (no {self._missing}): {self._stopped}" if watch.silent else ""
        self._node.health.error("guidance", silent)
        odd = watch.contradiction
        text = f"{topics.DESIRED_THRUST.name} {odd}: {self._stopped}" if odd else ""
        self._node.health.error("interlock", text)
        return reference

    def _on_reference(self, topic: Topic) -> Callable[[Float64], None]:
        largest = self._steering.references[topic]

        def callback(message: Float64) -> None:
            value = finite(message.data, topic.name)
            if abs(value) > largest:
                raise MessageRefused(topic.name, f"{value:g}", f"from {-largest:g} to {largest:g}")
            self._put(topic.name, value)

        return callback

    def _on_mission_state(self, message: String) -> None:
        now = time.monotonic()
        before = self.mission.at(now)
        refused = self.mission.hear(message.data, now)
        was_under_way = before in (MissionState.RUNNING, MissionState.HOLDING)
        starts = message.data == MissionState.RUNNING and not was_under_way
        if starts and not self._node.parameters.lockstep:
            self._starts()
        if refused is not None:
            raise refused
