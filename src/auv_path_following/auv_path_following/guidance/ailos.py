"""Adaptive integral line of sight, Eqs. (24), (25), (30), (31)."""

from __future__ import annotations

import math

from auv_msgs_py.settings import setting, settings
from auv_path_following.guidance.adaptive_lookahead import AdaptiveLookaheadConfig, adaptive_lookahead
from auv_path_following.guidance.law import LawInputs, LawOutput


@settings
class AilosConfig:
    """Table 4's Delta, and how near to 1 theta_n may come before it is clipped."""

    lookahead: float = setting(
        6.0, "look-ahead distance Delta along the tangent", unit="m", ge=0.1, le=1000.0, live=True
    )
    theta_limit: float = setting(
        0.95, "bound of |theta_n|; Eq. (30) needs it below 1", gt=0.0, le=0.99, live=True
    )
    adaptive: AdaptiveLookaheadConfig = setting(factory=AdaptiveLookaheadConfig, doc="Delta by itself")


class Ailos:
    """Aims at a point Delta ahead on the tangent, shifted by alpha so that the current is compensated."""

    def __init__(self, config: AilosConfig | None = None) -> None:
        self.config = config or AilosConfig()

    def reset(self) -> None:
        """AILOS has no state: alpha follows from the estimated current at once."""

    def update(self, inputs: LawInputs, dt: float) -> LawOutput:
        """Eqs. (24), (25), (30), (31) for one instant."""
        ye, chi_p, Ur, beta_r, current = inputs
        Delta, limit = self.config.lookahead, self.config.theta_limit
        if self.config.adaptive.enabled:
            Delta = adaptive_lookahead(self.config.adaptive, ye, Ur)
        theta_n = 0.0
        if Ur > 0.0:
            across = -math.sin(chi_p) * current.Vx + math.cos(chi_p) * current.Vy
            theta_n = min(max(across / Ur, -limit), limit)
        alpha = adaptive_offset(ye, theta_n, Delta)
        chi_r = math.atan(-(ye + alpha) / Delta)
        return LawOutput(chi_p + chi_r - beta_r, chi_r, alpha, theta_n)


def adaptive_offset(ye: float, theta_n: float, Delta: float) -> float:
    """alpha of Eq. (30), m: the solution of alpha = theta_n sqrt(Delta^2 + (ye + alpha)^2).

    With it, Ur (ye + alpha)/sqrt(Delta^2 + (ye + alpha)^2) equals Ur ye/(same root) plus the current
    across the path, which is what turns Eq. (28) into Eq. (32). Needs |theta_n| < 1.
    """
    rest = 1.0 - theta_n * theta_n
    return (ye * theta_n * theta_n + theta_n * math.sqrt(Delta * Delta * rest + ye * ye)) / rest
