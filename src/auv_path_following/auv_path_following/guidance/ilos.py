"""Integral line of sight in the form of Borhaug, Pavlov and Pettersen (2008)."""

from __future__ import annotations

import math

from auv_msgs_py.settings import setting, settings
from auv_path_following.guidance.law import LawInputs, LawOutput


@settings
class IlosConfig:
    """Look-ahead and integral gain."""

    lookahead: float = setting(
        6.0, "look-ahead distance Delta along the tangent", unit="m", ge=0.1, le=1000.0, live=True
    )
    sigma: float = setting(
        0.5,
        "integral gain; below the speed through water, for stability",
        unit="m/s",
        ge=0.0,
        le=10.0,
        live=True,
    )
    sideslip: bool = setting(False, "subtract beta_r; the integral finds it by itself", live=True)


class Ilos:
    """psi_d = chi_p - atan((ye + sigma y)/Delta) with y' = Delta ye / ((ye + sigma y)^2 + Delta^2).

    y grows slowly where ye is large, so it hardly winds up on the way to the path. It knows nothing of the
    observer: what the current needs is found from ye alone, and to be found anew after every turn.
    """

    def __init__(self, config: IlosConfig | None = None) -> None:
        self.config = config or IlosConfig()
        self.reset()

    def reset(self) -> None:
        """Forget the integral."""
        self._integral = 0.0

    def update(self, inputs: LawInputs, dt: float) -> LawOutput:
        """The law for one instant; alpha of the output is sigma y."""
        Delta, sigma = self.config.lookahead, self.config.sigma
        aim = inputs.ye + sigma * self._integral
        self._integral += dt * Delta * inputs.ye / (aim * aim + Delta * Delta)
        alpha = sigma * self._integral
        chi_r = math.atan(-(inputs.ye + alpha) / Delta)
        beta_r = inputs.beta_r if self.config.sideslip else 0.0
        return LawOutput(inputs.chi_p + chi_r - beta_r, chi_r, alpha, 0.0)
