"""The autopilot of the node: references to rudder and thrust."""

from __future__ import annotations

import math
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.types import STOP, Reference
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.nodes.readings import PLANAR
from auv_path_following.parameters import AutopilotParameters
from auv_path_following.vehicle import Vehicle


class PlanarSteering:
    """The heading autopilot of a planar vehicle.

    Args:
        vehicle: hull and rudder.
        parameters: gains.

    Attributes:
        references: topic -> largest magnitude beyond any request of guidance (rad, rad/s, N).
        commands: topics in the order of a command's fields.
        watched: topics of measured angles.
        planes: measured angle of the stern planes, rad; NaN: not measured.
        stop: the command without thrust.

    Raises:
        ConfigurationError: the gains do not fit the vehicle.
    """

    commands: tuple[Topic, ...] = PLANAR.commands
    watched: tuple[Topic, ...] = ()
    planes = math.nan
    stop: Any = STOP

    def __init__(self, vehicle: Vehicle, parameters: AutopilotParameters) -> None:
        self.vehicle = vehicle
        self.references = {
            topics.DESIRED_YAW: 6.5,
            topics.DESIRED_YAW_RATE: 10.0,
            topics.DESIRED_THRUST: 10.0 * vehicle.thrust_max,
        }
        self._autopilot: Any = self._made(parameters)

    def _made(self, parameters: AutopilotParameters) -> Any:
        return HeadingAutopilot(self.vehicle, parameters.autopilot)

    @property
    def config(self) -> Any:
        """Configuration of the autopilot."""
        return self._autopilot.config

    def validate(self, parameters: AutopilotParameters) -> None:
        """Refuse gains that do not fit the vehicle.

        Raises:
            ConfigurationError: a gain needs values that the vehicle's file does not have.
        """
        self._made(parameters)

    def configure(self, parameters: AutopilotParameters) -> None:
        """Take new gains."""
        self._autopilot.configure(parameters.autopilot)

    def reset(self) -> None:
        """Reset the state."""
        self._autopilot.reset()

    def reference(self, values: tuple[float, ...]) -> Any:
        """Return the reference (NED) of the messages, in the order of `references`."""
        yaw, rate, thrust = values
        return Reference(flip_yaw(yaw), -rate, thrust)

    def watch(self, command: Any, dt: float) -> str:
        """Return what is wrong with the fins under a command; empty: nothing. `dt` in s."""
        return ""

    def update(self, navigation: Any, reference: Any, dt: float) -> Any:
        """Return the command for a measurement; `dt` in s."""
        return self._autopilot.update(navigation, reference, dt).command
