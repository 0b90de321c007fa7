"""The autopilots of a vehicle that dives, and the choice by the vehicle."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.values.types import SPATIAL_STOP, SpatialReference
from auv_path_following.control import fin_watch
from auv_path_following.control.diving_autopilot import SpatialAutopilot
from auv_path_following.nodes.readings import SPATIAL
from auv_path_following.nodes.steering import PlanarSteering
from auv_path_following.parameters import AutopilotParameters
from auv_path_following.vehicle import Vehicle


class SpatialSteering(PlanarSteering):
    """The autopilots of a vehicle that dives, in one executable.

    Heading and pitch share odometry, references, thrust and the rule for stopping, so that both fins stop
    together, and a step has no further process.
    """

    commands = SPATIAL.commands
    watched = (topics.STERNPLANE_STATE,)
    stop = SPATIAL_STOP

    def __init__(self, vehicle: Vehicle, parameters: AutopilotParameters) -> None:
        super().__init__(vehicle, parameters)
        self._fin = fin_watch.NEUTRAL
        self._watch_for(parameters)
        self.references |= {topics.DESIRED_PITCH: 1.6, topics.DESIRED_PITCH_RATE: 10.0}

    def _made(self, parameters: AutopilotParameters) -> Any:
        return SpatialAutopilot(self.vehicle, parameters.autopilot, parameters.pitch)

    def _watch_for(self, parameters: AutopilotParameters) -> None:
        assert self.vehicle.sternplanes is not None
        self._watch = fin_watch.prepare(parameters.planes, self.vehicle.sternplanes)

    def configure(self, parameters: AutopilotParameters) -> None:
        self._autopilot.configure(parameters.autopilot, parameters.pitch)
        self._watch_for(parameters)

    def watch(self, command: Any, dt: float) -> str:
        self._fin, *wrong = fin_watch.watch_fin(self._watch, self._fin, command.sternplanes, self.planes, dt)
        return fin_watch.complaint(*wrong)

    def reference(self, values: tuple[float, ...]) -> Any:
        yaw, yaw_rate, thrust, pitch, pitch_rate = values
        return SpatialReference(flip_yaw(yaw), -yaw_rate, -pitch, -pitch_rate, thrust)

    def update(self, navigation: Any, reference: Any, dt: float) -> Any:
        return self._autopilot.update(navigation, reference, dt)


def steering_of(vehicle: Vehicle, parameters: AutopilotParameters) -> PlanarSteering:
    """Return the autopilot of a vehicle.

    Raises:
        ConfigurationError: the gains do not fit the vehicle.
    """
    return (SpatialSteering if vehicle.dives else PlanarSteering)(vehicle, parameters)
