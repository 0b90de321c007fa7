"""Coefficients of a hull that a planar model leaves out: heave, roll and pitch, Eqs. (3D-3), (3D-4)."""

from __future__ import annotations

import pydantic

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.settings.validators import unfit
from auv_msgs_py.values.pure import numbers


@numbers
@settings
class VerticalHull:
    """Weight, buoyancy, and the coefficients of heave, roll and pitch, by Prestero's names.

    The origin of the body axes is the centre of buoyancy; x points forward, y to starboard, z down.
    """

    diameter: float = setting(
        doc="of the hull; at the surface buoyancy acts on its immersed share", unit="m", gt=0.0
    )
    W: float = setting(doc="weight", unit="N", gt=0.0)
    B: float = setting(doc="buoyancy under water", unit="N", gt=0.0)
    xg: float = setting(0.0, "centre of gravity ahead of the centre of buoyancy", unit="m")
    zg: float = setting(doc="centre of gravity below the centre of buoyancy", unit="m", gt=0.0)
    Ixx: float = setting(doc="moment of inertia about the long axis", unit="kg m^2", gt=0.0)
    Iyy: float = setting(doc="moment of inertia about the transverse axis", unit="kg m^2", gt=0.0)

    Xwq: float = setting(doc="added mass, surge force from wr q", unit="kg/rad")
    Xqq: float = setting(doc="added mass, surge force from q^2", unit="kg m/rad")
    Ywp: float = setting(doc="added mass, sway force from wr p", unit="kg/rad")
    Ypq: float = setting(doc="added mass, sway force from p q", unit="kg m/rad")

    Zww: float = setting(doc="drag in heave", unit="kg/m", lt=0.0)
    Zqq: float = setting(doc="drag of pitching, heave force", unit="kg m/rad^2")
    Zuw: float = setting(doc="lift of body and fins, heave force from ur wr", unit="kg/m")
    Zuq: float = setting(doc="added mass and fin lift, heave force from ur q", unit="kg/rad")
    Zvp: float = setting(doc="added mass, heave force from vr p", unit="kg/rad")
    Zrp: float = setting(doc="added mass, heave force from r p", unit="kg/rad")
    Zwd: float = setting(doc="added mass in heave", unit="kg")
    Zqd: float = setting(doc="added mass, heave force from dq/dt", unit="kg m/rad")
    Zuud: float = setting(doc="stern-plane lift, heave force", unit="kg/(m rad)", lt=0.0)

    Kpp: float = setting(doc="drag of rolling", unit="kg m^2/rad^2", le=0.0)
    Kup: float = setting(0.0, "damping of roll by the fins, roll moment from |ur| p", unit="kg m/rad", le=0.0)
    Kpd: float = setting(doc="added moment of inertia in roll", unit="kg m^2/rad")
    Kprop: float = setting(0.0, "roll moment of the propeller over its thrust", unit="m")

    Mww: float = setting(doc="drag in heave, pitch moment", unit="kg")
    Mqq: float = setting(doc="drag of pitching", unit="kg m^2/rad^2", lt=0.0)
    Muw: float = setting(doc="body moment and fin lift, pitch moment from ur wr", unit="kg")
    Muq: float = setting(doc="added mass and fin lift, pitch moment from ur q", unit="kg m/rad")
    Mvp: float = setting(doc="added mass, pitch moment from vr p", unit="kg m/rad")
    Mrp: float = setting(doc="added mass, pitch moment from r p", unit="kg m^2/rad^2")
    Mwd: float = setting(doc="added mass, pitch moment from dwr/dt", unit="kg m")
    Mqd: float = setting(doc="added moment of inertia in pitch", unit="kg m^2/rad")
    Muud: float = setting(
        doc="stern-plane lift, pitch moment; a positive angle puts the bow down", unit="kg/rad", lt=0.0
    )

    Nwp: float = setting(doc="added mass, yaw moment from wr p", unit="kg m/rad")
    Npq: float = setting(doc="added mass, yaw moment from p q", unit="kg m^2/rad^2")

    @pydantic.model_validator(mode="after")
    def _roll_is_damped(self) -> VerticalHull:
        if not (self.Kpp < 0.0 or self.Kup < 0.0):
            raise unfit("Kpp = 0 and Kup = 0", "one of them below 0: roll has to be damped")
        return self
