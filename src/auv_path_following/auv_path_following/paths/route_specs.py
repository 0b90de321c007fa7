"""Waypoints and generators as they stand in a mission file."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import pydantic

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.settings import Pair, setting, settings
from auv_path_following.paths import generators, survey
from auv_path_following.paths.segment import Segment
from auv_path_following.paths.segment_specs import Turn, exactly_one, unfit
from auv_path_following.paths.site import Site, within
from auv_path_following.paths.smoothing import Smoothing, smooth


class Route(NamedTuple):
    """What a route comes to: its subpaths, and the waypoints (north, east, m) that they were made from."""

    segments: list[Segment]
    waypoints: list[Pair]


@settings
class WaypointsSpec:
    """`waypoints`: points to pass, and how to go round their corners."""

    points: tuple[Pair, ...] | None = setting(None, "the waypoints")
    file: str | None = setting(
        None, "in place of points: .geojson, .kml, .csv or .plan beside the mission file"
    )
    smoothing: Smoothing = setting(doc="how corners are rounded")
    closed: bool = setting(False, "go on from the last waypoint to the first one")

    def build(self, site: Site) -> Route:
        """The subpaths along the waypoints."""
        points = site.given(self.points, self.file, "points")
        return Route(smooth(points, self.smoothing, self.closed), points)


@settings
class SurveySpec:
    """`survey`: a lawnmower pattern over a polygon."""

    polygon: tuple[Pair, ...] | None = setting(None, "the polygon's corners, in order")
    file: str | None = setting(
        None, "in place of polygon: .geojson, .kml, .csv or .plan beside the mission file"
    )
    spacing: float | None = setting(None, "largest distance between legs", unit="m", gt=0.0)
    swath: float | None = setting(None, "in place of spacing: width that the sensor sees", unit="m", gt=0.0)
    overlap: float = setting(0.0, "with swath: share of it that the next leg sees again", ge=0.0, le=0.95)
    heading_deg: float = setting(doc="course of the first leg, clockwise from north", unit="deg")
    run_out: float = setting(0.0, "how far legs go on beyond the polygon", unit="m", ge=0.0, le=10000.0)
    smoothing: Smoothing = setting(
        doc="how to come from leg to leg; dubins keeps all legs straight to their ends"
    )

    @pydantic.model_validator(mode="after")
    def _has_one_spacing(self) -> SurveySpec:
        exactly_one(self, ("spacing", "swath"), "of spacing and swath")
        if self.overlap and self.swath is None:
            raise unfit("overlap without swath", "both (spacing is already the distance between legs)")
        return self

    def build(self, site: Site) -> Route:
        """The survey's legs and turns."""
        polygon = site.given(self.polygon, self.file, "polygon")
        spacing = self.spacing if self.spacing is not None else (self.swath or 0.0) * (1.0 - self.overlap)
        legs = survey.legs(polygon, spacing, math.radians(self.heading_deg), self.run_out)
        try:
            segments = survey.path(legs, self.smoothing)
        except ConfigurationError as error:
            if not error.where.startswith("points["):
                raise
            number = int(error.where[len("points[") : -1])
            found = f"{error.found} (end {number % 2 + 1} of leg {number // 2 + 1})"
            raise ConfigurationError("smoothing", found, "a smaller one, more spacing, or dubins") from None
        return Route(segments, [point for leg in legs for point in leg])


@settings
class SpiralSpec:
    """`spiral`: outwards around a point with one distance between the turns (Archimedes)."""

    centre: Pair = setting(doc="centre")
    inner_radius: float = setting(0.0, "distance from the centre at which it starts", unit="m", ge=0.0)
    spacing: float = setting(doc="distance between neighbouring turns", unit="m", gt=0.0)
    turns: float = setting(doc="how many turns", gt=0.0, le=1000.0)
    bearing_deg: float = setting(0.0, "bearing of the start, seen from the centre", unit="deg")
    turn: Turn = setting(1, "1 to starboard, -1 to port")

    def build(self, site: Site) -> Route:
        """The spiral's turns."""
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
        """The loops and the lines."""
        with within("centre"):
            centre = site.point(self.centre)
        axis = math.radians(self.axis_deg)
        return Route(generators.figure_of_eight(centre, self.radius, self.separation, axis), [])


@settings
class LoiterSpec:
    """`loiter`: round a circle."""

    centre: Pair = setting(doc="centre")
    radius: float = setting(doc="radius", unit="m", gt=0.0)
    turns: Annotated[int, pydantic.Field(ge=1, le=10000)] = setting(1, "how many turns")
    bearing_deg: float = setting(0.0, "bearing of the start, seen from the centre", unit="deg")
    turn: Turn = setting(1, "1 to starboard, -1 to port")

    def build(self, site: Site) -> Route:
        """The circle, once for each turn."""
        with within("centre"):
            centre = site.point(self.centre)
        made = generators.loiter(centre, self.radius, self.turns, math.radians(self.bearing_deg), self.turn)
        return Route(made, [])
