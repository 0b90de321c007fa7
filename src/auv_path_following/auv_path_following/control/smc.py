"""Conventional, model-based sliding mode heading control in the form of Fossen and of Lekkas."""

from __future__ import annotations

from auv_msgs_py.settings import setting, settings
from auv_path_following.control.controller import ControllerOutput, HeadingInputs
from auv_path_following.control.hull_model import HullModel, SwayEstimate
from auv_path_following.control.rudder_limiter import RudderLimiter
from auv_path_following.vehicle import Vehicle


@settings
class SmcConfig:
    """Surface and switching gain; docs/tuning.md tells how the defaults were found."""

    slope: float = setting(
        1.0, "slope of the surface: psi_e decays at this rate on it", unit="1/s", gt=0.0, le=10.0, live=True
    )
    gain: float = setting(
        0.7, "reaching gain, yaw acceleration off the surface", unit="rad/s^2", gt=0.0, le=10.0, live=True
    )
    boundary: float = setting(
        0.43, "half width of the boundary layer", unit="rad/s", gt=0.0, le=10.0, live=True
    )
    largest_rate: float = setting(
        0.5, "the surface asks for at most this yaw rate, so that a far turn does not outrun the rudder",
        unit="rad/s", gt=0.0, le=10.0, live=True,
    )  # fmt: skip


class Smc:
    """sigma = psi_e' + slope psi_e; the rudder that holds it by the model, and -gain sat(sigma/boundary).

    The equivalent control comes from the yaw row of Eqs. (18), (19) of the controller's own hull. Speed and
    sway are the model's too: the first from the balance of thrust and drag, the second integrated.

    Args:
        config: gains.
        vehicle: the hull as the controller knows it, and the limits of the rudder.
    """

    def __init__(self, config: SmcConfig, vehicle: Vehicle) -> None:
        self.config = config
        self.model = HullModel(vehicle)
        self._sway = SwayEstimate(self.model)
        self._limiter = RudderLimiter(vehicle.rudder)
        self.reset()

    def reset(self) -> None:
        """Forget the sway; the rudder starts from neutral."""
        self._sway.reset()
        self._limiter.reset()

    def equivalent(self, inputs: HeadingInputs, ur: float, vr: float) -> float:
        """The rudder (rad) with which the model's sigma stays as it is."""
        wanted = inputs.r_d_dot - self._slope(inputs.psi_e) * (inputs.r - inputs.r_d)
        return (wanted - self.model.accelerations(ur, vr, inputs.r)[1]) / self.model.rudder_gain(ur)[1]

    def update(self, inputs: HeadingInputs, dt: float) -> ControllerOutput:
        """The rudder for this instant."""
        g = self.config
        ur = self.model.cruise(inputs.thrust)
        if ur <= 0.0:
            return ControllerOutput(self._limiter.limit(0.0, dt))
        vr = self._sway.update(ur, inputs.r, self._limiter.angle, dt)
        reach = min(max(g.slope * inputs.psi_e, -g.largest_rate), g.largest_rate)
        sigma = inputs.r - inputs.r_d + reach
        push = -g.gain * min(max(sigma / g.boundary, -1.0), 1.0)
        wanted = self.equivalent(inputs, ur, vr) + push / self.model.rudder_gain(ur)[1]
        return ControllerOutput(self._limiter.limit(wanted, dt), sigma)

    def _slope(self, psi_e: float) -> float:
        """d/d psi_e of the surface: 0 where its rate is capped."""
        return self.config.slope if abs(self.config.slope * psi_e) < self.config.largest_rate else 0.0
