"""Vector field guidance in the form of Nelson, Barber, McLain and Beard (2007)."""

from __future__ import annotations

import math

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, numbers, numbers_class, pure
from auv_path_following.guidance.laws.law import LawInputs, LawOutput, NoState
from auv_path_following.registry import Law


@numbers
@settings
class VectorFieldConfig:
    """Shape of the field around the path, and the bound of the crab angle."""

    entry_angle_deg: float = setting(
        60.0,
        "angle to the path at which it is approached from far away",
        unit="deg",
        gt=0.0,
        le=90.0,
        live=True,
    )
    gain: float = setting(0.25, "slope of the field on the path", unit="1/m", gt=0.0, le=100.0, live=True)
    theta_limit: float = setting(
        0.95, "bound of the current across the desired course over Ur", gt=0.0, le=0.99, live=True
    )

    @property
    def largest_lookahead(self) -> float:
        """Look-ahead distance of a line-of-sight law with the same slope on the path, m."""
        return 0.5 * math.pi / (math.radians(self.entry_angle_deg) * self.gain)


@pure
def vector_field(
    config: VectorFieldConfig, state: NoState, inputs: LawInputs, dt: float
) -> tuple[NoState, LawOutput]:
    """Follow the course chi_d = chi_p - entry_angle (2/pi) atan(gain ye), crabbing against the current.

    The field prescribes a course over ground. The heading is the course less the drift angle and less the
    crab angle asin(theta_n) that the estimated current takes on this course. alpha of the output is 0.
    """
    ye, chi_p, Ur, beta_r, current = inputs
    chi_r = -math.radians(config.entry_angle_deg) * (2.0 / math.pi) * math.atan(config.gain * ye)
    chi_d = chi_p + chi_r
    theta_n = 0.0
    if Ur > 0.0:
        across = -math.sin(chi_d) * current.Vx + math.cos(chi_d) * current.Vy
        theta_n = bounded(across / Ur, config.theta_limit)
    return state, LawOutput(chi_d - math.asin(theta_n) - beta_r, chi_r, 0.0, theta_n)


LAW = Law(
    "vector_field",
    "vector field",
    VectorFieldConfig,
    numbers_class(VectorFieldConfig),
    NoState(),
    vector_field,
)
