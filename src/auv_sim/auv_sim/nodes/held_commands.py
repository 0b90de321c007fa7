"""The commands in force until newer ones arrive. ROS-free."""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SPATIAL_STOP, STOP
from auv_path_following.vehicle import Vehicle

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
    """Keeps the newest command of each kind and its time.

    Args:
        orders: the commands and their limits.
    """

    def __init__(self, orders: Orders) -> None:
        self._limits, self._command = orders.limits, type(orders.stop)
        self._held: dict[str, tuple[float, int]] = {}

    def clear(self) -> None:
        """Forget all commands."""
        self._held.clear()

    def put(self, topic: str, value: float, stamp: int) -> None:
        """Keep a command of time `stamp`, ns.

        Raises:
            MessageRefused: it is beyond the actuator's limits, or NaN.
        """
        lowest, highest = self._limits[topic]
        if not lowest - _ROUNDING <= value <= highest + _ROUNDING:  # NaN fails this
            raise MessageRefused(topic, f"{value:g}", f"from {lowest:g} to {highest:g}")
        self._held[topic] = value, stamp

    def at(self, stamp: int, bound: float) -> tuple[Any, list[str]]:
        """Return the commands in force at `stamp` (ns), and the topics silent for more than `bound` s."""
        held = {name: self._held.get(name, (0.0, stamp)) for name in self._limits}
        silent = [name for name, (_, at) in held.items() if at < stamp - bound * 1e9]
        return self._command(*(value for value, _ in held.values())), silent
