"""Judges the current along a path, and its turns against the vehicle's tightest."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.types import Current
from auv_path_following.control.hull_model import SteadyTurn
from auv_path_following.curves.outline import look, tightest
from auv_path_following.guidance.laws.ailos import AilosConfig
from auv_path_following.mission_check.finding import Finding, at
from auv_path_following.missions.mission_file import Mission

Array = npt.NDArray[np.float64]

#: Share of the vehicle's turning ability above which a turn leaves little to steer with.
_AMPLE = 0.8
#: Less way over ground than this share of the speed through the water is warned of.
_LITTLE_WAY = 0.2


class LapSurvey:
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
        found = f"{against}, which leaves {self._ground[k]:.2f} m/s along the path"
        found += f" on course {math.degrees(self._chi[k]) % 360.0:.0f} deg"
        if self._ground[k] <= 0.0:
            yield Finding("refused", place, found, "a speed along the path above 0 everywhere")
        elif self._ground[k] < _LITTLE_WAY * self._speed:
            yield Finding("warning", place, found, "more, or the mission takes long")

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
