"""The heading autopilot: inputs for the controller, and the limits of rudder and thrust."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from auv_msgs_py.settings.schema import setting
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import bounded, numbers_of, pure
from auv_msgs_py.values.types import STOP, Command, Navigation, Reference
from auv_path_following.control import nism, pid, reference_model, smc
from auv_path_following.control.controller import HeadingInputs
from auv_path_following.control.derivative import DerivativeConfig, DerivativeState, derivative
from auv_path_following.control.reference_model import (
    ReferenceConfig,
    ReferenceState,
    Shaping,
    shape,
)
from auv_path_following.registry import chosen_step, law_of, law_settings
from auv_path_following.vehicle import Vehicle

#: The heading controllers; the first is the default.
CONTROLLERS = (nism.LAW, pid.LAW, smc.LAW)


@law_settings("controller", "heading controller", CONTROLLERS)
class AutopilotConfig:
    """Which controller, its gains, and whether its reference is shaped."""

    derivative: DerivativeConfig = setting(factory=DerivativeConfig, doc="dr/dt from the measured yaw rate")
    reference: ReferenceConfig = setting(factory=ReferenceConfig, doc="shape of the controller's reference")

    if TYPE_CHECKING:  # the choice and the laws' own settings

        def __init__(self, **fields: Any) -> None: ...
        def __getattr__(self, name: str) -> Any: ...


controller_step = chosen_step(CONTROLLERS)


class Autopilot(NamedTuple):
    """Configuration: the chosen controller with its first state, filter, reference, and the vehicle's limits.

    Attributes:
        controller, controller_begins: configuration and first state of the chosen law.
        derivative, reference: of the filter behind dr/dt and of the reference model.
        max_angle: rad.
        thrust_max: N.
    """

    controller: Any
    controller_begins: Any
    derivative: Any
    reference: Shaping
    max_angle: float
    thrust_max: float


def prepare(config: AutopilotConfig, vehicle: Vehicle) -> Autopilot:
    """Return the autopilot's configuration.

    Args:
        config: controller, gains and reference.
        vehicle: hull, rudder and thruster that the autopilot assumes.

    Raises:
        ConfigurationError: the gains need values that the vehicle's file does not have.
    """
    law = law_of(CONTROLLERS, config.controller)
    controller = law.prepare(getattr(config, law.name), vehicle)
    rudder_rate = vehicle.rudder.max_rate
    if isinstance(controller, nism.Nism):
        rudder_rate = min(controller.gains.kp + controller.gains.ks, rudder_rate)
    return Autopilot(
        controller,
        law.initial,
        numbers_of(config.derivative),
        reference_model.prepare(config.reference, vehicle, rudder_rate),
        vehicle.rudder.max_angle,
        float(vehicle.thrust_max),
    )


class AutopilotState(NamedTuple):
    """Whether it has started, the last r_d (rad/s), and the states of filter, reference and controller."""

    begun: bool
    r_d: float
    derivative: DerivativeState
    reference: ReferenceState
    controller: Any


#: psi_e (rad), sigma_1 (rad/s) and sigma_2 (rad/s^2) of the controller.
Signals = tuple[float, float, float]


class AutopilotOutput(NamedTuple):
    """The command and the signals behind it (rad, s, NED)."""

    command: Command
    psi_e: float
    sigma_1: float
    sigma_2: float


@pure
def first_state(config: Autopilot) -> AutopilotState:
    """Return the state before the first measurement: the rudder is neutral."""
    return AutopilotState(
        False,
        0.0,
        DerivativeState(False, 0.0, 0.0, 0.0),
        ReferenceState(False, 0.0, 0.0, 0.0),
        config.controller_begins,
    )


@pure
def steer(
    config: Autopilot, state: AutopilotState, navigation: Navigation, reference: Reference, dt: float
) -> tuple[AutopilotState, Command, Signals]:
    """Turn a reference into rudder and thrust.

    dr/dt comes from `derivative`, d r_d/dt from differences of the inputs or from the shaped reference.
    Outside a running mission (thrust 0) the rudder is neutral and the controller is reset. A rudder angle
    that is not finite is a stop.

    Args:
        config: of controller, filter and reference.
        state: of the last step.
        navigation: measured heading and yaw rate, NED.
        reference: from guidance; thrust 0: no mission is running.
        dt: seconds since the last step (0 on the first one).
    """
    begun, last_r_d, slope, shaped, controller = state
    psi_e = wrap(navigation.psi - reference.psi_d)
    if not reference.thrust > 0.0:  # NaN is no mission either
        return first_state(config), STOP, (psi_e, 0.0, 0.0)
    r, r_d = navigation.r, reference.r_d
    r_d_dot = 0.0
    if not begun:
        dt = 0.0
    elif dt > 0.0:
        r_d_dot = (r_d - last_r_d) / dt
    last_r_d = r_d
    slope, r_dot = derivative(config.derivative, slope, r, dt)
    error = psi_e
    if config.reference.enabled:
        shaped = shape(config.reference, shaped, navigation.psi, r, reference.psi_d, r_d, dt)
        _, psi_d, r_d, r_d_dot = shaped
        error = wrap(navigation.psi - psi_d)
    thrust = reference.thrust if reference.thrust < config.thrust_max else config.thrust_max
    seen = HeadingInputs(error, r, r_dot, r_d, r_d_dot, thrust)
    controller, out = controller_step(config.controller, controller, seen, dt)
    if not math.isfinite(out.rudder):
        return first_state(config), STOP, (psi_e, out.sigma_1, out.sigma_2)
    rudder = bounded(out.rudder, config.max_angle)
    return (
        AutopilotState(True, last_r_d, slope, shaped, controller),
        Command(rudder, thrust),
        (psi_e, out.sigma_1, out.sigma_2),
    )


def kept(config: Autopilot, state: AutopilotState) -> AutopilotState:
    """Return the state for a new configuration: that of another controller is reset, the rest is kept."""
    is_same = type(state.controller) is type(config.controller_begins)
    return state if is_same else state._replace(controller=config.controller_begins)


class HeadingAutopilot:
    """The autopilot of one vehicle: configuration and state.

    Args:
        vehicle: for the limits of rudder and thrust, and for models.
        config: controller, gains and reference.

    Raises:
        ConfigurationError: the gains need values that the vehicle's file does not have.
    """

    def __init__(self, vehicle: Vehicle, config: AutopilotConfig | None = None) -> None:
        self.vehicle = vehicle
        self.config = prepare(config or AutopilotConfig(), vehicle)
        self.state = first_state(self.config)

    def configure(self, config: AutopilotConfig) -> None:
        """Take new gains; the rudder stays where it is unless the controller changes.

        Raises:
            ConfigurationError: as the constructor; nothing is changed.
        """
        self.config = prepare(config, self.vehicle)
        self.state = kept(self.config, self.state)

    def reset(self) -> None:
        """Reset the state."""
        self.state = first_state(self.config)

    def update(self, navigation: Navigation, reference: Reference, dt: float) -> AutopilotOutput:
        """Take one step, see `steer`.

        Args:
            navigation: measured heading and yaw rate, NED.
            reference: from guidance; thrust 0 means that no mission is running.
            dt: seconds since the last update (0 on the first one).
        """
        self.state, command, signals = steer(self.config, self.state, navigation, reference, dt)
        return AutopilotOutput(command, *signals)
