"""Integral line of sight in the form of Borhaug, Pavlov and Pettersen (2008)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import numbers, numbers_class, pure
from auv_path_following.guidance.laws.law import LawInputs, LawOutput
from auv_path_following.registry import Law


@numbers
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
    sideslip: bool = setting(False, "subtract beta_r; the integral covers it", live=True)

    @property
    def largest_lookahead(self) -> float:
        """Delta, m."""
        return self.lookahead


class IlosState(NamedTuple):
    """The integral y, s."""

    integral: float = 0.0


@pure
def ilos(config: IlosConfig, state: IlosState, inputs: LawInputs, dt: float) -> tuple[IlosState, LawOutput]:
    """Return psi_d = chi_p - atan((ye + sigma y)/Delta) with y' = Delta ye / ((ye + sigma y)^2 + Delta^2).

    y grows slowly where ye is large, so it hardly winds up on the way to the path. The observer is not used:
    the offset against the current comes from ye alone and builds up again after every turn. alpha of
    the output is sigma y.
    """
    integral = state.integral
    Delta, sigma = config.lookahead, config.sigma
    aim = inputs.ye + sigma * integral
    integral += dt * Delta * inputs.ye / (aim * aim + Delta * Delta)
    alpha = sigma * integral
    chi_r = math.atan(-(inputs.ye + alpha) / Delta)
    beta_r = inputs.beta_r if config.sideslip else 0.0
    return IlosState(integral), LawOutput(inputs.chi_p + chi_r - beta_r, chi_r, alpha, 0.0)


LAW = Law("ilos", "integral line of sight", IlosConfig, numbers_class(IlosConfig), IlosState(), ilos)
