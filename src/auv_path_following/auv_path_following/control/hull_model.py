"""A controller's model of the hull: Eqs. (18), (19), the rudder's effect, the steady turn."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import numbers_of, pure
from auv_path_following.vehicle import Hull, Vehicle


class SteadyTurn(NamedTuple):
    """A steady turn with full rudder.

    Attributes:
        radius: of the vehicle's track, m.
        speed: through the water on it, m/s; of a measured turn the speed straight ahead, an upper bound.
        source: "measured" or "found from the hull".
    """

    radius: float
    speed: float
    source: str

    @property
    def rate(self) -> float:
        """Yaw rate, rad/s."""
        return self.speed / self.radius


def tightest_turn(vehicle: Vehicle, thrust: float | None = None) -> SteadyTurn:
    """Return the vehicle's tightest steady turn; a measured radius in its file takes precedence.

    The radius does not depend on the thrust: all forces of Eq. (19) grow with the square of the speeds, so a
    turn at another thrust is the same turn at another speed.

    Args:
        vehicle: the vehicle; a file without a hull has a measured radius and speed.
        thrust: in the vehicle's unit; the largest if None.

    Raises:
        ConfigurationError: no turn of the hull is steady, and none was measured.
    """
    thrust = vehicle.thrust_max if thrust is None else thrust
    if vehicle.turning is None:
        return HullModel(vehicle).steady_turn(vehicle.newtons(thrust))
    return SteadyTurn(vehicle.turning.radius, vehicle.speed_at(thrust), "measured")


#: b L^2/u^2 of torpedoes of length L at the speed u, with b = |dr/dt per rad|: the least of 14 vehicles (the
#: largest is 3.1), and the value a factor of about 1.8 from either end.
LEAST_EFFECT, TYPICAL_EFFECT = 1.0, 1.8


def rudder_effect(vehicle: Vehicle, without_hull: float = TYPICAL_EFFECT) -> float:
    """Return b = |dr/dt| for each radian of rudder at the speed of full thrust, 1/s^2.

    A measured effect takes precedence. It grows with the square of the speed.

    Args:
        vehicle: with a hull, or with its length and measured speed.
        without_hull: b L^2/u^2 to assume where the file has neither hull nor effect.
    """
    measured = measured_effect(vehicle)
    if measured is not None:
        return measured
    if vehicle.hull is not None:
        return HullModel(vehicle).b
    return without_hull * (vehicle.top_speed / vehicle.length) ** 2


def measured_effect(vehicle: Vehicle) -> float | None:
    """Return b at the speed of full thrust as the file's `turning.effect` gives it, 1/s^2."""
    turning, cruise = vehicle.turning, vehicle.cruise
    if turning is None or turning.effect is None:
        return None
    return turning.effect if cruise is None else turning.effect * (vehicle.top_speed / cruise.speed) ** 2


class SwayYaw(NamedTuple):
    """Sway and yaw rows of Eqs. (18), (19): coefficients, and the inverse of the mass matrix."""

    hull: Hull
    inv_vv: float
    inv_vr: float
    inv_rv: float
    inv_rr: float


@pure
def accelerations(model: SwayYaw, ur: float, vr: float, r: float) -> tuple[float, float]:
    """Return (dvr/dt, dr/dt) with a neutral rudder, m/s^2 and rad/s^2."""
    h = model.hull
    SY = h.Yvv * vr * abs(vr) + h.Yrr * r * abs(r) + (h.Yur - h.m) * ur * r + h.Yuv * ur * vr
    SN = h.Nvv * vr * abs(vr) + h.Nrr * r * abs(r) + h.Nur * ur * r + h.Nuv * ur * vr
    return model.inv_vv * SY + model.inv_vr * SN, model.inv_rv * SY + model.inv_rr * SN


