"""Estimate the current from position and velocity through the water, Eq. (35)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import NO_CURRENT, NO_WATER, Current, Navigation, WaterVelocity


@settings
class CurrentObserverConfig:
    """Gains of Eq. (35). The poles of the error are the roots of z^2 + k_ob2 z + k_ob1 = 0."""

    k_ob1: float = setting(
        1.0, "gain from position error to the current", unit="1/s^2", gt=0.0, le=100.0, live=True
    )
    k_ob2: float = setting(
        1.0, "gain from position error to the position", unit="1/s", gt=0.0, le=100.0, live=True
    )
    longest_gap: float = setting(
        3.0,
        "after a longer gap without measurements the estimate continues from the new position",
        unit="s",
        gt=0.0,
        le=60.0,
        live=True,
    )


class Observer(NamedTuple):
    """Configuration: gains and longest gap (s) of the settings, and `transition` for steps of `dt` s."""

    k_ob1: float
    k_ob2: float
    longest_gap: float
    dt: float
    transition: tuple[float, float, float, float]


class ObserverState(NamedTuple):
    """State of the observer.

    Attributes:
        seen: whether there was a measurement.
        x, y, wx, wy: its position (m) and velocity through the water (m/s), NED.
        ex, ey: position error, m.
        blind: time since the last velocity through the water, s.
        current: the estimate, m/s, NED.
    """

    seen: bool = False
    x: float = 0.0
    y: float = 0.0
    wx: float = 0.0
    wy: float = 0.0
    ex: float = 0.0
    ey: float = 0.0
    blind: float = 0.0
    current: Current = NO_CURRENT


@pure
def relocated(state: ObserverState) -> ObserverState:
    """Return the state without a last position; the current is kept."""
    return ObserverState(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, state.current)


@pure
def observe(
    config: Observer,
    state: ObserverState,
    navigation: Navigation,
    water: WaterVelocity,
    has_water: bool,
    dt: float,
) -> ObserverState:
    """Estimate the current by Eq. (35), discretised exactly for any step.

    Between two measurements the position is assumed to move on a straight line, and the velocity through
    water, rotated into the world frame, to be the mean of its two values. Then the drift seen over the step,
    d = (eta_k - eta_k-1)/dt - mean(R(psi) nu_r), is constant, and the linear system

        e' = d - Vhat - k_ob2 e,      Vhat' = k_ob1 e,      e = eta - eta_hat

    has the closed-form solution used here: it is stable at any step, and 10 Hz and 50 Hz give the same
    estimate.

    Args:
        config: gains.
        state: of the observer.
        navigation: measured pose, NED.
        water: measured velocity through the water, FRD.
        has_water: whether `water` is valid; if not, the estimate rests.
        dt: seconds since the last step, greater than 0; ignored on the first one.
    """
    dt += state.blind
    if dt > config.longest_gap:
        state = relocated(state)
    seen, last_x, last_y, last_wx, last_wy, ex, ey, _, current = state
    if not has_water:
        return ObserverState(seen, last_x, last_y, last_wx, last_wy, ex, ey, dt, current)
    x, y, psi, _ = navigation
    ur, vr = water
    cos_psi, sin_psi = math.cos(psi), math.sin(psi)
    wx = cos_psi * ur - sin_psi * vr
    wy = sin_psi * ur + cos_psi * vr
    if seen and dt > 0.0:
        f11, f12, f21, f22 = config.transition
        if dt != config.dt:
            f11, f12, f21, f22 = transition(config.k_ob1, config.k_ob2, dt)
        dx = (x - last_x) / dt - 0.5 * (wx + last_wx)
        dy = (y - last_y) / dt - 0.5 * (wy + last_wy)
        # e = 0, Vhat = d is the equilibrium, so the distance from it is what decays.
        gap_x, gap_y = current.Vx - dx, current.Vy - dy
        current = Current(dx + f21 * ex + f22 * gap_x, dy + f21 * ey + f22 * gap_y)
        ex, ey = f11 * ex + f12 * gap_x, f11 * ey + f12 * gap_y
    return ObserverState(True, x, y, wx, wy, ex, ey, 0.0, current)


class CurrentObserver:
    """The observer of one vehicle: settings and state.

    Args:
        config: gains.
    """

    def __init__(self, config: CurrentObserverConfig | None = None) -> None:
        self.configure(config or CurrentObserverConfig())
        self.reset()

    def configure(self, config: CurrentObserverConfig) -> None:
        """Take new gains; the estimate is kept."""
        self.config = prepare(config)

    def reset(self) -> None:
        """Reset the state; the next update starts with an estimate of zero."""
        self.state = ObserverState()

    def relocate(self) -> None:
        """Forget the last position, which the next one does not continue; keep the current."""
        self.state = relocated(self.state)

    @property
    def current(self) -> Current:
        """The latest estimate, m/s, NED."""
        return self.state.current

    def update(self, navigation: Navigation, water: WaterVelocity | None, dt: float) -> ObserverState:
        """Take one measurement, see `observe`; `water` is None where it is unknown."""
        has_water = water is not None
        self.state = observe(self.config, self.state, navigation, water or NO_WATER, has_water, dt)
        return self.state


def prepare(config: CurrentObserverConfig, dt: float = 0.0) -> Observer:
    """Return the observer's configuration.

    Args:
        config: gains.
        dt: usual step, s: its transition is computed once, that of any other step when it occurs.
    """
    k_ob1, k_ob2 = float(config.k_ob1), float(config.k_ob2)
    return Observer(k_ob1, k_ob2, float(config.longest_gap), dt, transition(k_ob1, k_ob2, dt))


@pure
def transition(k_ob1: float, k_ob2: float, dt: float) -> tuple[float, float, float, float]:
    """Return the matrix exponential of [[-k_ob2, -1], [k_ob1, 0]] dt, row by row; Eq. (36) in e and Vhat.

    With m = -k_ob2/2 and q = sqrt(k_ob2^2/4 - k_ob1) (real or imaginary) it is
    e^(m dt) (cosh(q dt) I + sinh(q dt)/q (A - m I)). It is computed from decaying exponentials only, so
    that it is finite for any gains and any step.
    """
    m = -0.5 * k_ob2
    square = m * m - k_ob1
    q = math.sqrt(abs(square))
    if square > 0.0:
        slow = math.exp(k_ob1 / (m - q) * dt)  # (m - q) (m + q) = k_ob1; m + q itself would cancel
        fast_by_slow = math.expm1(-2.0 * q * dt)
        cosh = slow * (1.0 + 0.5 * fast_by_slow)
        sinh_over_q = -0.5 * slow * fast_by_slow / q
    else:
        decay = math.exp(m * dt)
        cosh = decay * math.cos(q * dt)
        sinh_over_q = decay * (math.sin(q * dt) / q if q > 0.0 else dt)
    return (
        cosh + sinh_over_q * (-k_ob2 - m),
        -sinh_over_q,
        sinh_over_q * k_ob1,
        cosh - sinh_over_q * m,
    )
