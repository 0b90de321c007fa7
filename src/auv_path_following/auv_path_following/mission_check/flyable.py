"""Judges whether a vehicle can fly a mission: refusals, warnings, and the duration."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import NO_CURRENT, Current, SpatialCurrent
from auv_path_following.control.hull_model import SteadyTurn, tightest_turn
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.mission_check.circles import circles
from auv_path_following.mission_check.crossings import Crossing, crossings
from auv_path_following.mission_check.curvature_steps import curvature_steps
from auv_path_following.mission_check.depths import depths
from auv_path_following.mission_check.finding import Finding, at
from auv_path_following.mission_check.lap_survey import LapSurvey
from auv_path_following.missions.limits import Point
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle

Array = npt.NDArray[np.float64]

_MOST_CROSSINGS = 100
#: Shares of the largest speed below which a thrust in per cent or rpm is warned of and refused. The 6.48 N of
#: the shipped missions make 0.25 of it when read as per cent, and less than 0.05 as rpm of 1500.
_SLOW, _STANDING = 0.3, 0.1


@dataclass(frozen=True)
class Findings:
    """All that `check` found.

    Attributes:
        refusals, warnings: the findings of each level, the most important first.
        notices: what is ignored of the mission's files, one line each.
        turn: the vehicle's tightest turn.
        speed: through the water, straight ahead, m/s.
        duration: of the whole mission at that speed, in the current, s; infinite where it makes no way.
    """

    refusals: tuple[Finding, ...]
    warnings: tuple[Finding, ...]
    turn: SteadyTurn
    speed: float
    duration: float
    notices: tuple[str, ...] = ()


def check(
    mission: Mission,
    vehicle: Vehicle,
    current: Current | SpatialCurrent = NO_CURRENT,
    switching: SwitchingConfig | None = None,
    lookahead: float | None = None,
) -> Findings:
    """Judge a mission.

    Args:
        mission: what to fly.
        vehicle: the vehicle that flies it.
        current: constant current, NED, m/s; without a third component its vertical one is 0.
        switching: circles of acceptance as they will be; the parameters' defaults if None.
        lookahead: Delta of guidance, m; the parameters' default if None.

    Raises:
        ConfigurationError: the vehicle's turning ability cannot be found.
    """
    speed = vehicle.speed_at(mission.thrust)
    lookahead = lookahead or PathFollowerConfig().lookahead
    turn = tightest_turn(vehicle)
    level, sinking = Current(*current[:2]), sum(current[2:])
    survey = LapSurvey(mission, level, speed)
    found = [
        *_thrust(mission, vehicle, speed),
        *depths(mission, vehicle, switching or SwitchingConfig(), speed, sinking),
        *_geofence(mission),
        *survey.way(level),
        *survey.turns(turn, vehicle.name),
        *_corners(mission),
        *curvature_steps(mission, vehicle, speed),
        *circles(mission, vehicle, switching or SwitchingConfig(), lookahead, speed, level),
        *_crossings(mission),
    ]
    refusals, warnings = (
        tuple(finding for finding in found if finding.level == level) for level in ("refused", "warning")
    )
    stretch = 1.0 if mission.spatial is None else mission.spatial.length / mission.path.length
    return Findings(refusals, warnings, turn, speed, survey.duration * stretch, mission.notices)


def require_planes(vehicle: Vehicle, options: Mapping[str, float | None]) -> None:
    """Refuse options that need stern planes.

    Args:
        vehicle: the hull.
        options: flag -> value; None where it was not given.

    Raises:
        ConfigurationError: the vehicle has none.
    """
    for flag, value in options.items():
        if value is not None and not vehicle.dives:
            expected = "a vehicle with stern planes, such as remus100_6dof"
            raise ConfigurationError(flag, f"vehicle {vehicle.name} without stern planes", expected)


def refusal(mission: Mission, findings: Findings, advice: str) -> ConfigurationError:
    """Return the first refusal as an error of the mission's file, in one line.

    Args:
        mission: the mission.
        findings: with at least one refusal.
        advice: what else can be done.
    """
    more = f" (and {len(findings.refusals) - 1} more)" if len(findings.refusals) > 1 else ""
    return _as_error(mission, findings.refusals[0], more + _advised(mission, advice))


def refusals(mission: Mission, findings: Findings, advice: str) -> list[ConfigurationError]:
    """Return all refusals as errors of the mission's file, the last one with the advice."""
    *others, last = findings.refusals
    return [
        *(_as_error(mission, one, "") for one in others),
        _as_error(mission, last, _advised(mission, advice)),
    ]


