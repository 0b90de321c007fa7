"""The vehicle file: hull coefficients, limits of rudder and thruster, measured speed and turning."""

from __future__ import annotations

import dataclasses
import math
from typing import Literal

import pydantic

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import unfit
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_path_following.abilities import Cruise, DepthRange, Pitching, Turning
from auv_path_following.abilities import Rudder as Rudder
from auv_path_following.hull_coefficients import GRAVITY as GRAVITY
from auv_path_following.hull_coefficients import Hull as Hull
from auv_path_following.thrust_units import (
    SYMBOLS,
    Rows,
    ThrustUnit,
    check_thrust,
    interpolated,
    inverse,
    speed_between,
    thrust_between,
)
from auv_path_following.vertical_hull import check_planes, floating_depth

#: Hulls that the simulator has as programs, without coefficients, as a vehicle file names them.
BuiltInHull = Literal["mss_remus100"]


@settings
class Vehicle:
    """One vehicle, as plant or as a controller's model."""

    name: str = setting(doc="name of the vehicle")
    length: float = setting(doc="length of the hull", unit="m", gt=0.0)
    thrust_max: float = setting(doc="largest thrust, in `thrust_unit`", unit="N", gt=0.0)
    thrust_unit: ThrustUnit = setting(
        "N",
        "of every thrust of this vehicle, in files and on the wire; percent: of its largest, which is 100",
    )
    thrust_table: tuple[Pair, ...] = setting(
        (), "thrust in N of a vehicle whose unit is another: rows of `thrust_unit` and N, both increasing"
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
    assumed_within: float = setting(
        1.0,
        "factor within which the hull's coefficients are assumed, which the rule's gains allow for; 1: known",
        ge=1.0,
        le=3.0,
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
    def _thrust_has_newtons_where_they_are_needed(self) -> Vehicle:
        check_thrust(self.thrust_unit, self.thrust_max, self.thrust_table, has_hull=self.hull is not None)
        return self

    @property
    def thrust_symbol(self) -> str:
        """Unit symbol of thrust."""
        return SYMBOLS[self.thrust_unit]

    def newtons(self, thrust: float) -> float:
        """Return a thrust in N.

        Args:
            thrust: in the vehicle's unit.

        Raises:
            ConfigurationError: the unit is not N, and the file has no `thrust_table`.
        """
        if self.thrust_unit == "N":
            return thrust
        if not self.thrust_table:
            raise ConfigurationError(
                f"{self.name}: thrust_table", "nothing", f"rows of {self.thrust_unit} and N"
            )
        return interpolated(self.thrust_table, thrust)

    @property
    def in_newtons(self) -> Vehicle:
        """The same vehicle with every thrust in N.

        Raises:
            ConfigurationError: as `newtons`.
        """
        if self.thrust_unit == "N":
            return self
        cruise = self.cruise and Cruise(
            thrust=self.newtons(self.cruise.thrust),
            speed=self.cruise.speed,
            speeds=tuple((self.newtons(thrust), speed) for thrust, speed in self.cruise.speeds),
        )
        return dataclasses.replace(
            self, thrust_unit="N", thrust_table=(), thrust_max=self.newtons(self.thrust_max), cruise=cruise
        )

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

    def speed_at(self, thrust: float) -> float:
        """Return the steady speed through the water straight ahead (m/s), Eq. (19).

        Args:
            thrust: in the vehicle's unit.
        """
        if self._speeds:
            return speed_between(self._speeds, thrust, self.thrust_unit == "rpm")
        return math.sqrt(max(self.newtons(thrust) if self.cruise is None else thrust, 0.0) / self._drag)

    @property
    def _drag(self) -> float:
        """Drag straight ahead over the speed squared, kg/m; of a measured speed in the thrust's unit."""
        if self.cruise is not None:
            return self.cruise.thrust / self.cruise.speed**2
        return -self.coefficients.Xuu

    @property
    def _speeds(self) -> Rows:
        """Rows of thrust and speed, where one measured speed with a quadratic drag does not do."""
        if self.cruise is None or (self.thrust_unit != "rpm" and not self.cruise.speeds):
            return ()
        return self.cruise.rows

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
        """Return the thrust, in the vehicle's unit, for a steady speed (m/s): inverse of `speed_at`."""
        if self._speeds:
            return thrust_between(self._speeds, speed, self.thrust_unit == "rpm")
        drag = self._drag * speed * speed
        in_newtons = self.cruise is None and self.thrust_unit != "N"
        return interpolated(inverse(self.thrust_table), drag) if in_newtons else drag


def load(name_or_path: str) -> Vehicle:
    """Read a vehicle file.

    Args:
        name_or_path: a path, or a shipped name such as ``remus100``.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    return yaml_file.load(config_files.find("vehicles", name_or_path), Vehicle)
