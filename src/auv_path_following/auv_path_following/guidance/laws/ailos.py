"""Adaptive integral line of sight, Eqs. (24), (25), (30), (31)."""

from __future__ import annotations

import math

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, numbers, numbers_class, pure
from auv_path_following.guidance.laws.adaptive_lookahead import AdaptiveLookaheadConfig, adaptive_lookahead
from auv_path_following.guidance.laws.law import LawInputs, LawOutput, NoState
from auv_path_following.registry import Law


@numbers
@settings
class AilosConfig:
    """Delta of Table 4, and the bound of theta_n."""

    lookahead: float = setting(
        6.0, "look-ahead distance Delta along the tangent", unit="m", ge=0.1, le=1000.0, live=True
    )
    theta_limit: float = setting(
        0.95, "bound of |theta_n|; Eq. (30) needs it below 1", gt=0.0, le=0.99, live=True
    )
    adaptive: AdaptiveLookaheadConfig = setting(
        factory=AdaptiveLookaheadConfig, doc="Delta from speed and cross-track error"
    )

    @property
    def largest_lookahead(self) -> float:
        """Delta, m; where it adapts, the largest."""
        adaptive = self.adaptive
        return adaptive.largest * adaptive.hull_length if adaptive.enabled else self.lookahead


@pure
def ailos(config: AilosConfig, state: NoState, inputs: LawInputs, dt: float) -> tuple[NoState, LawOutput]:
    """Aim at a point Delta ahead on the tangent, shifted by alpha: Eqs. (24), (25), (30), (31).

    The shift compensates the current. AILOS has no memory: alpha follows from the estimated current at once.
    """
    ye, chi_p, Ur, beta_r, current = inputs
    Delta, limit = config.lookahead, config.theta_limit
    if config.adaptive.enabled:
        Delta = adaptive_lookahead(config.adaptive, ye, Ur)
    theta_n = 0.0
    if Ur > 0.0:
        across = -math.sin(chi_p) * current.Vx + math.cos(chi_p) * current.Vy
        theta_n = bounded(across / Ur, limit)
    alpha = adaptive_offset(ye, theta_n, Delta)
    chi_r = math.atan(-(ye + alpha) / Delta)
    return state, LawOutput(chi_p + chi_r - beta_r, chi_r, alpha, theta_n)


@pure
def adaptive_offset(ye: float, theta_n: float, Delta: float) -> float:
    """Return alpha of Eq. (30), m: the solution of alpha = theta_n sqrt(Delta^2 + (ye + alpha)^2).

    With it, Ur (ye + alpha)/sqrt(Delta^2 + (ye + alpha)^2) equals Ur ye/(same root) plus the current
    across the path, which is what turns Eq. (28) into Eq. (32). Needs |theta_n| < 1.
    """
    rest = 1.0 - theta_n * theta_n
    return (ye * theta_n * theta_n + theta_n * math.sqrt(Delta * Delta * rest + ye * ye)) / rest


LAW = Law("ailos", "AILOS", AilosConfig, numbers_class(AilosConfig), NoState(), ailos)
