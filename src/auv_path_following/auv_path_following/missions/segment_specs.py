"""The segments of a mission file, one class for each kind."""

from __future__ import annotations

import dataclasses
import math
from typing import Annotated, Literal

import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import exactly_one, no_boolean, unfit
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.clothoid import Clothoid
from auv_path_following.curves.kinds.fermat import FermatSpiral, MirroredFermatSpiral
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.polynomial import Polynomial
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.spatial_spline import SpatialSpline
from auv_path_following.missions.depth_keys import Place
from auv_path_following.missions.site import Site, within

Turn = Annotated[Literal[1, -1], pydantic.BeforeValidator(no_boolean)]


@settings
class LineSpec:
    """`line`: Eq. (10)."""

    start: Pair = setting(doc="where it starts")
    length: float = setting(doc="length", unit="m", gt=0.0)
    course_deg: float = setting(doc="course, clockwise from north", unit="deg")

    def build(self, site: Site) -> Segment:
        """Return the segment that it describes."""
        return Line(*_placed(site, "start", self.start), self.length, math.radians(self.course_deg))


@settings
class ArcSpec:
    """`arc`: Eq. (11); to starboard when to_deg is the larger."""

    centre: Pair = setting(doc="centre")
    radius: float = setting(doc="radius", unit="m", gt=0.0)
    from_deg: float = setting(doc="bearing of the start, seen from the centre", unit="deg")
    to_deg: float = setting(doc="bearing of the end, seen from the centre", unit="deg")

    @pydantic.model_validator(mode="after")
    def _has_length(self) -> ArcSpec:
        if self.from_deg == self.to_deg:
            raise unfit(f"from_deg and to_deg both {self.to_deg:g}", "two bearings that differ")
        return self

    def build(self, site: Site) -> Segment:
        """Return the segment that it describes."""
        centre = _placed(site, "centre", self.centre)
        return Arc(*centre, self.radius, math.radians(self.from_deg), math.radians(self.to_deg))


@settings
class FermatSpec:
    """`fermat`: Eq. (12)."""

    start: Pair = setting(doc="where it starts")
    course_deg: float = setting(doc="course at the start, clockwise from north", unit="deg")
    scale: float = setting(doc="k", unit="m", gt=0.0)
    theta_end: float = setting(doc="polar angle of the end", unit="rad", gt=0.0, le=100.0)
    turn: Turn = setting(doc="rho: 1 to starboard, -1 to port")

    def build(self, site: Site) -> Segment:
        """Return the segment that it describes."""
        start, chi = _placed(site, "start", self.start), math.radians(self.course_deg)
        return FermatSpiral(*start, self.scale, self.theta_end, chi, self.turn)


@settings
class FermatMirroredSpec:
    """`fermat_mirrored`: Eq. (13)."""

    end: Pair = setting(doc="where it ends")
    course_deg: float = setting(doc="course at the end, clockwise from north", unit="deg")
    scale: float = setting(doc="k", unit="m", gt=0.0)
    theta_end: float = setting(
        doc="polar angle of the start, seen from the end", unit="rad", gt=0.0, le=100.0
    )
    turn: Turn = setting(doc="rho: 1 to starboard, -1 to port")

    def build(self, site: Site) -> Segment:
        """Return the segment that it describes."""
        end, chi = _placed(site, "end", self.end), math.radians(self.course_deg)
        return MirroredFermatSpiral(*end, self.scale, self.theta_end, chi, self.turn)


@settings
class ClothoidSpec:
    """`clothoid`: curvature changes linearly along the way."""

    start: Pair = setting(doc="where it starts")
    course_deg: float = setting(doc="course at the start, clockwise from north", unit="deg")
    length: float = setting(doc="length", unit="m", gt=0.0)
    start_curvature: float = setting(doc="curvature at the start, positive to starboard", unit="1/m")
    end_curvature: float = setting(doc="curvature at the end", unit="1/m")

    @pydantic.model_validator(mode="after")
    def _is_sane(self) -> ClothoidSpec:
        turning = self.length * max(abs(self.start_curvature), abs(self.end_curvature))
        if turning > 1000.0:
            raise unfit(f"about {turning:.0f} rad of turning", "at most 1000 rad")
        return self

    def build(self, site: Site) -> Segment:
        """Return the segment that it describes."""
        start, chi = _placed(site, "start", self.start), math.radians(self.course_deg)
        return Clothoid(*start, self.length, chi, self.start_curvature, self.end_curvature)


@settings
class PolynomialSpec:
    """`polynomial`: of any degree, in t from 0 to 1."""

    north: Annotated[tuple[float, ...], pydantic.Field(min_length=2, max_length=32)] = setting(
        doc="coefficients of 1, t, t^2, ... towards north of the origin", unit="m"
    )
    east: Annotated[tuple[float, ...], pydantic.Field(min_length=2, max_length=32)] = setting(
        doc="the same towards east", unit="m"
    )

    def build(self, site: Site) -> Segment:
        """Return the segment that it describes."""
        return Polynomial(self.north, self.east)


@settings
class SplineSpec:
    """`spline`: a cubic spline through points."""

    points: Annotated[tuple[Place, ...], pydantic.Field(min_length=2)] = setting(
        doc="points on the way, all with a depth or none"
    )
    start_course_deg: float | None = setting(
        None, "course at the start; without it no curvature there", unit="deg"
    )
    end_course_deg: float | None = setting(
        None, "course at the end; without it no curvature there", unit="deg"
    )

    def build(self, site: Site) -> Segment | SpatialSpline:
        """Return the segment that it describes."""
        with within("points", joined=""):
            points, depths = site.places(self.points)
        start, end = (
            None if c is None else math.radians(c) for c in (self.start_course_deg, self.end_course_deg)
        )
        if depths is None:
            return Spline(points, start, end)
        return SpatialSpline([(*at, z) for at, z in zip(points, depths, strict=True)], start, end)


_Specs = LineSpec | ArcSpec | FermatSpec | FermatMirroredSpec | ClothoidSpec | PolynomialSpec | SplineSpec


@settings
class SegmentSpec:
    """One item of `segments`: a mapping with one key, the kind of the segment."""

    line: LineSpec | None = setting(None, "straight line")
    arc: ArcSpec | None = setting(None, "circular arc")
    fermat: FermatSpec | None = setting(None, "Fermat's spiral")
    fermat_mirrored: FermatMirroredSpec | None = setting(None, "Fermat's spiral, mirrored")
    clothoid: ClothoidSpec | None = setting(None, "clothoid")
    polynomial: PolynomialSpec | None = setting(None, "polynomial")
    spline: SplineSpec | None = setting(None, "cubic spline, in the plane or in three dimensions")

    @pydantic.model_validator(mode="after")
    def _is_one(self) -> SegmentSpec:
        self.kind()
        return self

    def kind(self) -> str:
        """Return the kind of the segment."""
        names = tuple(field.name for field in dataclasses.fields(self))
        return exactly_one(self, names, "kinds of segment")

    def build(self, site: Site) -> Segment | SpatialSpline:
        """Return the segment that it describes."""
        kind = self.kind()
        spec: _Specs = getattr(self, kind)
        with within(kind):
            return spec.build(site)


def _placed(site: Site, key: str, pair: Pair) -> Pair:
    with within(key):
        return site.point(pair)
