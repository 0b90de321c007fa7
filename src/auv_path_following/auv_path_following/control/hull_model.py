"""What a controller may know of the hull: yaw and sway of Eqs. (18), (19), and what the rudder does."""

from __future__ import annotations

import math

from auv_path_following.vehicle import Vehicle


class HullModel:
    """Eqs. (18), (19) as a controller's own model; the plant may be another hull.

    Args:
        vehicle: the hull as the controller knows it.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self.vehicle = vehicle
        self.hull = h = vehicle.coefficients
        determinant = (h.m - h.Yvd) * (h.Izz - h.Nrd) - h.Yrd * h.Nvd
        self.inv_vv = (h.Izz - h.Nrd) / determinant
        self.inv_vr = h.Yrd / determinant
        self.inv_rv = h.Nvd / determinant
        self.inv_rr = (h.m - h.Yvd) / determinant

    def cruise(self, thrust: float) -> float:
        """Speed at which drag balances `thrust` (N), sqrt(XT / |Xuu|), m/s."""
        return self.vehicle.speed_at(thrust)

    def accelerations(self, ur: float, vr: float, r: float) -> tuple[float, float]:
        """(dvr/dt, dr/dt) with a neutral rudder, m/s^2 and rad/s^2."""
        h = self.hull
        SY = h.Yvv * vr * abs(vr) + h.Yrr * r * abs(r) + (h.Yur - h.m) * ur * r + h.Yuv * ur * vr
        SN = h.Nvv * vr * abs(vr) + h.Nrr * r * abs(r) + h.Nur * ur * r + h.Nuv * ur * vr
        return self.inv_vv * SY + self.inv_vr * SN, self.inv_rv * SY + self.inv_rr * SN

    def rudder_gain(self, ur: float) -> tuple[float, float]:
        """(dvr/dt, dr/dt) for each radian of rudder, 1/s^2 m and 1/s^2."""
        h = self.hull
        square = ur * ur
        return (
            (self.inv_vv * h.Yuud + self.inv_vr * h.Nuud) * square,
            (self.inv_rv * h.Yuud + self.inv_rr * h.Nuud) * square,
        )

    def steady_turn(self, ur: float) -> float:
        """Rate of a steady turn under full rudder at `ur`, sway left out, rad/s.

        The positive root of |Nrr| r^2 + |Nur| ur r = |Nuud| ur^2 max_angle.
        """
        h = self.hull
        a, b = -h.Nrr, max(-h.Nur * ur, 0.0)
        c = -h.Nuud * ur * ur * self.vehicle.rudder.max_angle
        return (math.sqrt(b * b + 4.0 * a * c) - b) / (2.0 * a)


class SwayEstimate:
    """vr by the model: integrated from the measured yaw rate and the rudder, since nobody measures it.

    Args:
        model: the controller's hull.
    """

    #: No step is longer than this, s: the sway of a hull settles in a few tenths of a second.
    _LONGEST = 0.05

    def __init__(self, model: HullModel) -> None:
        self.model = model
        self.reset()

    def reset(self) -> None:
        """Start again without sway."""
        self.vr = 0.0

    def update(self, ur: float, r: float, rudder: float, dt: float) -> float:
        """vr (m/s) after `dt` seconds with `rudder` held."""
        steps = max(1, math.ceil(dt / self._LONGEST - 1e-9))
        push = self.model.rudder_gain(ur)[0] * rudder
        for _ in range(steps):
            self.vr += (self.model.accelerations(ur, self.vr, r)[0] + push) * dt / steps
        return self.vr
