"""The commands in force until newer ones arrive. ROS-free."""

from __future__ import annotations

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import Command

_RUDDER, _THRUST = topics.RUDDER_CMD.name, topics.THRUST_CMD.name
#: Rounding by which a command may exceed a limit.
_ROUNDING = 1e-9


class HeldCommands:
    """Keeps the newest command of each kind and its time.

    Args:
        rudder: largest angle, rad.
        thrust: largest thrust, N.
    """

    def __init__(self, rudder: float, thrust: float) -> None:
        self._limits = {_RUDDER: (-rudder, rudder), _THRUST: (0.0, thrust)}
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

    def at(self, stamp: int, bound: float) -> tuple[Command, list[str]]:
        """Return the commands in force at `stamp` (ns), and the topics silent for more than `bound` s."""
        held = {name: self._held.get(name, (0.0, stamp)) for name in self._limits}
        silent = [name for name, (_, at) in held.items() if at < stamp - bound * 1e9]
        return Command(held[_RUDDER][0], held[_THRUST][0]), silent
