"""What the driver hands on to the vehicle: the newest commands, or a stop. ROS-free."""

from __future__ import annotations

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState, MissionWord
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import STOP, Command
from auv_sim.nodes.mavlink.mapping import CommandLimits

#: States of the mission in which no command moves the vehicle, from any sender.
_OVER = (MissionState.HOLDING, MissionState.COMPLETE, MissionState.ABORTED)
#: A command may miss the stop by rounding.
_ROUNDING = 1e-9


class Commands:
    """Keeps the newest rudder and thrust.

    Args:
        limits: what the vehicle can do.
        timeout: age beyond which a command is a stop, s of ROS time.
    """

    def __init__(self, limits: CommandLimits, timeout: float) -> None:
        self._range = {
            topics.RUDDER_CMD.name: (-limits.rudder, limits.rudder),
            topics.THRUST_CMD.name: (0.0, limits.thrust),
        }
        self._timeout = timeout * 1e9
        self._newest: dict[str, tuple[float, int]] = {}
        self._mission = MissionWord()

    def put(self, topic: str, value: float, now: int) -> bool:
        """Take in a command; whether a pair is complete: the autopilot sends the thrust last.

        Raises:
            MessageRefused: beyond what the vehicle can do.
        """
        lowest, highest = self._range[topic]
        if not lowest - _ROUNDING <= value <= highest + _ROUNDING:
            raise MessageRefused(topic, f"{value:g}", f"from {lowest:g} to {highest:g}")
        self._newest[topic] = value, now
        return topic == topics.THRUST_CMD.name and topics.RUDDER_CMD.name in self._newest

    def mission_is(self, state: str, wall: float) -> None:
        """Take in `mission_state`, at a steady time in s.

        Raises:
            MessageRefused: there is no such state, or an earlier one was contradicted.
        """
        refused = self._mission.hear(state, wall)
        if refused is not None:
            raise refused

    def silent(self, now: int) -> bool:
        """Whether one of the two has fallen silent, once any has come."""
        arrivals = [self._newest.get(topic, (0.0, 0))[1] for topic in self._range]
        return bool(self._newest) and min(arrivals) < now - self._timeout

    def none_since(self, now: int) -> bool:
        """Whether both have fallen silent, once any has come."""
        return bool(self._newest) and max(at for _, at in self._newest.values()) < now - self._timeout

    def command(self, now: int, wall: float) -> Command:
        """The newest commands; a stop when one of them is silent or the mission is over.

        Args:
            now: ROS time, ns.
            wall: steady time, s.
        """
        if self._mission.at(wall) in _OVER or self.silent(now):
            return STOP
        return Command(*(self._newest.get(topic, (0.0, 0))[0] for topic in self._range))