def _advised(mission: Mission, advice: str) -> str:
    """Return the advice; none where nothing overrides the refusal of a mission with a depth."""
    return f"; {advice}" if mission.spatial is None and mission.altitude is None else ""


def _as_error(mission: Mission, finding: Finding, more: str) -> ConfigurationError:
    where = f"{mission.source}: {finding.where}"
    return ConfigurationError(where, finding.found, f"{finding.expected}{more}")


def _thrust(mission: Mission, vehicle: Vehicle, speed: float) -> Iterator[Finding]:
    yield from _wrong_unit(mission, vehicle, speed)
    if mission.thrust > vehicle.thrust_max * (1.0 + 1e-9):
        if mission.speed is not None:
            fastest = vehicle.speed_at(vehicle.thrust_max)
            limit = f"at most {fastest:.2f} m/s, all that {vehicle.name} reaches"
            yield Finding("refused", "speed", f"{mission.speed:g} m/s", limit)
        else:
            unit = vehicle.thrust_symbol
            limit = f"at most {vehicle.thrust_max:g} {unit}, all that {vehicle.name} has"
            yield Finding("refused", "thrust", f"{mission.thrust:g} {unit}", limit)


def _wrong_unit(mission: Mission, vehicle: Vehicle, speed: float) -> Iterator[Finding]:
    """Find a thrust that is probably in newtons although the vehicle takes another unit; `speed` in m/s."""
    share = speed / vehicle.speed_at(vehicle.thrust_max)
    if mission.speed is None and vehicle.thrust_unit != "N" and share < _SLOW:
        unit = vehicle.thrust_symbol
        found = f"{mission.thrust:g} {unit}, which makes {speed:.2f} m/s"
        expected = f"a thrust in {unit} (at most {vehicle.thrust_max:g}), or a speed"
        yield Finding("refused" if share < _STANDING else "warning", "thrust", found, expected)


def _geofence(mission: Mission) -> Iterator[Finding]:
    if mission.geofence:
        x, y, _ = mission.path.polyline(1.0)
        outside = np.flatnonzero(~_inside(mission.geofence, x, y))
        if len(outside):
            k = outside[0]
            found = f"{len(outside)} m of path outside the geofence, the first {at(x[k], y[k])}"
            yield Finding("refused", "geofence", found, "all of the path inside it")


def _inside(polygon: Sequence[Point], x: Array, y: Array) -> npt.NDArray[np.bool_]:
    """Return which points are in a polygon: `limits.inside` for many points."""
    result = np.zeros(len(x), bool)
    for (ax, ay), (bx, by) in zip(polygon, (polygon[-1], *polygon[:-1]), strict=True):
        if ay != by:
            result ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) / (by - ay) * (bx - ax))
    return result


def _corners(mission: Mission) -> Iterator[Finding]:
    corners = [joint for joint in mission.path.joints[: mission.once] if joint.geometric == "G0"]
    if corners:
        sharpest = max(corners, key=lambda joint: abs(joint.angle_step))
        count = "a corner" if len(corners) == 1 else f"{len(corners)} corners, the sharpest one"
        found = f"{count} of {abs(math.degrees(sharpest.angle_step)):.0f} deg (G0)"
        place = f"joint {sharpest.index} {at(sharpest.x, sharpest.y)}"
        yield Finding("warning", place, found, "a smoothing, since no vehicle turns on the spot")


def _crossings(mission: Mission) -> Iterator[Finding]:
    found = [one for one in crossings(mission.path.segments[: mission.once], _MOST_CROSSINGS)
             if not _above_one_another(mission, one)]  # fmt: skip
    if found:
        first = found[0]
        times = "once" if len(found) == 1 else f"{len(found)} times"
        if len(found) == _MOST_CROSSINGS:
            times = f"at least {times}"
        place = f"subpaths {first.first} and {first.second} {at(first.x, first.y)}"
        yield Finding(
            "warning",
            place,
            f"a path that crosses itself {times}",
            "an intentional crossing: subpaths are followed in their order",
        )


def _above_one_another(mission: Mission, crossing: Crossing) -> bool:
    """Return whether the two subpaths of a crossing are at different depths all along."""
    if mission.spatial is None:
        return False
    one, other = (mission.spatial.subpaths[number - 1].knots for number in crossing[:2])
    one_range, other_range = ([knot.depth for knot in knots] for knots in (one, other))
    upper, lower = sorted((one_range, other_range), key=lambda depths: (min(depths), max(depths)))
    return max(upper) <= min(lower) and min(upper) < max(lower)
