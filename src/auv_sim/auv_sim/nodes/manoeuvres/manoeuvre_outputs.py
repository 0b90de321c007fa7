"""What `manoeuvres` publishes in place of guidance and autopilot: commands and the mission's state."""

from __future__ import annotations

import math
import time

from std_msgs.msg import String

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import PERIOD, TIMES, MissionState
from auv_msgs_py.contract.wire import Float64
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.node.watch import second_publishers
from auv_msgs_py.values.types import SpatialCommand
from auv_path_following.nodes.readings import readings_of
from auv_path_following.vehicle import Vehicle


class ManoeuvreOutputs:
    """The publishers of the commands and of the mission's state.

    Args:
        node: that publishes.
        vehicle: whose commands they are.
    """

    def __init__(self, node: SuiteNode, vehicle: Vehicle) -> None:
        self._node, self._dives = node, vehicle.dives
        commands = readings_of(vehicle).commands
        self._outputs = [(node.advertise(topic), Float64()) for topic in commands]
        self._state = node.advertise(topics.MISSION_STATE)
        self._names = [topic.name for topic in (*commands, topics.MISSION_STATE)]
        self._word, self._repeated = MissionState.IDLE, -math.inf

    def others(self) -> str:
        """Return which of the topics another node publishes too, even one of this name; empty: none."""
        return second_publishers(self._node, self._names, of_one_name=True)

    def send(self, command: SpatialCommand) -> None:
        """Publish commands; a vehicle in the plane has no planes."""
        rudder, planes, thrust = command
        values = (rudder, planes, thrust) if self._dives else (rudder, thrust)
        for (publisher, message), value in zip(self._outputs, values, strict=True):
            message.data = value
            publisher.publish(message)

    def say(self, word: MissionState) -> None:
        """Publish the state, a new one `TIMES` times: drivers obey no command of a mission that is over."""
        count = TIMES if word is not self._word else 1
        self._word, self._repeated = word, time.monotonic()
        for _ in range(count):
            self._state.publish(String(data=word.value))

    def repeat(self) -> None:
        """Publish the state once more when it is due."""
        if time.monotonic() - self._repeated > PERIOD:
            self.say(self._word)
