"""The keys of a mission file."""

from __future__ import annotations

from typing import Annotated, Literal

import pydantic

from auv_msgs_py.settings.schema import Auto, setting, settings
from auv_msgs_py.settings.validators import exactly_one, no_boolean, unfit
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.spatial_spline import SpatialSpline
from auv_path_following.curves.switching_modes import LISTED, SwitchingMode
from auv_path_following.missions.depth_keys import AltitudeSpec, DepthProfileSpec, LimitsSpec
from auv_path_following.missions.geodesy import Origin
from auv_path_following.missions.routes.generator_specs import (
    FigureOfEightSpec,
    HelixSpec,
    LoiterSpec,
    SpiralSpec,
)
from auv_path_following.missions.routes.route import Route
from auv_path_following.missions.routes.route_specs import GeofenceFile, SurveySpec, WaypointsSpec
from auv_path_following.missions.segment_specs import SegmentSpec
from auv_path_following.missions.site import Frame, Point, Site, within
from auv_path_following.missions.spatial_mission import with_depths


@settings
class MissionSwitching:
    """Circles of acceptance of a mission, Eq. (44); the parameters decide what is left out."""

    mode: SwitchingMode | None = setting(None, f"joints with a circle: {LISTED}")
    radius: Auto | None = setting(
        None, "radius Rk of the circles; 0 or auto: computed for each corner", unit="m", ge=0.0, le=1000.0
    )


_Version = Annotated[Literal[1], pydantic.BeforeValidator(no_boolean)]
_Count = Annotated[int, pydantic.Field(ge=1, le=10000)]
_Geofence = Annotated[
    Annotated[tuple[Point, ...], pydantic.Tag("(corners)")] | Annotated[GeofenceFile, pydantic.Tag("(file)")],
    pydantic.Discriminator(lambda value: "(file)" if isinstance(value, dict | GeofenceFile) else "(corners)"),
]
#: The keys that hold a route; a mission has one of them.
ROUTES = ("segments", "waypoints", "survey", "spiral", "figure_of_eight", "loiter", "helix")


@settings
class MissionSpec:
    """A whole mission file."""

    version: _Version = setting(doc="version of this format")
    name: str = setting(doc="name of the mission")
    description: str = setting("", "description")
    frame: Frame = setting(
        doc="of all points: ned [north, east] m, enu [east, north] m, wgs84 [latitude, longitude] deg"
    )
    origin: Origin | None = setting(None, "where north 0, east 0 is; needed for degrees")
    thrust: float | None = setting(None, "constant thrust on the way", unit="N", gt=0.0)
    speed: float | None = setting(
        None, "instead of thrust: speed through the water", unit="m/s", gt=0.0, le=20.0
    )
    switching: MissionSwitching = setting(factory=MissionSwitching, doc="circles of acceptance")
    limits: LimitsSpec = setting(factory=LimitsSpec, doc="what ends the mission early")
    geofence: _Geofence | None = setting(
        None, "area that must not be left: its corners, or {file, feature} of a waypoint file"
    )
    reverse: bool = setting(False, "follow the path from its end to its start")
    repeat: _Count = setting(1, "number of times that a closed path is followed")
    depth: float | None = setting(None, "constant depth, positive down in every frame", unit="m", ge=0.0)
    depth_profile: DepthProfileSpec | None = setting(None, "depth over the horizontal length of the route")
    altitude: AltitudeSpec | None = setting(None, "instead of a depth: altitude above the bottom")
    segments: tuple[SegmentSpec, ...] | None = setting(None, "the subpaths, in order")
    waypoints: WaypointsSpec | None = setting(None, "points to pass")
    survey: SurveySpec | None = setting(None, "lawnmower pattern over a polygon")
    spiral: SpiralSpec | None = setting(None, "outwards around a point")
    figure_of_eight: FigureOfEightSpec | None = setting(None, "two loops and two lines that cross")
    loiter: LoiterSpec | None = setting(None, "around a circle")
    helix: HelixSpec | None = setting(None, "around a circle from one depth to another")

    @pydantic.model_validator(mode="after")
    def _fits(self) -> MissionSpec:
        exactly_one(self, ROUTES, "kinds of route")
        if not self.reads_file or (self.thrust, self.speed) != (None, None):
            exactly_one(self, ("thrust", "speed"), "of thrust and speed")
        if self.frame == "wgs84" and self.origin is None:
            raise unfit("frame wgs84 without origin", "origin: {latitude_deg: ..., longitude_deg: ...}")
        return self

    @property
    def reads_file(self) -> bool:
        """Whether the route comes from a waypoint file, which may contain a speed."""
        return any(route is not None and route.file is not None for route in (self.waypoints, self.survey))

    def build(self, site: Site) -> Route:
        """Return the route, once and forwards."""
        kind = exactly_one(self, ROUTES, "kinds of route")
        if self.segments is None:
            with within(kind):
                route: Route = getattr(self, kind).build(site)
                return route
        segments: list[Segment | SpatialSpline] = []
        for number, spec in enumerate(self.segments):
            with within(f"segments[{number}]"):
                segments.append(spec.build(site))
        subpaths = with_depths(segments)
        if subpaths:
            return Route(
                [one.plan for one in subpaths], [], subpaths=subpaths, depth_key="spline with depths"
            )
        return Route([one for one in segments if not isinstance(one, SpatialSpline)], [])
