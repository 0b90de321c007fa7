"""Read a mission file: the path to follow, the thrust on the way and what ends the mission."""

from __future__ import annotations

import dataclasses
import hashlib
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any

from auv_msgs_py.settings import result_files, yaml_file
from auv_msgs_py.settings.schema import validated
from auv_msgs_py.settings.validators import exactly_one
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.reverse import reversed_path
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.missions import bare_file, file_offers
from auv_path_following.missions.depth_keys import AltitudeSpec
from auv_path_following.missions.geodesy import Origin
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.missions.mission_spec import ROUTES, MissionSpec, MissionSwitching
from auv_path_following.missions.routes import smoothing
from auv_path_following.missions.routes.route import Route
from auv_path_following.missions.routes.route_specs import GeofenceFile
from auv_path_following.missions.site import Point, Site, check_size, within
from auv_path_following.missions.spatial_mission import ONE_DEPTH, spatial_path
from auv_path_following.vehicle import Vehicle

#: Gap allowed at the joints of segments that are typed in, m.
TOLERANCE = 1e-3
DEFAULT_VEHICLE = "remus100"
#: Most subpaths of a path, repetitions included.
_MOST_SUBPATHS = 100_000

_NO_OVERRIDES = MissionSwitching(mode=None, radius=None)
_NO_LIMITS = LimitsConfig()


@dataclasses.dataclass(frozen=True)
class Mission:
    """A mission that can be flown.

    Attributes:
        name, description: of the mission.
        path: to follow, NED, all repetitions included; in three dimensions the plan of `spatial`.
        thrust: constant thrust on the way, N, greater than 0.
        source: the mission file, or a bare waypoint file.
        speed: speed through the water that the file asks for, m/s; None where it gives the thrust.
        switching: circles of acceptance that the file asks for.
        origin: position of north 0, east 0; None where the file has none.
        waypoints: (north, east), m, of the path; empty for a path without.
        area: corners (north, east), m, of the polygon that is surveyed; empty for other routes.
        once: number of subpaths before the path repeats itself.
        limits: that end it early; the parameters may be stricter.
        geofence: corners (north, east), m, of the area that must not be left; empty for none.
        files: waypoint files of the mission, in its own folder or below.
        notices: parts of those files that are not flown, one line each.
        assumed: the mission file that was assumed around a bare waypoint file; None where `source` is one.
        spatial: the path with its depths; None for a planar mission, or one above the bottom.
        altitude: to hold above the bottom; None otherwise.
        max_slope: steepest slope that the file allows, rad; 0 for any.
        text: content of the mission where it comes from no file; empty otherwise.
    """

    name: str
    path: CompositePath
    thrust: float
    source: Path
    description: str
    speed: float | None = None
    switching: MissionSwitching = _NO_OVERRIDES
    origin: Origin | None = None
    waypoints: tuple[Point, ...] = ()
    area: tuple[Point, ...] = ()
    once: int = 0
    files: tuple[Path, ...] = ()
    limits: LimitsConfig = _NO_LIMITS
    geofence: tuple[Point, ...] = ()
    notices: tuple[str, ...] = ()
    assumed: dict[str, Any] | None = None
    spatial: SpatialPath | None = None
    altitude: AltitudeSpec | None = None
    max_slope: float = 0.0
    text: str = ""

    @cached_property
    def digest(self) -> str:
        """The first 16 hexadecimal digits of the SHA-256 of the mission's content, read once."""
        parts = [self.text.encode()] if self.text else [p.read_bytes() for p in (self.source, *self.files)]
        found = hashlib.sha256()
        for part in parts:
            found.update(len(part).to_bytes(8, "big") + part)
        return found.hexdigest()[:16]

    def require_planar(self) -> None:
        """Refuse a mission with depths or an altitude: the vehicle has no stern planes.

        Raises:
            ConfigurationError: it is not planar.
        """
        if self.spatial is not None or self.altitude is not None:
            key, found = ("altitude", "it") if self.altitude is not None else ("depth", "a path with depths")
            expected = "a planar mission, or a vehicle with stern planes, such as remus100_6dof"
            raise ConfigurationError(f"{self.source}: {key}", found, expected)

    def copy_to(self, directory: Path) -> Path:
        """Write `mission.yaml` and its waypoint files into a directory; return the mission file."""
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
    return _built(spec, source, hull, assumed)


