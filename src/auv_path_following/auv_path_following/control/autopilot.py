"""The heading autopilot: derives what a controller needs and is the last guard before the rudder."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from auv_msgs_py.angles import wrap
from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import STOP, Command, Navigation, Reference
from auv_path_following.control.controller import HeadingController, HeadingInputs
from auv_path_following.control.nism import Nism, NismConfig
from auv_path_following.vehicle import Vehicle


@settings
class AutopilotConfig:
    """Which controller, and its gains."""

    controller: Literal["nism"] = setting("nism", "heading controller")
    nism: NismConfig = setting(factory=NismConfig, doc="NISM")


class AutopilotOutput(NamedTuple):
    """The command and the signals behind it (rad, s, NED)."""

    command: Command
    psi_e: float
    sigma_1: float
    sigma_2: float


class HeadingAutopilot:
    """Turns a reference into rudder and thrust.

    dr/dt and d r_d/dt are differences of what came in. Outside a running mission (thrust 0) the
    rudder is neutral and the controller forgets, so that a new start begins clean.

    Args:
        vehicle: for the limits of rudder and thrust.
        config: controller and gains.
    """

    def __init__(self, vehicle: Vehicle, config: AutopilotConfig | None = None) -> None:
        self.vehicle = vehicle
        self.config = config or AutopilotConfig()
        self.controller: HeadingController = Nism(self.config.nism, vehicle.rudder.max_angle)
        self.reset()

    def configure(self, config: AutopilotConfig) -> None:
        """Take new gains; the rudder stays where it is."""
        self.config = config
        if isinstance(self.controller, Nism):
            self.controller.config = config.nism

    def reset(self) -> None:
        """Forget all state."""
        self.controller.reset()
        self._last: tuple[float, float] | None = None

    def update(self, navigation: Navigation, reference: Reference, dt: float) -> AutopilotOutput:
        """One step.

        Args:
            navigation: measured heading and yaw rate, NED.
            reference: what guidance asks for; thrust 0 means that no mission is running.
            dt: seconds since the last update (0 on the first one).
        """
        psi_e = wrap(navigation.psi - reference.psi_d)
        if reference.thrust <= 0.0:
            self.reset()
            return AutopilotOutput(STOP, psi_e, 0.0, 0.0)
        r, r_d = navigation.r, reference.r_d
        r_dot = r_d_dot = 0.0
        if self._last is None:
            dt = 0.0
        elif dt > 0.0:
            r_dot = (r - self._last[0]) / dt
            r_d_dot = (r_d - self._last[1]) / dt
        self._last = (r, r_d)
        out = self.controller.update(HeadingInputs(psi_e, r, r_dot, r_d, r_d_dot), dt)
        if not math.isfinite(out.rudder):
            self.reset()
            return AutopilotOutput(STOP, psi_e, out.sigma_1, out.sigma_2)
        rudder = min(max(out.rudder, -self.vehicle.rudder.max_angle), self.vehicle.rudder.max_angle)
        thrust = min(reference.thrust, self.vehicle.thrust_max)
        return AutopilotOutput(Command(rudder, thrust), psi_e, out.sigma_1, out.sigma_2)
