"""Judges whether a vehicle can fly a mission: refusals, warnings, and the duration."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.control.hull_model import SteadyTurn, tightest_turn
from auv_path_following.curves.outline import look, tightest
from auv_path_following.guidance.laws.ailos import AilosConfig
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.missions.limits import inside
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.mission_check.circles import circles
from auv_sim.checks.mission_check.crossings import Crossing, crossings
from auv_sim.checks.mission_check.curvature_steps import curvature_steps
from auv_sim.checks.mission_check.depths import depths
from auv_sim.checks.mission_check.finding import Finding, at

Array = npt.NDArray[np.float64]

#: Share of the vehicle's turning ability above which a turn leaves little to steer with.
_AMPLE = 0.8
#: Less way over ground than this share of the speed through the water is warned of.
_LITTLE_WAY = 0.2
_MOST_CROSSINGS = 100


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
    current: Current = NO_CURRENT,
    switching: SwitchingConfig | None = None,
    lookahead: float | None = None,
) -> Findings:
    """Judge a mission.

    Args:
        mission: what to fly.
        vehicle: the vehicle that flies it.
        current: constant current, NED, m/s.
        switching: circles of acceptance as they will be; the parameters' defaults if None.
        lookahead: Delta of guidance, m; the parameters' default if None.

    Raises:
        ConfigurationError: the vehicle's turning ability cannot be found.
    """
    speed = vehicle.speed_at(mission.thrust)
    lookahead = lookahead or PathFollowerConfig().lookahead
    turn = tightest_turn(vehicle)
    survey = _Survey(mission, current, speed)
    found = [
        *_thrust(mission, vehicle),
        *depths(mission, vehicle, switching or SwitchingConfig(), speed),
        *_geofence(mission),
        *survey.way(current),
        *survey.turns(turn, vehicle.name),
        *_corners(mission),
        *curvature_steps(mission, vehicle, speed),
        *circles(mission, vehicle, switching or SwitchingConfig(), lookahead, speed, current),
        *_crossings(mission),
    ]
    refusals, warnings = (
        tuple(finding for finding in found if finding.level == level) for level in ("refused", "warning")
    )
    stretch = 1.0 if mission.spatial is None else mission.spatial.length / mission.path.length
    return Findings(refusals, warnings, turn, speed, survey.duration * stretch, mission.notices)


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


def _thrust(mission: Mission, vehicle: Vehicle) -> Iterator[Finding]:
    if mission.thrust > vehicle.thrust_max * (1.0 + 1e-9):
        if mission.speed is not None:
            fastest = vehicle.speed_at(vehicle.thrust_max)
            limit = f"at most {fastest:.2f} m/s, all that {vehicle.name} reaches"
            yield Finding("refused", "speed", f"{mission.speed:g} m/s", limit)
        else:
            unit = vehicle.thrust_symbol
            limit = f"at most {vehicle.thrust_max:g} {unit}, all that {vehicle.name} has"
            yield Finding("refused", "thrust", f"{mission.thrust:g} {unit}", limit)


def _geofence(mission: Mission) -> Iterator[Finding]:
    if mission.geofence:
        x, y, s = mission.path.polyline(1.0)
        outside = [k for k in range(len(s)) if not inside(mission.geofence, float(x[k]), float(y[k]))]
        if outside:
            k = outside[0]
            found = f"{len(outside)} m of path outside the geofence, the first {at(x[k], y[k])}"
            yield Finding("refused", "geofence", found, "all of the path inside it")


class _Survey:
    """One lap of the path, sampled finely enough to see every bend."""

    def __init__(self, mission: Mission, current: Current, speed: float) -> None:
        self._mission, self._speed = mission, speed
        once = mission.path.segments[: mission.once]
        looks = [look(segment) for segment in once]
        self._i = np.concatenate([np.full(len(t), i) for i, (t, _) in enumerate(looks)])
        self._t = np.concatenate([t for t, _ in looks])
        chi, self._kappa, metres = (
            np.concatenate([np.asarray(getattr(p, name)) for _, p in looks])
            for name in ("chi", "kappa", "speed")
        )
        along = np.cos(chi) * current.Vx + np.sin(chi) * current.Vy
        self._chi, self._across = chi, -np.sin(chi) * current.Vx + np.cos(chi) * current.Vy
        # Speed along the path when the crab angle cancels the current across it.
        self._forward = np.sqrt(np.maximum(speed * speed - self._across**2, 0.0))
        self._ground = along + self._forward
        self.duration = self._time(metres) * mission.path.n / mission.once

    def _time(self, metres: Array) -> float:
        if not bool(np.all(self._ground > 0.0)):
            return math.inf
        slowness = metres / self._ground
        inside = np.diff(self._i) == 0
        return float(np.sum((0.5 * (slowness[1:] + slowness[:-1]) * np.diff(self._t))[inside]))

    def _place(self, i: int, t: float) -> str:
        p = self._mission.path.evaluate(i, t)
        kind = self._mission.path.segments[i].kind
        return f"subpath {i + 1} ({kind}) {at(p.x, p.y)}"

    def way(self, current: Current) -> Iterator[Finding]:
        """Judge the current: none may be too strong across the path, or ahead of the vehicle."""
        strength = math.hypot(*current)
        if strength == 0.0:
            return
        against = f"a current of {strength:.2f} m/s against a speed of {self._speed:.2f} m/s"
        limit = AilosConfig().theta_limit * self._speed
        k = int(np.argmax(np.abs(self._across)))
        course = f"on course {math.degrees(self._chi[k]) % 360.0:.0f} deg"
        if abs(self._across[k]) >= limit:
            found = f"{against}, {abs(self._across[k]):.2f} m/s of it across the path {course}"
            expected = f"at most {limit:.2f} m/s across"
            yield Finding("refused", self._place(int(self._i[k]), float(self._t[k])), found, expected)
            return
        k = int(np.argmin(self._ground))
        place = self._place(int(self._i[k]), float(self._t[k]))
        found = f"{against}, which leaves {self._ground[k]:.2f} m/s of way"
        found += f" on course {math.degrees(self._chi[k]) % 360.0:.0f} deg"
        if self._ground[k] <= 0.0:
            yield Finding("refused", place, found, "some way ahead everywhere")
        elif self._ground[k] < _LITTLE_WAY * self._speed:
            yield Finding("warning", place, found, "more, or it will take long")

    def turns(self, turn: SteadyTurn, name: str) -> Iterator[Finding]:
        """Judge the curvature against the vehicle's tightest turn.

        Over ground the path bends by kappa; through the water the track that keeps to it bends by
        kappa Ug^2 / (U sqrt(U^2 - Vn^2)): more in a current from astern, less in one from ahead.
        """
        if not bool(np.all(self._ground > 0.0)) or not bool(np.all(self._forward > 0.0)):
            return
        factor = self._ground**2 / (self._speed * self._forward)
        needed = np.abs(self._kappa) * factor
        limit = 1.0 / turn.radius
        k = int(np.argmax(needed))
        i = int(self._i[k])
        t, kappa = float(self._t[k]), float(self._kappa[k])
        if np.ptp(factor) < 1e-12:  # no current: the worst place can be found exactly
            t, kappa = tightest(self._mission.path.segments[i])
        worst = max(float(needed[k]), abs(kappa) * float(factor[k]))
        refused = worst > limit * (1.0 + 1e-9)
        if worst <= _AMPLE * limit:
            return
        tight = np.unique(self._i[needed > (limit if refused else _AMPLE * limit)])
        found = f"a turn of radius {1.0 / abs(kappa):.2f} m"
        if factor[k] > 1.0 + 1e-9:
            found += f", in this current like one of {1.0 / worst:.2f} m"
        expected = f"at least {turn.radius:.2f} m, the tightest of {name} ({turn.source})"
        if refused:
            expected += f": {turn.radius - 1.0 / worst:.2f} m too tight"
        else:
            expected += ", and some more to steer with"
        if len(tight) > 1:
            expected += f" (likewise on {len(tight) - 1} more)"
        yield Finding("refused" if refused else "warning", self._place(i, t), found, expected)


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
