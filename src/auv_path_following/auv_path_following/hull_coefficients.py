"""Coefficients of a hull: Eqs. (18), (19), and with `vertical` Eqs. (3D-3), (3D-4)."""

from __future__ import annotations

import pydantic

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.settings.validators import unfit
from auv_msgs_py.values.pure import numbers
from auv_path_following.vertical_hull import VerticalHull

#: m/s^2.
GRAVITY = 9.81


@numbers
@settings
class Hull:
    """Coefficients of Eq. (18) and Eq. (19), by the names of Table 2."""

    m: float = setting(doc="mass", unit="kg", gt=0.0)
    Izz: float = setting(doc="moment of inertia about the vertical axis", unit="kg m^2", gt=0.0)

    Xuu: float = setting(doc="drag ahead", unit="kg/m", lt=0.0)
    Xud: float = setting(doc="added mass ahead", unit="kg")
    Xvr: float = setting(doc="added mass, surge force from vr r", unit="kg/rad")
    Xrr: float = setting(doc="added mass, surge force from r^2", unit="kg m/rad")

    Yvv: float = setting(doc="drag sideways", unit="kg/m", lt=0.0)
    Yvd: float = setting(doc="added mass sideways", unit="kg")
    Yrr: float = setting(doc="drag of turning, sway force", unit="kg m/rad^2")
    Yrd: float = setting(doc="added mass, sway force from dr/dt", unit="kg m/rad")
    Yur: float = setting(doc="added mass and fin lift, sway force from ur r", unit="kg/rad")
    Yuv: float = setting(doc="lift of body and fins, sway force from ur vr", unit="kg/m")
    Yuud: float = setting(doc="rudder lift, sway force", unit="kg/(m rad)")

    Nvv: float = setting(doc="drag sideways, yaw moment", unit="kg")
    Nvd: float = setting(doc="added mass, yaw moment from dvr/dt", unit="kg m")
    Nrr: float = setting(doc="drag of turning", unit="kg m^2/rad^2", lt=0.0)
    Nrd: float = setting(doc="added moment of inertia", unit="kg m^2/rad")
    Nur: float = setting(doc="added mass and fin lift, yaw moment from ur r", unit="kg m/rad")
    Nuv: float = setting(doc="body moment and fin lift, yaw moment from ur vr", unit="kg")
    Nuud: float = setting(
        doc="rudder lift, yaw moment; a positive angle turns to port", unit="kg/rad", lt=0.0
    )

    surge_coupling: bool = setting(doc="whether SX of Eq. (19) has the rigid-body term m vr r")
    vertical: VerticalHull | None = setting(None, "heave, roll and pitch; a planar vehicle can do without")

    @pydantic.model_validator(mode="after")
    def _mass_matrix_is_definite(self) -> Hull:
        surge, sway, yaw = self.m - self.Xud, self.m - self.Yvd, self.Izz - self.Nrd
        minors = {
            "m - Xud": surge,
            "m - Yvd": sway,
            "Izz - Nrd": yaw,
            "(m - Yvd) (Izz - Nrd) - Yrd Nvd": sway * yaw - self.Yrd * self.Nvd,
        }
        for formula, value in minors.items():
            if not value > 0.0:
                raise unfit(f"{formula} = {value:g}", "greater than 0, or Eq. (18) cannot hold")
        return self

    @pydantic.model_validator(mode="after")
    def _spatial_mass_matrix_is_definite(self) -> Hull:
        c = self.vertical
        if c is None:
            return self
        arm, m, roll = self.m * c.zg, self.m, c.Ixx - c.Kpd
        heave_pitch, sway_yaw = -m * c.xg - 0.5 * (c.Zqd + c.Mwd), m * c.xg - 0.5 * (self.Yrd + self.Nvd)
        minors = {"m - Zwd": m - c.Zwd, "Iyy - Mqd": c.Iyy - c.Mqd, "Ixx - Kpd": roll}
        if min(minors.values()) > 0.0:
            surge, heave, sway, yaw = m - self.Xud, m - c.Zwd, m - self.Yvd, self.Izz - self.Nrd
            # Schur complements: what the couplings leave of the last diagonal element of each half.
            minors["pitch row of the mass matrix less its couplings"] = (
                c.Iyy - c.Mqd - arm * arm / surge - heave_pitch * heave_pitch / heave
            )
            minors["sway row of the mass matrix less its couplings"] = (
                sway - arm * arm / roll - sway_yaw * sway_yaw / yaw
            )
        for formula, value in minors.items():
            if not value > 0.0:
                raise unfit(f"{formula} = {value:g}", "greater than 0, or Eq. (3D-3) has no solution")
        return self

    @pydantic.model_validator(mode="after")
    def _weight_is_that_of_the_mass(self) -> Hull:
        vertical, weight = self.vertical, self.m * GRAVITY
        if vertical is not None and abs(vertical.W - weight) > 1e-3 * weight:
            raise unfit(f"W = {vertical.W:g} N under vertical", f"m g = {weight:.5g} N within 0.1 %")
        return self
