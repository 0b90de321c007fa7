"""The heading autopilot: derives what a controller needs and is the last guard before the rudder."""

from __future__ import annotations

import dataclasses
import math
from typing import Literal, NamedTuple

from auv_msgs_py.angles import wrap
from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import STOP, Command, Navigation, Reference
from auv_path_following.control.controller import HeadingController, HeadingInputs
from auv_path_following.control.derivative import Derivative, DerivativeConfig
from auv_path_following.control.nism import Nism, NismConfig, kp_of
from auv_path_following.control.pid import Pid, PidConfig
from auv_path_following.control.reference_model import ReferenceConfig, ReferenceModel
from auv_path_following.control.smc import Smc, SmcConfig
from auv_path_following.vehicle import Vehicle


@settings
class AutopilotConfig:
    """Which controller, its gains, and whether its reference is shaped."""

    controller: Literal["nism", "pid", "smc"] = setting("nism", "heading controller: nism, pid or smc")
    nism: NismConfig = setting(factory=NismConfig, doc="NISM")
    pid: PidConfig = setting(factory=PidConfig, doc="PID")
    smc: SmcConfig = setting(factory=SmcConfig, doc="conventional sliding mode")
    derivative: DerivativeConfig = setting(factory=DerivativeConfig, doc="dr/dt from the measured yaw rate")
    reference: ReferenceConfig = setting(
        factory=ReferenceConfig, doc="what the controller is asked to follow"
    )


class AutopilotOutput(NamedTuple):
    """The command and the signals behind it (rad, s, NED)."""

    command: Command
    psi_e: float
    sigma_1: float
    sigma_2: float


class HeadingAutopilot:
    """Turns a reference into rudder and thrust.

    dr/dt comes from `Derivative`, d r_d/dt is the difference of what came in; a shaped reference knows its
    own. Outside a running mission (thrust 0) the rudder is neutral and the controller forgets, so that a new
    start begins clean.

    Args:
        vehicle: for the limits of rudder and thrust.
        config: controller and gains.

    Raises:
        ConfigurationError: gains that need what the vehicle's file does not have.
    """

    def __init__(self, vehicle: Vehicle, config: AutopilotConfig | None = None) -> None:
        self.vehicle = vehicle
        self.config = config or AutopilotConfig()
        self.controller: HeadingController = self._controller(self.config)
        self.derivative = Derivative(self.config.derivative)
        self.reference = ReferenceModel(self.config.reference, vehicle, self._rudder_rate(self.config))
        self.reset()

    def configure(self, config: AutopilotConfig) -> None:
        """Take new gains; the rudder stays where it is.

        Raises:
            ConfigurationError: as at the beginning; nothing has changed then.
        """
        controller = self.controller
        if config.controller != self.config.controller:
            controller = self._controller(config)
        self.reference.configure(config.reference, self._rudder_rate(config))
        # From here on nothing can fail.
        self.derivative.config = config.derivative
        match controller:
            case Nism():
                controller.config = self._nism(config)
            case Pid():
                controller.config = config.pid
            case Smc():
                controller.config = config.smc
        self.controller, self.config = controller, config

    def _controller(self, config: AutopilotConfig) -> HeadingController:
        match config.controller:
            case "pid":
                return Pid(config.pid, self.vehicle.rudder)
            case "smc":
                return Smc(config.smc, self.vehicle)
            case _:
                return Nism(self._nism(config), self.vehicle.rudder.max_angle)

    def _nism(self, config: AutopilotConfig) -> NismConfig:
        """NISM's gains, with kp from rudder and hull where that is asked for."""
        return dataclasses.replace(config.nism, kp=kp_of(config.nism, self.vehicle))

    def _rudder_rate(self, config: AutopilotConfig) -> float:
        """The fastest that the controller moves the rudder, rad/s."""
        limit, nism = self.vehicle.rudder.max_rate, self._nism(config)
        return min(nism.kp + nism.ks, limit) if config.controller == "nism" else limit

    def reset(self) -> None:
        """Forget all state."""
        self.controller.reset()
        self.derivative.reset()
        self.reference.reset()
        self._last: float | None = None

    def update(self, navigation: Navigation, reference: Reference, dt: float) -> AutopilotOutput:
        """One step.

        Args:
            navigation: measured heading and yaw rate, NED.
            reference: what guidance asks for; thrust 0 means that no mission is running.
            dt: seconds since the last update (0 on the first one).
        """
        psi_e = wrap(navigation.psi - reference.psi_d)
        if not reference.thrust > 0.0:  # NaN is no mission either
            self.reset()
            return AutopilotOutput(STOP, psi_e, 0.0, 0.0)
        r, r_d = navigation.r, reference.r_d
        r_d_dot = 0.0
        if self._last is None:
            dt = 0.0
        elif dt > 0.0:
            r_d_dot = (r_d - self._last) / dt
        self._last = r_d
        r_dot = self.derivative.update(r, dt)
        error = psi_e
        if self.config.reference.enabled:
            shaped = self.reference.update(navigation.psi, r, reference.psi_d, r_d, dt)
            error, r_d, r_d_dot = wrap(navigation.psi - shaped.psi_d), shaped.r_d, shaped.r_d_dot
        thrust = min(reference.thrust, self.vehicle.thrust_max)
        out = self.controller.update(HeadingInputs(error, r, r_dot, r_d, r_d_dot, thrust), dt)
        if not math.isfinite(out.rudder):
            self.reset()
            return AutopilotOutput(STOP, psi_e, out.sigma_1, out.sigma_2)
        rudder = min(max(out.rudder, -self.vehicle.rudder.max_angle), self.vehicle.rudder.max_angle)
        return AutopilotOutput(Command(rudder, thrust), psi_e, out.sigma_1, out.sigma_2)
