"""dr/dt for NISM with a noisy gyro: a second-order low-pass with the derivative of its output.

Eq. (45) needs d psi_e'/dt, and the paper does not say where it comes from. Differences of two measurements
multiply the gyro's noise by sqrt(2)/dt, 28 times at 20 Hz. This filter,

    r_f'' = w^2 (r - r_f) - 2 w r_f'

multiplies it by sqrt(w^3 dt)/2 (0.8 1/s at w = 4 rad/s and 20 Hz), for a delay of 2/w.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import numbers, pure


@numbers
@settings
class DerivativeConfig:
    """Filter behind dr/dt."""

    bandwidth: float = setting(
        0.0,
        "w of the filter behind dr/dt; 0: no filter, differences of measurements",
        unit="rad/s",
        ge=0.0,
        le=1000.0,
        live=True,
    )


class DerivativeState(NamedTuple):
    """The last sample, the derivative, and e + 2 e'/w of the filter's remaining lag e."""

    seen: bool = False
    last: float = 0.0
    rate: float = 0.0
    bend: float = 0.0


@pure
def derivative(
    config: DerivativeConfig, state: DerivativeState, inputs: float, dt: float
) -> tuple[DerivativeState, float]:
    """Return the rate of change of a sampled signal, 1/s of its unit.

    With a bandwidth, the signal first passes two equal first-order lags, solved exactly between two samples
    (the signal assumed linear), so that the filter is stable at any step.

    Args:
        config: bandwidth.
        state: of the filter; the first sample has a derivative of 0.
        inputs: the sample.
        dt: s since the last one.
    """
    seen, last, rate, bend = state
    if not seen or not dt > 0.0:
        return DerivativeState(True, inputs, rate, bend), rate
    slope = (inputs - last) / dt
    w = config.bandwidth
    if not w > 0.0:
        return DerivativeState(True, inputs, slope, 0.0), slope
    # Behind a straight line of this slope the filter settles 2 slope/w late; e is what is left
    # until then: e'' + 2 w e' + w^2 e = 0. Kept is e + 2 e'/w: a new w makes no jump on a straight line.
    e_rate = slope - rate
    e = bend - 2.0 * e_rate / w
    decay = math.exp(-w * dt)
    rise = (e_rate + w * e) * dt
    e, e_rate = (e + rise) * decay, (e_rate - w * rise) * decay
    rate = slope - e_rate
    return DerivativeState(True, inputs, rate, e + 2.0 * e_rate / w), rate
