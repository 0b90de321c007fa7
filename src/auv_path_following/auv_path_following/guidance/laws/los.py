"""Proportional line of sight: aims at a point Delta ahead on the tangent, without the current."""

from __future__ import annotations

import math

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import numbers, numbers_class, pure
from auv_path_following.guidance.laws.law import LawInputs, LawOutput, NoState
from auv_path_following.registry import Law


@numbers
@settings
class LosConfig:
    """Look-ahead, and whether the vehicle's drift angle is subtracted."""

    lookahead: float = setting(
        6.0, "look-ahead distance Delta along the tangent", unit="m", ge=0.1, le=1000.0, live=True
    )
    sideslip: bool = setting(True, "subtract beta_r, as Eq. (24) does", live=True)

    @property
    def largest_lookahead(self) -> float:
        """Delta, m."""
        return self.lookahead


@pure
def los(config: LosConfig, state: NoState, inputs: LawInputs, dt: float) -> tuple[NoState, LawOutput]:
    """Return psi_d = chi_p + atan(-ye/Delta) - beta_r: Eqs. (24), (25) with alpha = 0.

    A current across the path leaves ye = Delta tan(asin(Vc/Ur)), the error that the other laws remove.
    """
    chi_r = math.atan(-inputs.ye / config.lookahead)
    beta_r = inputs.beta_r if config.sideslip else 0.0
    return state, LawOutput(inputs.chi_p + chi_r - beta_r, chi_r, 0.0, 0.0)


LAW = Law("los", "proportional line of sight", LosConfig, numbers_class(LosConfig), NoState(), los)
