"""The commands in force until newer ones arrive, or one is overdue. ROS-free."""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState, MissionWord
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SPATIAL_STOP, STOP
from auv_path_following.vehicle import Vehicle

#: States of a mission in which no command moves the vehicle, whatever its sender.
_OVER = (MissionState.HOLDING, MissionState.COMPLETE, MissionState.ABORTED)
#: Rounding by which a command may exceed a limit.
_ROUNDING = 1e-9


class Orders(NamedTuple):
    """The commands of one kind of vehicle.

    Attributes:
        limits: topic -> lowest and highest value (rad, N), in the order of a command's fields.
        stop: the command without thrust.
    """

    limits: dict[str, tuple[float, float]]
    stop: Any


def orders_of(vehicle: Vehicle) -> Orders:
    """Return the commands that a vehicle obeys."""
    fins = {topics.RUDDER_CMD.name: vehicle.rudder}
    if vehicle.sternplanes is not None:
        fins[topics.STERNPLANE_CMD.name] = vehicle.sternplanes
    limits = {name: (-fin.max_angle, fin.max_angle) for name, fin in fins.items()}
    limits[topics.THRUST_CMD.name] = (0.0, vehicle.thrust_max)
    return Orders(limits, SPATIAL_STOP if vehicle.dives else STOP)


class HeldCommands:
    """Keeps the newest command of each kind; the vehicle stops where one is overdue or the mission is over.

    Args:
        orders: the commands and their limits.

    Attributes:
        mission: the state of the mission by its messages.
    """

    def __init__(self, orders: Orders) -> None:
        self._limits, self._stop = orders.limits, orders.stop
        self._held: dict[str, tuple[float, int]] = {}
        self.mission = MissionWord()

    @property
    def is_complete(self) -> bool:
        """Whether a command of each kind has arrived."""
        return len(self._held) == len(self._limits)

    def clear(self) -> None:
        """Forget all commands."""
        self._held.clear()

    def put(self, topic: str, value: float, now: int) -> None:
        """Keep a command that arrives at `now`, ns.

        Raises:
            MessageRefused: it is beyond the actuator's limits, or NaN.
        """
        lowest, highest = self._limits[topic]
        if not lowest - _ROUNDING <= value <= highest + _ROUNDING:  # NaN fails this
            raise MessageRefused(topic, f"{value:g}", f"from {lowest:g} to {highest:g}")
        self._held[topic] = value, now

    def silent(self, now: int, timeout: float) -> list[str]:
        """Return the topics whose newest command is older than `timeout` s at `now`, ns.

        A kind that has never been commanded is neutral, not silent: a simulator may be flown by thrust alone.
        An arrival after `now` is that of a clock which was set back, and counts as old.
        """
        return [name for name, (_, at) in self._held.items() if abs(now - at) > timeout * 1e9]

    def in_force(self, now: int, timeout: float, wall: float) -> Any:
        """Return the newest commands; a stop where one is overdue or the mission is over.

        Args:
            now: time of the arrivals' clock, ns.
            timeout: age beyond which a command is overdue, s.
            wall: steady time of the messages of the mission, s.
        """
        if self.mission.at(wall) in _OVER or self.silent(now, timeout):
            return self._stop
        return type(self._stop)(*(self._held.get(name, (0.0, 0))[0] for name in self._limits))

    def complaint(self, now: int, timeout: float) -> str:
        """Return the line for `/diagnostics`; empty where no command is overdue."""
        silent = self.silent(now, timeout)
        return f"no {', '.join(silent)} for {timeout:g} s: stopped" if silent else ""
