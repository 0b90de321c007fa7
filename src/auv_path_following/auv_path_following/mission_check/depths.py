"""Judges the depths of a mission: slope, vertical curvature, range of depth, speed, corners."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.control.pitch_plane import pitch_gains, pitch_plane_of
from auv_path_following.control.reference_model import limits_of
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_segment import Lifted
from auv_path_following.guidance.spatial.spatial_limits import steepest_at, steepest_of
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.mission_check.depth_survey import DepthSurvey, survey_of
from auv_path_following.mission_check.finding import Finding, at
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle

#: Pitch that is left to correct with on the steepest slope, rad.
SPARE = math.radians(5.0)
#: Share of the largest pitch rate that the path may take.
_RATE_SHARE = 0.5
#: Vertical corners above this are cut visibly whatever the circle of acceptance, rad.
_SHARP = math.radians(20.0)
#: Turn of the elevation from which on a joint is a vertical corner, rad.
_CORNER = math.radians(0.1)
#: Differences below this are rounding, m.
_ROUNDING = 1e-6


class DepthBounds(NamedTuple):
    """What a vehicle and a mission allow.

    Attributes:
        steepest: theta_max, rad, Eq. (3D-29).
        slope: steepest slope of a path, rad.
        radius: least radius of its vertical curvature, m.
        surface, deepest: range of depth, m.
    """

    steepest: float
    slope: float
    radius: float
    surface: float
    deepest: float


def bounds_of(mission: Mission, vehicle: Vehicle, speed: float) -> DepthBounds:
    """Return the bounds of a mission's depths.

    Args:
        mission: with its own limits.
        vehicle: with stern planes.
        speed: through the water, m/s.
    """
    steepest = steepest_at(steepest_of(vehicle, mission.thrust), speed)
    slope = steepest - SPARE
    if mission.max_slope > 0.0:
        slope = min(slope, mission.max_slope)
    deepest = vehicle.depth.max
    if mission.limits.max_depth > 0.0:
        deepest = min(deepest, mission.limits.max_depth)
    radius = speed / (_RATE_SHARE * _pitch_rate(vehicle, speed))
    return DepthBounds(steepest, slope, radius, vehicle.depth.surface, deepest)


def _pitch_rate(vehicle: Vehicle, speed: float) -> float:
    """Return the largest pitch rate, rad/s: that of the reference, and the steady one under full planes.

    In a steady rate the planes' moment is that of the damping, |Mqq| q^2 + |Muq| u q = |Muud| u^2 ds_max.
    """
    side = pitch_plane_of(vehicle)
    if side.hull is None:
        return math.inf if vehicle.pitching is None else vehicle.pitching.rate
    rate = limits_of(pitch_gains().reference, side, side.rudder.max_rate).rate
    quadratic, linear = abs(side.hull.Nrr), abs(side.hull.Nur) * speed
    moment = abs(side.hull.Nuud) * speed * speed * side.rudder.max_angle
    steady = (math.sqrt(linear * linear + 4.0 * quadratic * moment) - linear) / (2.0 * quadratic)
    return min(rate, steady)


def depths(
    mission: Mission, vehicle: Vehicle, switching: SwitchingConfig, speed: float, sinking: float = 0.0
) -> Iterator[Finding]:
    """Judge the depths of a mission, or its altitude; nothing of a planar one.

    Args:
        mission, vehicle: what is flown, and what flies it.
        switching: which joints have a circle of acceptance.
        speed: through the water, m/s.
        sinking: current downwards, m/s.
    """
    if mission.spatial is None and mission.altitude is None:
        return
    if not vehicle.dives:
        found = "a mission with a depth" if mission.altitude is None else "a mission at an altitude"
        expected = "stern planes, as remus100_6dof has them, or a planar mission"
        yield Finding("refused", f"vehicle {vehicle.name}", f"no stern planes for {found}", expected)
        return
    slowest = vehicle.depth.minimum_speed
    if speed < slowest:
        expected = f"at least {slowest:g} m/s, below which the stern planes hold no depth"
        yield Finding("refused", "speed", f"{speed:.2f} m/s through the water", expected)
        return
    if mission.altitude is not None and mission.limits.min_altitude > mission.altitude.above_bottom:
        found = f"{mission.limits.min_altitude:g} m with an altitude of {mission.altitude.above_bottom:g} m"
        yield Finding("refused", "limits.min_altitude", found, "less than altitude.above_bottom")
    if mission.spatial is not None:
        judge = _Judge(mission.spatial, survey_of(mission.spatial, mission.once), vehicle)
        bounds = bounds_of(mission, vehicle, speed)
        yield from judge.range_of_depth(bounds)
        yield from judge.slope(bounds, speed, sinking)
        yield from judge.curvature(bounds, speed)
        yield from judge.corners(mission.once, switching)


def through_water(gamma: npt.NDArray[np.float64], speed: float, sinking: float) -> npt.NDArray[np.float64]:
    """Return the elevation through the water that holds a path's in a vertical current, rad, up positive.

    Args:
        gamma: elevation of the path, rad, up positive.
        speed: through the water, m/s.
        sinking: current downwards, m/s; at most `speed`.
    """
    down = -np.sin(gamma)
    along = down * sinking + np.sqrt(np.maximum(speed**2 - sinking**2 * np.cos(gamma) ** 2, 0.0))
    return np.arcsin(np.clip((sinking - along * down) / speed, -1.0, 1.0))


class _Judge:
    def __init__(self, path: SpatialPath, survey: DepthSurvey, vehicle: Vehicle) -> None:
        self._path, self._survey, self._vehicle = path, survey, vehicle

    def _finding(self, k: int, found: str, expected: str) -> Finding:
        """Return a refusal at sample k."""
        s = self._survey
        i, t, way = int(s.i[k]), float(s.t[k]), float(s.way[k])
        point = self._path.evaluate(i, t)
        place = f"subpath {i + 1} ({self._path.plan.segments[i].kind}) {at(point.x, point.y)}"
        where = f"{place}, {way:.1f} m along the path, at a depth of {point.z:.1f} m"
        return Finding("refused", where, found, expected, way)

    def range_of_depth(self, bounds: DepthBounds) -> Iterator[Finding]:
        """Judge the deepest place, and places above the surface limit between start and end."""
        z, way = self._survey.z, self._survey.way
        k = int(np.argmax(z))
        if z[k] > bounds.deepest + _ROUNDING:
            own = bounds.deepest == self._vehicle.depth.max
            whose = f"depth.max of {self._vehicle.name}" if own else "limits.max_depth of the mission"
            expected = f"at most {bounds.deepest:g} m, {whose}"
            yield self._finding(k, f"a depth of {z[k]:.2f} m", expected)
        shallow = z < bounds.surface - _ROUNDING
        deep = np.flatnonzero(~shallow)
        if len(deep):
            # From the start straight down to the range, and from there straight up to the end, is no fault.
            down = (np.diff(z) > 0.0) | (np.diff(way) < _ROUNDING)
            up = (np.diff(z) < 0.0) | (np.diff(way) < _ROUNDING)
            if bool(np.all(down[: deep[0]])):
                shallow[: deep[0]] = False
            if bool(np.all(up[deep[-1] :])):
                shallow[deep[-1] :] = False
        if bool(np.any(shallow)):
            k = int(np.argmin(np.where(shallow, z, np.inf)))
            expected = f"at least {bounds.surface:g} m, depth.surface of {self._vehicle.name}"
            yield self._finding(k, f"a depth of {z[k]:.2f} m between start and end", expected)

    def slope(self, bounds: DepthBounds, speed: float, sinking: float) -> Iterator[Finding]:
        """Judge the steepest place: as a slope, and as the pitch that it takes in a vertical current."""
        gamma, pitch = np.abs(self._survey.gamma), self._survey.gamma
        if sinking != 0.0:
            pitch = through_water(pitch, speed, sinking)
        slope, is_limited = max(bounds.slope, 0.0), bounds.slope < bounds.steepest - SPARE
        excess = np.abs(pitch) - max(bounds.steepest - SPARE, 0.0)
        if is_limited:
            excess = np.maximum(excess, gamma - slope)
        k = int(np.argmax(excess))
        if excess[k] <= slope * 1e-6 + 1e-9:
            return
        way = "up" if self._survey.gamma[k] > 0.0 else "down"
        found = f"a slope of {math.degrees(gamma[k]):.1f} deg {way}"
        if sinking != 0.0:
            water = f"{abs(sinking):g} m/s of water {'down' if sinking > 0.0 else 'up'}"
            found += f", a pitch of {math.degrees(pitch[k]):.1f} deg in {water}"
        found += self._others(excess > 0.0)
        expected = f"at most {math.degrees(bounds.slope):.1f} deg, limits.max_slope_deg"
        if not is_limited or gamma[k] <= slope:
            steepest = math.degrees(bounds.steepest)
            expected = (
                f"at most {steepest - 5.0:.1f} deg: the pitch of up to {steepest:.1f} deg at {speed:.2f} m/s"
                " less 5 to correct with"
            )
        yield self._finding(k, found, expected + self._longer(k, bounds))

    def curvature(self, bounds: DepthBounds, speed: float) -> Iterator[Finding]:
        """Judge the place that bends most up or down."""
        bend = np.abs(self._survey.bend)
        k, limit = int(np.argmax(bend)), 1.0 / bounds.radius
        if bend[k] <= limit * (1.0 + 1e-6):
            return
        found = f"a vertical radius of {1.0 / bend[k]:.1f} m{self._others(bend > limit)}"
        expected = f"at least {bounds.radius:.1f} m: half of the largest pitch rate at {speed:.2f} m/s"
        yield self._finding(k, found, expected + self._longer(k, bounds))

    def _others(self, at_fault: npt.NDArray[np.bool_]) -> str:
        others = len(np.unique(self._survey.i[at_fault])) - 1
        return f" (likewise on {others} more)" if others > 0 else ""

    def _longer(self, k: int, bounds: DepthBounds) -> str:
        """Return the length that would do for the ramp of sample k."""
        subpath = self._path.subpaths[int(self._survey.i[k])]
        if not isinstance(subpath, Lifted):
            return "; points further apart would do"
        if bounds.slope <= 0.0:
            return ""
        before, after = subpath.profile.knots[subpath.ramp : subpath.ramp + 2]
        rise = abs(after.depth - before.depth)
        length = subpath.profile.least_length(rise, math.tan(bounds.slope), bounds.radius)
        ramp = f"the ramp from {before.depth:g} to {after.depth:g} m"
        return f"; {ramp} needs {length:.1f} m of path, now {after.way - before.way:.1f} m"

    def corners(self, once: int, switching: SwitchingConfig) -> Iterator[Finding]:
        """Warn of vertical corners that no circle of acceptance rounds."""
        tilts = [abs(joint.gamma_out - joint.gamma_in) for joint in self._path.joints[:once]]
        least = _CORNER if switching.mode == "off" else _SHARP
        sharp = [number for number, tilt in enumerate(tilts) if tilt > least]
        if not sharp:
            return
        worst = max(sharp, key=lambda number: tilts[number])
        joint = self._path.joints[worst]
        count = "a vertical corner" if len(sharp) == 1 else f"{len(sharp)} vertical corners, the sharpest one"
        found = f"{count} of {math.degrees(tilts[worst]):.0f} deg"
        expected = "depth_profile.kind or depth_ramp smooth, since it is cut by decimetres"
        if switching.mode == "off":
            found, expected = f"{found} with switching off", f"{expected}, or switching g0"
        place = f"joint {worst + 1} {at(joint.x, joint.y)}, at a depth of {joint.z:.1f} m"
        yield Finding("warning", place, found, expected)
