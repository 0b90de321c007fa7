"""Coefficients of a hull that a planar model leaves out: heave, roll and pitch, Eqs. (3D-3), (3D-4)."""

from __future__ import annotations

import math

import pydantic

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.settings.validators import unfit
from auv_msgs_py.values.pure import numbers, pure
from auv_path_following.abilities import DepthRange


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


def reversal_speed(hull: VerticalHull) -> float:
    """Return the speed (m/s) below which "planes down" makes the hull climb, Eq. (3D-5); 0 if there is none.

    At low speed the planes' own lift, which pushes the stern the wrong way, outweighs the pitch that they
    give against the weight's righting moment.
    """
    attack = -hull.Zuud / hull.Zuw if hull.Zuw < 0.0 else 0.0  # w/u for each radian of planes
    pitch = (hull.Muw * attack + hull.Muud) / (hull.zg * hull.W)  # theta/u^2 for each radian, s^2/m^2
    if pitch >= 0.0:
        return math.inf
    return math.sqrt(attack / pitch) if attack < 0.0 else 0.0


@pure
def immersed_share(z: float, radius: float) -> float:
    """Return how much of a level hull of circular section is under water, 0 to 1.

    Args:
        z: depth of its axis, m.
        radius: of the section, m.
    """
    if z >= radius:
        return 1.0
    if z <= -radius:
        return 0.0
    height = z / radius
    return 1.0 - (math.acos(height) - height * math.sqrt(1.0 - height * height)) / math.pi


def floating_depth(hull: VerticalHull) -> float:
    """Return the depth at which the hull floats at rest, m; fully immersed where it does not float."""
    radius = 0.5 * hull.diameter
    low, high = -radius, radius
    if not hull.B > hull.W:
        return radius
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if hull.B * immersed_share(middle, radius) < hull.W else (low, middle)
    return high


#: Largest pitch of a level trim that is looked for, rad.
_STEEPEST_TRIM = math.radians(60.0)


def level_trim(hull: VerticalHull, speed: float) -> tuple[float, float]:
    """Return pitch and stern planes (rad) that hold a depth against weight and buoyancy; NaN if none do.

    Args:
        hull: its coefficients.
        speed: through the water, m/s, above `reversal_speed`.
    """
    c = hull

    def without_planes(theta: float) -> tuple[float, float, float]:
        u, w = speed * math.cos(theta), speed * math.sin(theta)
        Z = (c.W - c.B) * math.cos(theta) + c.Zww * w * abs(w) + c.Zuw * u * w
        weight = -c.zg * c.W * math.sin(theta) - c.xg * c.W * math.cos(theta)
        return u * u, Z, weight + c.Mww * w * abs(w) + c.Muw * u * w

    def left_over(theta: float) -> float:
        _, Z, M = without_planes(theta)
        return Z * c.Muud - M * c.Zuud

    low, high = -_STEEPEST_TRIM, _STEEPEST_TRIM
    at_low = left_over(low)
    if at_low * left_over(high) > 0.0:
        return math.nan, math.nan
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if left_over(middle) * at_low > 0.0 else (low, middle)
    square, _, M = without_planes(low)
    return low, -M / (c.Muud * square)


#: `depth.minimum_speed` is at least this many times the speed at which stern planes reverse.
REVERSAL_MARGIN = 1.5


def check_planes(hull: VerticalHull, max_angle_deg: float, depth: DepthRange) -> None:
    """Check that stern planes of this largest angle (deg) hold a depth at the lowest speed.

    Raises:
        PydanticCustomError: they reverse or reach their stop there, or the hull sinks.
    """
    slowest, reversal = depth.minimum_speed, reversal_speed(hull)
    if slowest < REVERSAL_MARGIN * reversal:
        raise unfit(
            f"depth.minimum_speed: {slowest:g} m/s, with planes that reverse at {reversal:.3g} m/s",
            f"at least {REVERSAL_MARGIN:g} times as much, {REVERSAL_MARGIN * reversal:.3g} m/s",
        )
    planes = math.degrees(abs(level_trim(hull, slowest)[1]))
    if not planes < max_angle_deg:
        found = "no angle" if math.isnan(planes) else f"{planes:.1f} deg"
        raise unfit(
            f"{found} of stern planes at depth.minimum_speed, {slowest:g} m/s",
            f"less than sternplanes.max_angle_deg, {max_angle_deg:g} deg, to hold a depth: "
            "a higher minimum_speed, or B closer to W",
        )
    if hull.B < hull.W and not depth.allow_sinking:
        raise unfit(
            f"hull.vertical: B = {hull.B:g} N below W = {hull.W:g} N",
            "a hull that floats up without thrust, or depth: {allow_sinking: true}",
        )
