"""Estimates the current from position and velocity through the water, Eq. (35)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import NO_CURRENT, Current, Navigation, WaterVelocity


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
        "what happened in a gap without measurements that is longer than this is not guessed: the estimate"
        " goes on from the new position",
        unit="s",
        gt=0.0,
        le=60.0,
        live=True,
    )


class ObserverOutput(NamedTuple):
    """The estimated current (m/s, NED) and the position error it came from (m)."""

    current: Current
    ex: float
    ey: float


class CurrentObserver:
    """Eq. (35), discretised exactly for any step.

    Between two measurements the position is taken to move on a straight line and the velocity through
    water, turned into the world frame, to be the mean of its ends. Then the drift seen over the step,
    d = (eta_k - eta_k-1)/dt - mean(R(psi) nu_r), is constant, and the linear system

        e' = d - Vhat - k_ob2 e,      Vhat' = k_ob1 e,      e = eta - eta_hat

    has the closed-form solution used here: there is no step at which it becomes unstable, and 10 Hz
    and 50 Hz give the same estimate.
    """

    def __init__(self, config: CurrentObserverConfig | None = None) -> None:
        self.config = config or CurrentObserverConfig()
        self.reset()

    def reset(self) -> None:
        """Forget everything; the next update starts with an estimate of zero."""
        self.relocate()
        self._current = NO_CURRENT

    def relocate(self) -> None:
        """The next position is not the end of a way from the last one; the current is still the same."""
        self._last: tuple[float, float, float, float] | None = None
        self._ex = self._ey = 0.0
        self._blind = 0.0

    @property
    def current(self) -> Current:
        """The latest estimate, m/s, NED."""
        return self._current

    def update(self, navigation: Navigation, water: WaterVelocity | None, dt: float) -> ObserverOutput:
        """Take in one measurement.

        Args:
            navigation: measured pose, NED.
            water: measured velocity through the water, FRD; None: not known now, the estimate rests.
            dt: seconds since the last update, > 0; ignored on the first one.
        """
        dt += self._blind
        if dt > self.config.longest_gap:
            self.relocate()
        if water is None:
            self._blind = dt
            return ObserverOutput(self._current, self._ex, self._ey)
        self._blind = 0.0
        x, y, psi, _ = navigation
        cos_psi, sin_psi = math.cos(psi), math.sin(psi)
        wx = cos_psi * water.ur - sin_psi * water.vr
        wy = sin_psi * water.ur + cos_psi * water.vr
        if self._last is not None and dt > 0.0:
            last_x, last_y, last_wx, last_wy = self._last
            f11, f12, f21, f22 = transition(self.config.k_ob1, self.config.k_ob2, dt)
            dx = (x - last_x) / dt - 0.5 * (wx + last_wx)
            dy = (y - last_y) / dt - 0.5 * (wy + last_wy)
            # e = 0, Vhat = d is the equilibrium, so the distance from it is what decays.
            gap_x, gap_y = self._current.Vx - dx, self._current.Vy - dy
            self._current = Current(
                dx + f21 * self._ex + f22 * gap_x,
                dy + f21 * self._ey + f22 * gap_y,
            )
            self._ex, self._ey = f11 * self._ex + f12 * gap_x, f11 * self._ey + f12 * gap_y
        self._last = (x, y, wx, wy)
        return ObserverOutput(self._current, self._ex, self._ey)


def transition(k_ob1: float, k_ob2: float, dt: float) -> tuple[float, float, float, float]:
    """The matrix exponential of [[-k_ob2, -1], [k_ob1, 0]] dt, row by row; Eq. (36) in e and Vhat.

    With m = -k_ob2/2 and q = sqrt(k_ob2^2/4 - k_ob1) (real or imaginary) it is
    e^(m dt) (cosh(q dt) I + sinh(q dt)/q (A - m I)). It is put together from powers of e that only fall,
    so that it is finite however large the gains and the step are.
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
