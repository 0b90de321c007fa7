"""How tightly a vehicle can turn: measured, or else found from its plant with the rudder hard over.

All forces of Eq. (19) grow with the square of the speeds, the thrust apart. So a steady turn at another
thrust is the same turn at another speed: its radius is a property of the hull and of the rudder's range.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.types import NO_CURRENT, Command
from auv_path_following.vehicle import Vehicle
from auv_sim.plant.remus import PlantState, RemusPlant

_STEP = 0.02
#: The longest time that a turn gets to become steady, in hull lengths travelled at the speed straight ahead.
_LENGTHS = 400.0
#: Steady: no acceleration is larger, as a share of what would change the state within a second.
_STEADY = 1e-9


class SteadyTurn(NamedTuple):
    """A steady turn with full rudder.

    Attributes:
        radius: of the vehicle's track, m.
        speed: through the water on it, m/s; NaN where the radius was measured.
        source: "measured" or "found from the hull".
    """

    radius: float
    speed: float
    source: str


def tightest_turn(vehicle: Vehicle) -> SteadyTurn:
    """The vehicle's tightest steady turn.

    The measured radius of the vehicle's file wins. Else the plant runs ahead with all its thrust and the
    rudder hard over, until speed, drift and rate of turn stand still.

    Args:
        vehicle: the vehicle.

    Raises:
        ConfigurationError: the hull's turn never becomes steady.
    """
    if vehicle.turning is not None:
        return SteadyTurn(vehicle.turning.radius, math.nan, "measured")
    ahead = vehicle.speed_at(vehicle.thrust_max)
    plant = RemusPlant(vehicle, PlantState(0.0, 0.0, 0.0, ahead, 0.0, 0.0), max_step=_STEP)
    rudder = vehicle.rudder.max_angle
    # Positive rudder is to port; by symmetry the other side turns alike.
    command = Command(rudder, vehicle.thrust_max)
    for _ in range(math.ceil(_LENGTHS * vehicle.length / ahead / _STEP)):
        plant.advance(command, _STEP)
        slope = plant.dynamics.derivative(plant.state, rudder, vehicle.thrust_max, NO_CURRENT)
        if plant.rudder.angle == rudder and max(map(abs, slope[3:])) <= _STEADY * ahead:
            speed = math.hypot(plant.state.ur, plant.state.vr)
            return SteadyTurn(speed / abs(plant.state.r), speed, "found from the hull")
    raise ConfigurationError(
        f"{vehicle.name}: hull",
        "a turn with full rudder that never becomes steady",
        "a measured radius: turning: {radius: ...}",
    )
