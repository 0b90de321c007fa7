"""The routes of a mission file that are made from points: waypoints and survey; the geofence of a file."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Literal

import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import exactly_one, unfit
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.depth_profile import DepthProfile, RampKind
from auv_path_following.curves.spatial.spatial_spline import SpatialSpline
from auv_path_following.missions.depth_keys import Place
from auv_path_following.missions.routes import survey
from auv_path_following.missions.routes.route import Route
from auv_path_following.missions.routes.smoothing import Smoothing, end_courses, smoothed
from auv_path_following.missions.site import Site
from auv_path_following.missions.waypoint_files import check_depths


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

    points: tuple[Place, ...] | None = setting(None, "the waypoints, all with a depth or none")
    file: str | None = setting(None, "instead of points: a waypoint file beside the mission file")
    feature: str | None = setting(None, "with file: name of the line or polygon to take")
    smoothing: Smoothing = setting(doc="how corners are rounded")
    closed: bool | None = setting(
        None, "return from the last waypoint to the first (default: only for the outline of a polygon)"
    )
    depths: Literal["take", "ignore"] = setting("take", "ignore: a planar path, whatever depths points have")
    depth_ramp: RampKind | None = setting(
        None, "depth between waypoints: linear or smooth (default: linear for smoothing linear, else smooth)"
    )

    def build(self, site: Site) -> Route:
        """Return the subpaths along the waypoints."""
        points, outline, depths = site.given(
            self.points, self.file, self.feature, "points", "waypoints", self.depths == "take"
        )
        closed = outline if self.closed is None else self.closed
        if outline and not closed:
            site.note(f"{self.file}: the last side of the outline is not followed (closed: false)")
        with _named_as_in(self.file):
            made = smoothed(points, self.smoothing, closed)
            if depths is None:
                if self.depth_ramp is not None:
                    raise ConfigurationError(
                        "depth_ramp", self.depth_ramp, "it only with points that have a depth"
                    )
                return Route(made.segments, points)
            if self.smoothing.kind == "spline":
                return self._spline(points, depths)
        ramp = self.depth_ramp or ("linear" if self.smoothing.kind == "linear" else "smooth")
        levels = [*depths, depths[0]] if len(made.ways) > len(depths) else depths
        profile = DepthProfile(list(zip(made.ways, levels, strict=True)), ramp)
        return Route(made.segments, points, profile=profile, depth_key="waypoints with a depth")

    def _spline(self, points: list[Pair], depths: list[float]) -> Route:
        if self.depth_ramp is not None:
            raise ConfigurationError(
                "depth_ramp", self.depth_ramp, "none: a spline is a cubic in depth as well"
            )
        places = [(x, y, z) for (x, y), z in zip(points, depths, strict=True)]
        spline = SpatialSpline(places, *end_courses(self.smoothing))
        return Route([spline.plan], points, subpaths=(spline,), depth_key="waypoints with a depth")


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
    leg_depths: tuple[float, ...] | None = setting(
        None, "depth of each leg in its order, with smooth ramps between legs", unit="m"
    )

    @pydantic.model_validator(mode="after")
    def _has_one_spacing(self) -> SurveySpec:
        exactly_one(self, ("spacing", "swath"), "of spacing and swath")
        if self.overlap and self.swath is None:
            raise unfit("overlap without swath", "both (spacing is already the distance between legs)")
        return self

    def build(self, site: Site) -> Route:
        """Return the survey's legs and turns."""
        polygon, _, _ = site.given(self.polygon, self.file, self.feature, "polygon", "survey")
        spacing = self.spacing if self.spacing is not None else (self.swath or 0.0) * (1.0 - self.overlap)
        with _named_as_in(self.file):
            legs = survey.legs(polygon, spacing, math.radians(self.heading_deg), self.run_out)
        try:
            segments, ways = survey.joined(legs, self.smoothing)
        except ConfigurationError as error:
            if not error.where.startswith("points["):
                raise
            number = int(error.where[len("points[") : -1])
            found = f"{error.found} (end {number % 2 + 1} of leg {number // 2 + 1})"
            raise ConfigurationError("smoothing", found, "a smaller one, more spacing, or dubins") from None
        points = [point for leg in legs for point in leg]
        if self.leg_depths is None:
            return Route(segments, points, tuple(polygon))
        profile = self._profile(self.leg_depths, len(legs), ways)
        return Route(segments, points, tuple(polygon), profile, depth_key="leg_depths")

    def _profile(self, depths: Sequence[float], legs: int, ways: Sequence[float]) -> DepthProfile:
        """Return the depth over the survey: constant on each leg."""
        if len(depths) != legs:
            raise ConfigurationError(
                "leg_depths", f"{len(depths)} depths", f"one for each of the {legs} legs"
            )
        if not ways:
            raise ConfigurationError("leg_depths", "smoothing spline", "another one, which has legs")
        check_depths(depths, lambda k: f"leg_depths[{k}]")
        return DepthProfile([(way, depths[k // 2]) for k, way in enumerate(ways)], "smooth")
