"""The vehicle file: hull coefficients, limits of rudder and thruster, measured speed and turning."""

from __future__ import annotations

import math
from typing import Literal

import pydantic

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.settings.validators import unfit
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import numbers
from auv_path_following import config_files
from auv_path_following.abilities import Cruise, DepthRange, Pitching, Turning
from auv_path_following.vertical_hull import VerticalHull, check_planes, floating_depth

#: m/s^2.
GRAVITY = 9.81
#: Hulls that the simulator has as programs, without coefficients, as a vehicle file names them.
BuiltInHull = Literal["mss_remus100"]


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


@settings
class Rudder:
    """Limits of the rudder, or of the stern planes, equal to both sides."""

    max_angle_deg: float = setting(doc="largest angle", unit="deg", gt=0.0, lt=90.0)
    max_rate_deg_s: float = setting(doc="largest rate", unit="deg/s", gt=0.0)
    dead_time: float = setting(
        0.0,
        "time from a command to the start of the fin: of the link and of the servo",
        unit="s",
        ge=0.0,
        le=2.0,
    )

    @property
    def max_angle(self) -> float:
        """Largest angle, rad."""
        return math.radians(self.max_angle_deg)

    @property
    def max_rate(self) -> float:
        """Largest rate, rad/s."""
        return math.radians(self.max_rate_deg_s)


@settings
class Vehicle:
    """One vehicle, as plant or as a controller's model."""

    name: str = setting(doc="name of the vehicle")
    length: float = setting(doc="length of the hull", unit="m", gt=0.0)
    thrust_max: float = setting(doc="largest thrust", unit="N", gt=0.0)
    thrust_unit: Literal["N", "percent"] = setting(
        "N",
        "of every thrust of this vehicle, in files and on the wire; percent: of its largest, which is 100",
    )
    rudder: Rudder = setting(doc="limits of the rudder")
    sternplanes: Rudder | None = setting(None, "limits of the stern planes; a planar vehicle has none")
    depth: DepthRange = setting(factory=DepthRange, doc="range of depth, for a vehicle with stern planes")
    params: str | None = setting(
        None, "parameter file with gains tuned for it, or the name of a shipped one; without one: the rule"
    )
    hull: Hull | None = setting(
        None, "coefficients of the hull; not needed for a real vehicle with cruise and turning"
    )
    simulated_as: BuiltInHull | None = setting(
        None, "hull that the simulator has as a program, in place of coefficients"
    )
    cruise: Cruise | None = setting(None, "measured speed at a thrust; from the hull if left out")
    turning: Turning | None = setting(None, "measured turning ability; from the hull if left out")
    pitching: Pitching | None = setting(None, "measured ability to pitch; from the hull if left out")

    @pydantic.model_validator(mode="after")
    def _is_known_well_enough(self) -> Vehicle:
        if self.hull is None and (self.cruise is None or self.turning is None):
            raise unfit(
                "nothing under hull, and not both of cruise and turning",
                "a mapping under hull, or what was measured under cruise and turning",
            )
        return self

    @pydantic.model_validator(mode="after")
    def _is_simulated_one_way(self) -> Vehicle:
        if self.hull is not None and self.simulated_as is not None:
            raise unfit(f"a hull, and simulated_as: {self.simulated_as}", "one of them")
        return self

    @pydantic.model_validator(mode="after")
    def _pitch_is_known_where_there_are_planes(self) -> Vehicle:
        has_vertical = self.hull is not None and self.hull.vertical is not None
        if self.sternplanes is None and (self.pitching is not None or has_vertical):
            raise unfit(
                f"{'pitching' if self.pitching is not None else 'hull.vertical'} without sternplanes",
                "sternplanes: their largest angle and rate",
            )
        if self.sternplanes is not None and self.pitching is None and not has_vertical:
            raise unfit("sternplanes without hull.vertical or pitching", "one of the two")
        return self

    @pydantic.model_validator(mode="after")
    def _planes_hold_the_depth(self) -> Vehicle:
        if self.hull is None or self.hull.vertical is None or self.sternplanes is None:
            return self
        check_planes(self.hull.vertical, self.sternplanes.max_angle_deg, self.depth)
        return self

    @pydantic.model_validator(mode="after")
    def _percent_are_of_the_largest(self) -> Vehicle:
        if self.thrust_unit == "percent" and (self.hull is not None or self.thrust_max != 100.0):
            found = (
                f"percent with {'a hull' if self.hull is not None else f'thrust_max: {self.thrust_max:g}'}"
            )
            raise unfit(found, "thrust_max: 100 and no hull, whose coefficients need N")
        return self

    @property
    def thrust_symbol(self) -> str:
        """Unit symbol of thrust."""
        return "%" if self.thrust_unit == "percent" else "N"

    @property
    def dives(self) -> bool:
        """Whether the vehicle has stern planes; otherwise it moves in the horizontal plane."""
        return self.sternplanes is not None

    @property
    def coefficients(self) -> Hull:
        """Hull coefficients, for a simulator or a model.

        Raises:
            ConfigurationError: the vehicle file has none.
        """
        if self.hull is None:
            found = "nothing" if self.simulated_as is None else f"simulated_as: {self.simulated_as}"
            raise ConfigurationError(
                f"{self.name}: hull",
                found,
                "the hull's coefficients, which a planar simulator or a model needs",
            )
        return self.hull

    @property
    def _drag(self) -> float:
        """Drag straight ahead over the speed squared, kg/m."""
        if self.cruise is not None:
            return self.cruise.thrust / self.cruise.speed**2
        return -self.coefficients.Xuu

    def speed_at(self, thrust: float) -> float:
        """Return the steady speed through the water straight ahead (m/s) at a thrust (N), Eq. (19)."""
        return math.sqrt(max(thrust, 0.0) / self._drag)

    @property
    def top_speed(self) -> float:
        """Speed through the water at full thrust, m/s."""
        return self.speed_at(self.thrust_max)

    @property
    def floats(self) -> bool:
        """Whether the vehicle rises without thrust; without coefficients: unless its file allows sinking."""
        if self.hull is None or self.hull.vertical is None:
            return not self.depth.allow_sinking
        return self.hull.vertical.B > self.hull.vertical.W

    @property
    def shallowest(self) -> float:
        """Least depth at which a dive begins, m: that of the floating hull; 0 without its coefficients."""
        if self.hull is None or self.hull.vertical is None:
            return 0.0
        return floating_depth(self.hull.vertical)

    def thrust_at(self, speed: float) -> float:
        """Return the thrust (N) for a steady speed through the water (m/s): inverse of `speed_at`."""
        return self._drag * speed * speed


def load(name_or_path: str) -> Vehicle:
    """Read a vehicle file.

    Args:
        name_or_path: a path, or a shipped name such as ``remus100``.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    return yaml_file.load(config_files.find("vehicles", name_or_path), Vehicle)
