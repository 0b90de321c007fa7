"""The mission file: where to go, and with how much thrust. How to get there well is not its business."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Annotated, Any, Literal

import pydantic

from auv_msgs_py.settings import result_files, yaml_file
from auv_msgs_py.settings.schema import Auto, setting, settings, validated
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.reverse import reversed_path
from auv_path_following.curves.switching_modes import LISTED, SwitchingMode
from auv_path_following.missions import bare_file, file_offers
from auv_path_following.missions.geodesy import Origin
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.missions.route_specs import (
    FigureOfEightSpec,
    GeofenceFile,
    LoiterSpec,
    Route,
    SpiralSpec,
    SurveySpec,
    WaypointsSpec,
)
from auv_path_following.missions.routes import smoothing
from auv_path_following.missions.segment_specs import SegmentSpec, exactly_one, no_boolean, unfit
from auv_path_following.missions.site import Frame, Point, Site, check_size, within
from auv_path_following.vehicle import Vehicle

#: Gap allowed at the joints of segments that somebody has typed in, m.
TOLERANCE = 1e-3
DEFAULT_VEHICLE = "remus100"
#: More subpaths than this are taken for a mistake.
_MOST_SUBPATHS = 100_000


@settings
class MissionSwitching:
    """What the mission asks of the circles of acceptance, Eq. (44); the parameters decide the rest."""

    mode: SwitchingMode | None = setting(None, f"joints with a circle: {LISTED}")
    radius: Auto | None = setting(
        None, "radius Rk of the circles; 0 or auto: computed for each corner", unit="m", ge=0.0, le=1000.0
    )


_NO_WISHES = MissionSwitching(mode=None, radius=None)
_NO_LIMITS = LimitsConfig()


@dataclasses.dataclass(frozen=True)
class Mission:
    """A mission that can be flown.

    Attributes:
        name, description: for people.
        path: what to follow, NED, all repetitions included.
        thrust: constant thrust on the way, N, greater than 0.
        source: the file it came from.
        speed: speed through the water that the file asks for, m/s; None where it gives the thrust.
        switching: what the file asks of the circles of acceptance.
        origin: where north 0, east 0 is; None where the file does not say.
        waypoints: (north, east), m, that the path was made from; empty where it was not made from any.
        area: corners (north, east), m, of the polygon that is surveyed; empty for other routes.
        once: subpaths of the path before it repeats itself.
        limits: what ends it early; the parameters may ask for less.
        geofence: corners (north, east), m, of the area that must not be left; empty for none.
        files: waypoint files that belong to it, in its own folder or below.
        notices: what of those files is not flown, one line each.
        assumed: the mission file that was assumed around a bare waypoint file; None where `source` is one.
    """

    name: str
    path: CompositePath
    thrust: float
    source: Path
    description: str
    speed: float | None = None
    switching: MissionSwitching = _NO_WISHES
    origin: Origin | None = None
    waypoints: tuple[Point, ...] = ()
    area: tuple[Point, ...] = ()
    once: int = 0
    files: tuple[Path, ...] = ()
    limits: LimitsConfig = _NO_LIMITS
    geofence: tuple[Point, ...] = ()
    notices: tuple[str, ...] = ()
    assumed: dict[str, Any] | None = None

    def copy_to(self, directory: Path) -> Path:
        """Write `mission.yaml` and the files that belong to it; returns the mission file."""
        target = directory / "mission.yaml"
        if self.assumed is None:
            result_files.copy(self.source, target)
        else:
            yaml_file.dump(self.assumed, target)
        for file in self.files:
            copy = directory / file.relative_to(self.source.parent)
            copy.parent.mkdir(parents=True, exist_ok=True)
            result_files.copy(file, copy)
        return target


_Version = Annotated[Literal[1], pydantic.BeforeValidator(no_boolean)]
_Count = Annotated[int, pydantic.Field(ge=1, le=10000)]
_Geofence = Annotated[
    Annotated[tuple[Point, ...], pydantic.Tag("(corners)")] | Annotated[GeofenceFile, pydantic.Tag("(file)")],
    pydantic.Discriminator(lambda value: "(file)" if isinstance(value, dict | GeofenceFile) else "(corners)"),
]
_ROUTES = ("segments", "waypoints", "survey", "spiral", "figure_of_eight", "loiter")


@settings
class MissionSpec:
    """A whole mission file."""

    version: _Version = setting(doc="version of this format")
    name: str = setting(doc="what people call it")
    description: str = setting("", "more for people")
    frame: Frame = setting(
        doc="of all points: ned [north, east] m, enu [east, north] m, wgs84 [latitude, longitude] deg"
    )
    origin: Origin | None = setting(None, "where north 0, east 0 is; needed for degrees")
    thrust: float | None = setting(None, "constant thrust on the way", unit="N", gt=0.0)
    speed: float | None = setting(
        None, "in place of thrust: speed through the water", unit="m/s", gt=0.0, le=20.0
    )
    switching: MissionSwitching = setting(factory=MissionSwitching, doc="circles of acceptance")
    limits: LimitsConfig = setting(factory=LimitsConfig, doc="what ends the mission early")
    geofence: _Geofence | None = setting(
        None, "area that must not be left: its corners, or {file, feature} of a waypoint file"
    )
    reverse: bool = setting(False, "follow the path from its end to its start")
    repeat: _Count = setting(1, "follow a closed path so many times")
    segments: tuple[SegmentSpec, ...] | None = setting(None, "the subpaths, in order")
    waypoints: WaypointsSpec | None = setting(None, "points to pass")
    survey: SurveySpec | None = setting(None, "lawnmower pattern over a polygon")
    spiral: SpiralSpec | None = setting(None, "outwards around a point")
    figure_of_eight: FigureOfEightSpec | None = setting(None, "two loops and two lines that cross")
    loiter: LoiterSpec | None = setting(None, "round a circle")

    @pydantic.model_validator(mode="after")
    def _fits(self) -> MissionSpec:
        exactly_one(self, _ROUTES, "kinds of route")
        if not self.reads_file or (self.thrust, self.speed) != (None, None):
            exactly_one(self, ("thrust", "speed"), "of thrust and speed")
        if self.frame == "wgs84" and self.origin is None:
            raise unfit("frame wgs84 without origin", "origin: {latitude_deg: ..., longitude_deg: ...}")
        return self

    @property
    def reads_file(self) -> bool:
        """Whether the route comes from a waypoint file, which may bring a speed."""
        return any(route is not None and route.file is not None for route in (self.waypoints, self.survey))

    def build(self, site: Site) -> Route:
        """The subpaths, once and forwards."""
        kind = exactly_one(self, _ROUTES, "kinds of route")
        if self.segments is None:
            with within(kind):
                route: Route = getattr(self, kind).build(site)
                return route
        segments = []
        for number, spec in enumerate(self.segments):
            with within(f"segments[{number}]"):
                segments.append(spec.build(site))
        return Route(segments, [])


def load(name_or_path: str, hull: Vehicle | None = None) -> Mission:
    """Read a mission file, or a waypoint file with a mission assumed around it.

    Args:
        name_or_path: a path, or a shipped name such as ``paper_composite``.
        hull: the vehicle whose drag turns a speed into a thrust; the default vehicle if None.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    source = config_files.find("missions", name_or_path)
    assumed = bare_file.assumed(source) if bare_file.is_bare(source) else None
    if assumed is None:
        spec = yaml_file.load(source, MissionSpec)
    else:
        spec = validated(MissionSpec, assumed, str(source))
    site = Site(spec.frame, spec.origin, source.parent)
    try:
        check_size(spec)
        route = spec.build(site)
        path, once = _path(spec, route)
        speed = file_offers.speed(site, spec.thrust, spec.speed)
        geofence = _geofence(spec, site)
        if assumed is not None:
            site.notices.insert(0, bare_file.notice(assumed, source, speed or bare_file.SPEED))
    except ArithmeticError as error:
        kind = exactly_one(spec, _ROUTES, "kinds of route")
        found = f"numbers that no path can be computed from ({error})"
        raise ConfigurationError(f"{source}: {kind}", found, "lengths in metres, angles in degrees") from None
    except ConfigurationError as error:
        where = error.where.removeprefix(f"waypoints.file: {source.name}: ") if assumed else error.where
        raise ConfigurationError(f"{source}: {where}", error.found, error.expected) from None
    thrust = spec.thrust
    if thrust is None:
        thrust = (hull or vehicle.load(DEFAULT_VEHICLE)).thrust_at(speed or 0.0)
    return Mission(
        name=spec.name,
        path=path,
        thrust=thrust,
        source=source,
        description=spec.description,
        speed=speed,
        switching=spec.switching,
        origin=spec.origin,
        waypoints=tuple(route.waypoints),
        area=route.area,
        once=once,
        files=tuple(site.files),
        limits=spec.limits,
        geofence=geofence,
        notices=tuple(site.notices),
        assumed=assumed,
    )


