"""The simulated vehicle's own navigation: dead reckoning by Doppler log, corrected by acoustic fixes.

With bottom lock the velocity over ground carries the position on, in between the velocity through the water
and a current that it has learned. A Kalman filter weighs the fixes against it; what no fix can be is refused.
"""

from __future__ import annotations

import cmath
import math
from collections import deque
from typing import NamedTuple

from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import Navigation
from auv_sim.plant.sensors import Fix, Measurements


@settings
class NavigatorConfig:
    """What the navigator believes of its instruments."""

    start: float = setting(
        0.5, "standard deviation of the position it starts with, north and east", unit="m", gt=0.0
    )
    fix: float = setting(1.0, "standard deviation of a fix, north and east", unit="m", gt=0.0)
    gate: float = setting(3.5, "a fix is refused beyond so many standard deviations", gt=0.0, le=100.0)
    patience: int = setting(5, "after so many refusals in a row the navigator doubts itself", ge=1)
    walk: float = setting(
        0.05, "how fast dead reckoning goes astray at random: m after a second", unit="m/s^0.5", gt=0.0
    )
    bottom_error: float = setting(
        0.03, "standard deviation of the error of the velocity over ground", unit="m/s", gt=0.0
    )
    water_error: float = setting(
        0.15, "standard deviation of the error of the current it has learned", unit="m/s", gt=0.0
    )
    error_time: float = setting(2000.0, "time in which these errors change", unit="s", gt=0.0)
    current_time: float = setting(20.0, "over which the current is learned", unit="s", gt=0.0)
    blend: float = setting(5.0, "a correction is spread over so long: the pose never jumps", unit="s", ge=0.0)


class NavigatorOutput(NamedTuple):
    """The pose (NED), the velocity over ground (m/s, NaN without bottom lock), the filter's own opinion.

    `deviation` is the standard deviation it claims for north and east, m; `refused` counts fixes.
    """

    navigation: Navigation
    u: float
    v: float
    deviation: float
    refused: int


class _Error:
    """The slow error of a source of velocity, as a complex number, and what is known of it."""

    def __init__(self, deviation: float) -> None:
        self.deviation = deviation
        self.value = 0.0 + 0.0j
        self.variance = deviation * deviation


class Navigator:
    """Kalman filter for position and the slow error of the velocity that carries it on.

    North and east are the real and the imaginary part of one complex number, for their errors are alike and
    independent: so two states are enough, z (m) and the error e (m/s), which walks at random. With bottom
    lock z' = exp(i psi) (u + i v + e), and e turns with the vehicle: a crooked compass, a wrong scale.
    Without, z' = exp(i psi) (ur + i vr) + e, and e is the current. Variances are those of one axis: P_z and
    that of e are real, P_ze, between them, is complex.

    Args:
        config: what it believes.
    """

    def __init__(self, config: NavigatorConfig) -> None:
        self.config = config
        self.reset(0.0, 0.0)

    def reset(self, x: float, y: float) -> None:
        """Start from a position (m, north, east), known to `config.start`."""
        c = self.config
        self._z, self._shown = complex(x, y), 0.0 + 0.0j
        self._P_z, self._P_ze = c.start * c.start, 0.0 + 0.0j
        self._bottom, self._water = _Error(c.bottom_error), _Error(c.water_error)
        self._source = self._bottom
        self._track: deque[tuple[float, complex]] = deque([(0.0, 0.0 + 0.0j)])
        self._time = 0.0
        self._velocity = 0.0 + 0.0j
        self._in_a_row = self.refused = 0

    def update(self, measured: Measurements, dt: float) -> NavigatorOutput:
        """One step: carry on, weigh the fixes that came.

        Args:
            measured: the instruments' measurements.
            dt: seconds since the last update.
        """
        turn = cmath.exp(1j * measured.psi)
        self._carry_on(measured, turn, dt)
        for fix in measured.fixes:
            self._weigh(fix)
        u, v = measured.bottom or (math.nan, math.nan)
        shown = self._z + self._shown
        navigation = Navigation(shown.real, shown.imag, measured.psi, measured.r)
        return NavigatorOutput(navigation, u, v, math.sqrt(self._P_z), self.refused)

    def _carry_on(self, measured: Measurements, turn: complex, dt: float) -> None:
        c = self.config
        through = turn * complex(*measured.water)
        source = self._water if measured.bottom is None else self._bottom
        if source is not self._source:
            self._source, self._P_ze = source, 0.0 + 0.0j
            self._water.variance = c.water_error**2
        if measured.bottom is None:
            axes, velocity = 1.0 + 0.0j, through
        else:
            axes, velocity = turn, turn * complex(*measured.bottom)
            current = velocity + turn * source.value - through
            self._water.value += (current - self._water.value) * -math.expm1(-dt / c.current_time)
        # Trapezoidal: the velocity is the mean of its two ends.
        now = velocity + axes * source.value
        step = 0.5 * (now + self._velocity) * dt
        self._velocity = now
        self._P_z += 2.0 * dt * (axes * self._P_ze.conjugate()).real + dt * dt * source.variance
        self._P_z += c.walk * c.walk * dt
        self._P_ze += axes * dt * source.variance
        source.variance += 2.0 * source.deviation**2 * dt / c.error_time
        self._z += step
        self._shown *= math.exp(-dt / c.blend) if c.blend else 0.0
        self._time += dt
        self._track.append((self._time, self._track[-1][1] + step))
        while len(self._track) > 2 and self._track[1][0] < self._time - 30.0:
            self._track.popleft()

    def _weigh(self, fix: Fix) -> None:
        c = self.config
        innovation = complex(fix.x, fix.y) - (self._z - self._way_since(fix.age))
        S = self._P_z + c.fix * c.fix
        if abs(innovation) ** 2 > c.gate * c.gate * S:
            self.refused += 1
            self._in_a_row += 1
            if self._in_a_row >= c.patience:
                self._P_z *= 2.0
            return
        self._in_a_row = 0
        source = self._source
        correction = self._P_z / S * innovation
        source.value += self._P_ze.conjugate() / S * innovation
        source.variance -= abs(self._P_ze) ** 2 / S
        self._P_ze *= 1.0 - self._P_z / S
        self._P_z *= 1.0 - self._P_z / S
        self._z += correction
        if c.blend:
            self._shown -= correction

    def _way_since(self, age: float) -> complex:
        """How far dead reckoning has come since then, m."""
        then, newest = self._time - age, self._track[-1][1]
        for k in range(len(self._track) - 1, -1, -1):
            at, way = self._track[k]
            if at <= then:
                if k + 1 == len(self._track):
                    return newest - way
                later, further = self._track[k + 1]
                return newest - way - (further - way) * (then - at) / (later - at)
        return newest - self._track[0][1]
