"""dr/dt for NISM when the gyro is noisy: a second-order low-pass that gives the derivative of what it passes.

Eq. (45) needs d psi_e'/dt, and the paper does not say where it comes from. Differences of two measurements
multiply the gyro's noise by sqrt(2)/dt, 28 times at 20 Hz. This filter,

    r_f'' = w^2 (r - r_f) - 2 w r_f'

multiplies it by sqrt(w^3 dt)/2 (0.8 1/s at w = 4 rad/s and 20 Hz), for a delay of 2/w.
"""

from __future__ import annotations

import math

from auv_msgs_py.settings import setting, settings


@settings
class DerivativeConfig:
    """How dr/dt is found."""

    bandwidth: float = setting(
        0.0,
        "w of the filter behind dr/dt; 0: no filter, differences of what is measured",
        unit="rad/s",
        ge=0.0,
        le=1000.0,
        live=True,
    )


class Derivative:
    """The rate of change of a sampled signal.

    With a bandwidth it is that of the signal behind two equal first-order lags, solved exactly between two
    samples (the signal taken as straight), so there is no step at which it becomes unstable.

    Args:
        config: bandwidth.
    """

    def __init__(self, config: DerivativeConfig | None = None) -> None:
        self.config = config or DerivativeConfig()
        self.reset()

    def reset(self) -> None:
        """Forget all; the next sample is the first, with a derivative of 0."""
        self._last: float | None = None
        self._rate = self._bend = 0.0

    def update(self, value: float, dt: float) -> float:
        """Take in a sample `dt` seconds after the last one; its derivative, 1/s of its unit."""
        last, self._last = self._last, value
        if last is None or not dt > 0.0:
            return self._rate
        slope = (value - last) / dt
        w = self.config.bandwidth
        if not w > 0.0:
            self._rate, self._bend = slope, 0.0
            return slope
        # Behind a straight line of this slope the filter comes to rest, 2 slope/w late; e is what is left
        # until then: e'' + 2 w e' + w^2 e = 0. Kept is e + 2 e'/w: a new w makes no jump on a straight line.
        e_rate = slope - self._rate
        e = self._bend - 2.0 * e_rate / w
        decay = math.exp(-w * dt)
        rise = (e_rate + w * e) * dt
        e, e_rate = (e + rise) * decay, (e_rate - w * rise) * decay
        self._rate, self._bend = slope - e_rate, e + 2.0 * e_rate / w
        return self._rate