def _geofence(spec: MissionSpec, site: Site) -> tuple[Point, ...]:
    if spec.geofence is None:
        return tuple(file_offers.geofence(site))
    if isinstance(spec.geofence, GeofenceFile):
        with within("geofence"):
            corners = spec.geofence.build(site)
        file_offers.leave_geofence(site, spec.geofence.file)
    else:
        with within("geofence", joined=""):
            corners = site.points(spec.geofence)
        file_offers.leave_geofence(site)
    if len(corners) < 3:
        raise ConfigurationError("geofence", f"{len(corners)} corner(s)", "at least three")
    return tuple(corners)


def _path(spec: MissionSpec, route: Route) -> tuple[CompositePath, int]:
    """The whole path, and how many of its subpaths come before it repeats itself."""
    segments = reversed_path(route.segments) if spec.reverse else list(route.segments)
    once = len(segments)
    tolerance = TOLERANCE if spec.segments is not None else smoothing.TOLERANCE
    if spec.repeat > 1 and segments:
        start, end = segments[0].evaluate(0.0), segments[-1].evaluate(1.0)
        gap = math.hypot(start.x - end.x, start.y - end.y)
        if gap > tolerance:
            found = f"{spec.repeat} for a path that ends {gap:.3f} m from its start"
            raise ConfigurationError("repeat", found, "1, or a path that ends where it starts")
        if once * spec.repeat > _MOST_SUBPATHS:
            raise ConfigurationError(
                "repeat", f"{once * spec.repeat} subpaths in all", f"at most {_MOST_SUBPATHS}"
            )
    return CompositePath(segments * spec.repeat, tolerance), once