def slopes(model: SwayYaw, ur: float, vr: float, r: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the derivatives of (dvr/dt, dr/dt) by vr (first of each pair) and by r, rudder held."""
    h = model.hull
    Yv, Yr = 2.0 * h.Yvv * abs(vr) + h.Yuv * ur, 2.0 * h.Yrr * abs(r) + (h.Yur - h.m) * ur
    Nv, Nr = 2.0 * h.Nvv * abs(vr) + h.Nuv * ur, 2.0 * h.Nrr * abs(r) + h.Nur * ur
    return (
        (model.inv_vv * Yv + model.inv_vr * Nv, model.inv_vv * Yr + model.inv_vr * Nr),
        (model.inv_rv * Yv + model.inv_rr * Nv, model.inv_rv * Yr + model.inv_rr * Nr),
    )


@pure
def rudder_gain(model: SwayYaw, ur: float) -> tuple[float, float]:
    """Return (dvr/dt, dr/dt) for each radian of rudder, m/s^2 and 1/s^2."""
    h = model.hull
    square = ur * ur
    return (
        (model.inv_vv * h.Yuud + model.inv_vr * h.Nuud) * square,
        (model.inv_rv * h.Yuud + model.inv_rr * h.Nuud) * square,
    )


#: Longest integration step, s: the sway of a hull settles in a few tenths of a second.
_LONGEST_SWAY_STEP = 0.05


@pure
def sway_after(model: SwayYaw, ur: float, vr: float, r: float, rudder: float, dt: float) -> float:
    """Return vr (m/s) after `dt` seconds with yaw rate and rudder held: a model instead of a sensor."""
    steps = max(1, math.ceil(dt / _LONGEST_SWAY_STEP - 1e-9))
    push = rudder_gain(model, ur)[0] * rudder
    for _ in range(steps):
        vr += (accelerations(model, ur, vr, r)[0] + push) * dt / steps
    return vr


class HullModel:
    """Eqs. (18), (19) as the controller's model; the plant may have another hull.

    Args:
        vehicle: the hull that the controller assumes.

    Raises:
        ConfigurationError: the vehicle file has no hull.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self.vehicle = vehicle
        self.hull = h = vehicle.coefficients
        determinant = (h.m - h.Yvd) * (h.Izz - h.Nrd) - h.Yrd * h.Nvd
        self.sway_yaw = SwayYaw(
            numbers_of(h),
            (h.Izz - h.Nrd) / determinant,
            h.Yrd / determinant,
            h.Nvd / determinant,
            (h.m - h.Yvd) / determinant,
        )
        self.Xvr = h.Xvr + (h.m if h.surge_coupling else 0.0)

    @property
    def b(self) -> float:
        """|dr/dt| for each radian of rudder at the speed of full thrust, 1/s^2."""
        return abs(rudder_gain(self.sway_yaw, self.vehicle.top_speed)[1])

    def steady_turn(self, thrust: float) -> SteadyTurn:
        """Return the turn under full rudder in which all forces of Eq. (19) balance, sway and drag included.

        Args:
            thrust: N, greater than 0.

        Raises:
            ConfigurationError: there is no such balance.
        """
        n, p, drag = self._balance(self.vehicle.rudder.max_angle)
        speed = math.sqrt(thrust / drag) * math.hypot(1.0, n)
        return SteadyTurn(math.hypot(1.0, n) / p, speed, "found from the hull")

    def steady_motion(self, thrust: float, angle: float) -> tuple[float, float, float]:
        """Return ur, vr (m/s) and r (rad/s) in a steady turn to starboard.

        Args:
            thrust: N, greater than 0.
            angle: of the rudder, rad, greater than 0.

        Raises:
            ConfigurationError: as `steady_turn`.
        """
        n, p, drag = self._balance(angle)
        ur = math.sqrt(thrust / drag)
        return ur, n * ur, p * ur

    def _balance(self, angle: float) -> tuple[float, float, float]:
        """Return n = vr/ur, p = r/ur (rad/m) and thrust/ur^2 (kg/m) in a steady turn.

        The sway row gives the drift n for any p, the yaw row then p, and the surge row the speed.
        """
        h = self.hull
        p = _first_root(lambda p: self._unbalanced(p, angle)[1])
        n = self._unbalanced(p, angle)[0]
        drag = -h.Xuu - self.Xvr * n * p - h.Xrr * p * p
        if not drag > 0.0:  # NaN is no balance either
            raise ConfigurationError(
                f"{self.vehicle.name}: hull",
                "no steady turn with full rudder",
                "a measured radius: turning: {radius: ...}",
            )
        return n, p, drag

    def _unbalanced(self, p: float, angle: float) -> tuple[float, float]:
        """Drift n = vr/ur in a turn to starboard with p = r/ur (rad/m), and SN/ur^2 that is left (kg)."""
        h, rudder = self.hull, -angle
        SY = h.Yrr * p * p + (h.Yur - h.m) * p + h.Yuud * rudder
        # Of the roots of Yvv n|n| + Yuv n + SY = 0 the outer one is where drag brakes the drift.
        size = (h.Yuv + math.sqrt(h.Yuv * h.Yuv - 4.0 * h.Yvv * abs(SY))) / (-2.0 * h.Yvv)
        n = math.copysign(size, SY)
        return n, h.Nvv * n * abs(n) + h.Nrr * p * p + h.Nur * p + h.Nuv * n + h.Nuud * rudder


def _first_root(f: Callable[[float], float], step: float = 0.01, largest: float = 100.0) -> float:
    """Return the smallest positive root of a function that is positive at 0; NaN where there is none."""
    x = 0.0
    if not f(x) > 0.0:
        return math.nan
    while f(x + step) > 0.0:
        x += step
        if x > largest:
            return math.nan
    low, high = x, x + step
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) > 0.0 else (low, middle)
    return low