def read_text(text: str, hull: Vehicle | None = None, where: str = "mission_text") -> Mission:
    """Read the content of a mission file.

    Args:
        text: the YAML; it names no waypoint files, because none are beside it.
        hull: as in `load`.
        where: its origin, for errors.

    Raises:
        ConfigurationError: as in `load`, or the text names a waypoint file.
    """
    source = Path(where)
    spec = yaml_file.checked(yaml_file.parse_text(text, where), source, MissionSpec)
    if spec.reads_file or isinstance(spec.geofence, GeofenceFile):
        raise ConfigurationError(where, "a waypoint file", "all points in the text: no file is beside it")
    return dataclasses.replace(_built(spec, source, hull, None), text=text)


def _built(spec: MissionSpec, source: Path, hull: Vehicle | None, assumed: dict[str, Any] | None) -> Mission:
    """Return the mission of a file's content."""
    site = Site(spec.frame, spec.origin, source.parent)
    with _errors_of(source, spec, is_assumed=assumed is not None):
        check_size(spec)
        route = spec.build(site)
        path, once = _path(spec, route)
        spatial = _spatial(spec, route)
        speed = file_offers.speed(site, spec.thrust, spec.speed)
        geofence = _geofence(spec, site)
    if assumed is not None:
        site.notices.insert(0, bare_file.notice(assumed, source, speed or bare_file.SPEED))
    thrust = spec.thrust
    if thrust is None:
        thrust = (hull or vehicle.load(DEFAULT_VEHICLE)).thrust_at(speed or 0.0)
    if spatial is not None:  # divided where ramps meet
        path, once = spatial.plan, spatial.n // spec.repeat
    return Mission(
        name=spec.name, path=path, thrust=thrust, source=source, description=spec.description, speed=speed,
        switching=spec.switching, origin=spec.origin, waypoints=tuple(route.waypoints), area=route.area,
        once=once, files=tuple(site.files), limits=spec.limits, geofence=geofence,
        notices=tuple(site.notices), assumed=assumed,
        spatial=spatial, altitude=spec.altitude, max_slope=math.radians(spec.limits.max_slope_deg),
    )  # fmt: skip


@contextmanager
def _errors_of(source: Path, spec: MissionSpec, is_assumed: bool) -> Iterator[None]:
    """Put the file in front of the place of an error; report an overflow as an error of the route."""
    try:
        yield
    except ArithmeticError as error:
        kind = exactly_one(spec, ROUTES, "kinds of route")
        found = f"numbers that no path can be computed from ({error})"
        raise ConfigurationError(f"{source}: {kind}", found, "lengths in metres, angles in degrees") from None
    except ConfigurationError as error:
        where = error.where.removeprefix(f"waypoints.file: {source.name}: ") if is_assumed else error.where
        raise ConfigurationError(f"{source}: {where}", error.found, error.expected) from None


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
    """Return the whole path, and the number of its subpaths before it repeats itself."""
    segments = reversed_path(route.segments) if spec.reverse else list(route.segments)
    once = len(segments)
    tolerance = TOLERANCE if spec.segments is not None else smoothing.TOLERANCE
    if spec.repeat > 1 and segments:
        _check_repeat(segments, spec.repeat, tolerance)
    return CompositePath(segments * spec.repeat, tolerance), once


def _spatial(spec: MissionSpec, route: Route) -> SpatialPath | None:
    """Return the path with its depths."""
    if spec.altitude is not None:
        names = ("depth", "depth_profile", route.depth_key)
        given = (spec.depth is not None, spec.depth_profile is not None, bool(route.depth_key))
        others = [name for name, is_given in zip(names, given, strict=True) if is_given]
        if others:
            raise ConfigurationError("altitude", f"it beside {' and '.join(others)}", ONE_DEPTH)
    return spatial_path(route, spec.depth, spec.depth_profile, spec.reverse, spec.repeat)


def _check_repeat(segments: Sequence[Segment], repeat: int, tolerance: float) -> None:
    start, end = segments[0].evaluate(0.0), segments[-1].evaluate(1.0)
    gap = math.hypot(start.x - end.x, start.y - end.y)
    if gap > tolerance:
        found = f"{repeat} for a path that ends {gap:.3f} m from its start"
        raise ConfigurationError("repeat", found, "1, or a path that ends where it starts")
    if len(segments) * repeat > _MOST_SUBPATHS:
        raise ConfigurationError(
            "repeat", f"{len(segments) * repeat} subpaths in all", f"at most {_MOST_SUBPATHS}"
        )
