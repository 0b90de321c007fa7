"""What the driver hands on to the vehicle: the newest commands, or a stop. ROS-free; times in ns."""

from __future__ import annotations

from auv_msgs_py import topics
from auv_msgs_py.errors import MessageRefused
from auv_msgs_py.types import STOP, Command
from auv_sim.drivers.mavlink_mapping import Limits

#: States of the mission in which no command moves the vehicle, from any sender.
_OVER = ("holding", "complete", "aborted")
#: A command may miss the stop by rounding.
_ROUNDING = 1e-9


class Commands:
    """Keeps the newest rudder and thrust.

    Args:
        limits: what the vehicle can do.
        timeout: age beyond which a command is a stop, s.
    """

    def __init__(self, limits: Limits, timeout: float) -> None:
        self._range = {
            topics.RUDDER_CMD.name: (-limits.rudder, limits.rudder),
            topics.THRUST_CMD.name: (0.0, limits.thrust),
        }
        self._timeout = timeout * 1e9
        self._newest: dict[str, tuple[float, int]] = {}
        self.mission_over = False

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

    def mission_is(self, state: str) -> None:
        """Take in `mission_state`."""
        self.mission_over = state in _OVER

    def silent(self, now: int) -> bool:
        """Whether one of the two has fallen silent, once any has come."""
        arrivals = [self._newest.get(topic, (0.0, 0))[1] for topic in self._range]
        return bool(self._newest) and min(arrivals) < now - self._timeout

    def none_since(self, now: int) -> bool:
        """Whether both have fallen silent, once any has come."""
        return bool(self._newest) and max(at for _, at in self._newest.values()) < now - self._timeout

    def command(self, now: int) -> Command:
        """The newest commands; a stop when one of them is silent or the mission is over."""
        if self.mission_over or self.silent(now):
            return STOP
        return Command(*(self._newest.get(topic, (0.0, 0))[0] for topic in self._range))
