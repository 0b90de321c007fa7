"""Proportional line of sight: aims at a point Delta ahead on the tangent, whatever the current does."""

from __future__ import annotations

import math

from auv_msgs_py.settings import setting, settings
from auv_path_following.guidance.law import LawInputs, LawOutput


@settings
class LosConfig:
    """Look-ahead, and whether the vehicle's own drift angle is taken off."""

    lookahead: float = setting(
        6.0, "look-ahead distance Delta along the tangent", unit="m", ge=0.1, le=1000.0, live=True
    )
    sideslip: bool = setting(True, "subtract beta_r, as Eq. (24) does", live=True)


class Los:
    """psi_d = chi_p + atan(-ye/Delta) - beta_r: Eqs. (24), (25) with alpha = 0.

    A current across the path leaves ye = Delta tan(asin(Vc/Ur)), which is what the other two laws are for.
    """

    def __init__(self, config: LosConfig | None = None) -> None:
        self.config = config or LosConfig()

    def reset(self) -> None:
        """LOS has no state."""

    def update(self, inputs: LawInputs, dt: float) -> LawOutput:
        """Eq. (25) with alpha = 0."""
        chi_r = math.atan(-inputs.ye / self.config.lookahead)
        beta_r = inputs.beta_r if self.config.sideslip else 0.0
        return LawOutput(inputs.chi_p + chi_r - beta_r, chi_r, 0.0, 0.0)
