"""The commands that the driver forwards: the newest, or a stop. ROS-free."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState, MissionWord
from auv_msgs_py.values.errors import MessageRefused
from auv_sim.nodes.held_commands import Orders

#: States of the mission in which no command moves the vehicle, whatever its sender.
_OVER = (MissionState.HOLDING, MissionState.COMPLETE, MissionState.ABORTED)
#: Rounding by which a command may exceed a limit.
_ROUNDING = 1e-9


class Commands:
    """Keeps the newest command of each kind.

    Args:
        orders: the vehicle's commands and their limits.
        timeout: age beyond which a command is a stop, s of ROS time.
    """

    def __init__(self, orders: Orders, timeout: float) -> None:
        self._range, self._stop = orders.limits, orders.stop
        self._timeout = timeout * 1e9
        self._newest: dict[str, tuple[float, int]] = {}
        self._mission = MissionWord()

    def put(self, topic: str, value: float, now: int) -> bool:
        """Keep a command; return whether all are there, since the autopilot sends the thrust last.

        Raises:
            MessageRefused: beyond the vehicle's limits.
        """
        lowest, highest = self._range[topic]
        if not lowest - _ROUNDING <= value <= highest + _ROUNDING:
            raise MessageRefused(topic, f"{value:g}", f"from {lowest:g} to {highest:g}")
        self._newest[topic] = value, now
        return topic == topics.THRUST_CMD.name and len(self._newest) == len(self._range)

    def mission_is(self, state: str, wall: float) -> None:
        """Process `mission_state` that arrived at `wall`, s of steady time.

        Raises:
            MessageRefused: no such state, or it contradicts an earlier one.
        """
        refused = self._mission.hear(state, wall)
        if refused is not None:
            raise refused

    def silent(self, now: int) -> bool:
        """Return whether one of the commands is overdue, once any has arrived."""
        arrivals = [self._newest.get(topic, (0.0, 0))[1] for topic in self._range]
        return bool(self._newest) and min(arrivals) < now - self._timeout

    def none_since(self, now: int) -> bool:
        """Return whether all commands are overdue, once any has arrived."""
        return bool(self._newest) and max(at for _, at in self._newest.values()) < now - self._timeout

    def command(self, now: int, wall: float) -> Any:
        """Return the newest commands; a stop when one of them is overdue or the mission is over.

        Args:
            now: ROS time, ns.
            wall: steady time, s.
        """
        if self._mission.at(wall) in _OVER or self.silent(now):
            return self._stop
        return type(self._stop)(*(self._newest.get(topic, (0.0, 0))[0] for topic in self._range))
