"""The generators of a mission file: spiral, figure of eight, loiter circle, helix."""

from __future__ import annotations

import math
from typing import Annotated

import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import exactly_one, unfit
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.depth_profile import STEEPEST, DepthProfile, RampKind
from auv_path_following.missions.routes import generators
from auv_path_following.missions.routes.route import Route
from auv_path_following.missions.segment_specs import Turn
from auv_path_following.missions.site import Site, within


@settings
class SpiralSpec:
    """`spiral`: outwards around a point with one distance between the turns (Archimedes)."""

    centre: Pair = setting(doc="centre")
    inner_radius: float = setting(0.0, "distance from the centre at which it starts", unit="m", ge=0.0)
    spacing: float = setting(doc="distance between neighbouring turns", unit="m", gt=0.0)
    turns: float = setting(doc="number of turns", gt=0.0, le=1000.0)
    bearing_deg: float = setting(0.0, "bearing of the start, seen from the centre", unit="deg")
    turn: Turn = setting(1, "1 to starboard, -1 to port")

    def build(self, site: Site) -> Route:
        """Return the spiral's turns."""
        with within("centre"):
            centre = site.point(self.centre)
        bearing = math.radians(self.bearing_deg)
        made = generators.spiral(centre, self.inner_radius, self.spacing, self.turns, bearing, self.turn)
        return Route(made, [])


@settings
class FigureOfEightSpec:
    """`figure_of_eight`: two loops and two lines that cross."""

    centre: Pair = setting(doc="where the lines cross")
    radius: float = setting(doc="of both loops", unit="m", gt=0.0)
    separation: float = setting(
        doc="distance between the loops' centres, at least 2 radius", unit="m", gt=0.0
    )
    axis_deg: float = setting(0.0, "bearing of the first loop from the crossing", unit="deg")

    @pydantic.model_validator(mode="after")
    def _is_apart(self) -> FigureOfEightSpec:
        if self.separation < 2.0 * self.radius:
            found = f"separation {self.separation:g} m with radius {self.radius:g} m"
            raise unfit(found, f"a separation of at least {2.0 * self.radius:g} m, twice the radius")
        return self

    def build(self, site: Site) -> Route:
        """Return the loops and the lines."""
        with within("centre"):
            centre = site.point(self.centre)
        axis = math.radians(self.axis_deg)
        return Route(generators.figure_of_eight(centre, self.radius, self.separation, axis), [])


@settings
class LoiterSpec:
    """`loiter`: around a circle."""

    centre: Pair = setting(doc="centre")
    radius: float = setting(doc="radius", unit="m", gt=0.0)
    turns: Annotated[int, pydantic.Field(ge=1, le=1000)] = setting(1, "number of turns")
    bearing_deg: float = setting(0.0, "bearing of the start, seen from the centre", unit="deg")
    turn: Turn = setting(1, "1 to starboard, -1 to port")

    def build(self, site: Site) -> Route:
        """Return the circle, once for each turn."""
        with within("centre"):
            centre = site.point(self.centre)
        made = generators.loiter(centre, self.radius, self.turns, math.radians(self.bearing_deg), self.turn)
        return Route(made, [])


@settings
class HelixSpec:
    """`helix`: around a circle from one depth to another, with level lines before and after it."""

    centre: Pair = setting(doc="centre")
    radius: float = setting(doc="radius", unit="m", gt=0.0)
    from_depth: float = setting(doc="depth at its start", unit="m", ge=0.0)
    to_depth: float = setting(doc="depth at its end", unit="m", ge=0.0)
    slope_deg: float | None = setting(None, "steepest slope; or", unit="deg", gt=0.0, lt=80.0)
    turns: float | None = setting(None, "number of turns", gt=0.0, le=1000.0)
    turn: Turn = setting(1, "1 to starboard, -1 to port")
    bearing_deg: float = setting(0.0, "bearing of the circle's start, seen from the centre", unit="deg")
    run_in: float = setting(0.0, "length of the level line before it", unit="m", ge=0.0, le=10000.0)
    run_out: float = setting(0.0, "length of the level line after it", unit="m", ge=0.0, le=10000.0)
    depth_ramp: RampKind = setting("linear", "linear: one slope all along; smooth: level at both ends")

    @pydantic.model_validator(mode="after")
    def _has_one_length(self) -> HelixSpec:
        exactly_one(self, ("slope_deg", "turns"), "of slope_deg and turns")
        if self.slope_deg is not None and self.from_depth == self.to_depth:
            raise unfit(f"from_depth and to_depth both {self.to_depth:g}", "two depths that differ, or turns")
        return self

    def build(self, site: Site) -> Route:
        """Return the lines and the turns."""
        with within("centre"):
            centre = site.point(self.centre)
        rise = abs(self.to_depth - self.from_depth)
        steepest = STEEPEST[self.depth_ramp]
        turns = self.turns or steepest * rise / (
            math.tan(math.radians(self.slope_deg or 0.0)) * math.tau * self.radius
        )
        if turns > 1000.0:
            raise ConfigurationError(
                "slope_deg", f"{self.slope_deg:g} deg: {turns:.0f} turns", "at most 1000 turns"
            )
        sweep = self.turn * turns * math.tau
        made = generators.helix(
            centre, self.radius, math.radians(self.bearing_deg), sweep, self.run_in, self.run_out
        )
        down = [(self.run_in, self.from_depth), (self.run_in + self.radius * abs(sweep), self.to_depth)]
        if self.run_in > 0.0:
            down.insert(0, (0.0, self.from_depth))
        if self.run_out > 0.0:
            down.append((down[-1][0] + self.run_out, self.to_depth))
        return Route(made, [], profile=DepthProfile(down, self.depth_ramp), depth_key="helix")
