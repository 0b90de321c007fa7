"""The waypoints and generators of a mission file, one class for each."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, NamedTuple

import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import exactly_one, unfit
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.segment import Segment
from auv_path_following.missions.routes import generators, survey
from auv_path_following.missions.routes.smoothing import Smoothing, smooth
from auv_path_following.missions.segment_specs import Turn
from auv_path_following.missions.site import Site, within


class Route(NamedTuple):
    """A route: its subpaths, the waypoints they were made from and the area they survey, (north, east), m."""

    segments: list[Segment]
    waypoints: list[Pair]
    area: tuple[Pair, ...] = ()


@contextmanager
def _named_as_in(file: str | None) -> Iterator[None]:
    """Name `file: NAME: point 3` in place of `points[2]` in an error, if the points come from a file."""
    try:
        yield
    except ConfigurationError as error:
        if file is None:
            raise
        where, found = (
            re.sub(r"\bpoints\[(\d+)\]", lambda m: f"point {int(m[1]) + 1}", text)
            for text in (error.where, error.found)
        )
        if where in ("points", "polygon"):
            where = f"file: {file}"
        elif where.startswith("point "):
            where = f"file: {file}: {where}"
        raise ConfigurationError(where, found, error.expected) from None


@settings
class GeofenceFile:
    """`geofence` from a file: a plan's inclusion fence, or a polygon."""

    file: str = setting(doc="a waypoint file beside the mission file")
    feature: str | None = setting(None, "name of the fence or polygon to take")

    def build(self, site: Site) -> list[Pair]:
        """Return the corners (north, east), m."""
        return site.read(self.file, "geofence", self.feature).points


@settings
class WaypointsSpec:
    """`waypoints`: points to pass, and how their corners are rounded."""

    points: tuple[Pair, ...] | None = setting(None, "the waypoints")
    file: str | None = setting(None, "instead of points: a waypoint file beside the mission file")
    feature: str | None = setting(None, "with file: name of the line or polygon to take")
    smoothing: Smoothing = setting(doc="how corners are rounded")
    closed: bool | None = setting(
        None, "return from the last waypoint to the first (default: only for the outline of a polygon)"
    )

    def build(self, site: Site) -> Route:
        """Return the subpaths along the waypoints."""
        points, outline = site.given(self.points, self.file, self.feature, "points", "waypoints")
        closed = outline if self.closed is None else self.closed
        if outline and not closed:
            site.note(f"{self.file}: the last side of the outline is not followed (closed: false)")
        with _named_as_in(self.file):
            return Route(smooth(points, self.smoothing, closed), points)


@settings
class SurveySpec:
    """`survey`: a lawnmower pattern over a polygon."""

    polygon: tuple[Pair, ...] | None = setting(None, "the polygon's corners, in order")
    file: str | None = setting(None, "instead of polygon: a waypoint file beside the mission file")
    feature: str | None = setting(None, "with file: name of the polygon to take")
    spacing: float | None = setting(None, "largest distance between legs", unit="m", gt=0.0)
    swath: float | None = setting(None, "instead of spacing: width that the sensor covers", unit="m", gt=0.0)
    overlap: float = setting(0.0, "with swath: share of it that the next leg covers again", ge=0.0, le=0.95)
    heading_deg: float = setting(doc="course of the first leg, clockwise from north", unit="deg")
    run_out: float = setting(0.0, "length of the legs beyond the polygon", unit="m", ge=0.0, le=10000.0)
    smoothing: Smoothing = setting(doc="turns between legs; dubins keeps all legs straight to their ends")

    @pydantic.model_validator(mode="after")
    def _has_one_spacing(self) -> SurveySpec:
        exactly_one(self, ("spacing", "swath"), "of spacing and swath")
        if self.overlap and self.swath is None:
            raise unfit("overlap without swath", "both (spacing is already the distance between legs)")
        return self

    def build(self, site: Site) -> Route:
        """Return the survey's legs and turns."""
        polygon, _ = site.given(self.polygon, self.file, self.feature, "polygon", "survey")
        spacing = self.spacing if self.spacing is not None else (self.swath or 0.0) * (1.0 - self.overlap)
        with _named_as_in(self.file):
            legs = survey.legs(polygon, spacing, math.radians(self.heading_deg), self.run_out)
        try:
            segments = survey.path(legs, self.smoothing)
        except ConfigurationError as error:
            if not error.where.startswith("points["):
                raise
            number = int(error.where[len("points[") : -1])
            found = f"{error.found} (end {number % 2 + 1} of leg {number // 2 + 1})"
            raise ConfigurationError("smoothing", found, "a smaller one, more spacing, or dubins") from None
        return Route(segments, [point for leg in legs for point in leg], tuple(polygon))


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
