"""Guidance as a whole: virtual point, switching and a line-of-sight law in their order; Eqs. (9), (17)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from auv_msgs_py.angles import wrap
from auv_msgs_py.settings import setting
from auv_msgs_py.types import NO_CURRENT, Current, Navigation, WaterVelocity
from auv_path_following.guidance.approach import Agility, ApproachConfig
from auv_path_following.guidance.law import LawInputs
from auv_path_following.guidance.laws import LAWS, law_step
from auv_path_following.guidance.progress import Progress
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.guidance.virtual_point import (
    VirtualPoint,
    VirtualPointConfig,
    path_errors,
    saturated,
    tangential_speed,
)
from auv_path_following.paths.composite import CompositePath
from auv_path_following.registry import law_of, law_settings

#: A longer gap between two updates counts as this much, s: nothing is known of what happened in it.
LONGEST_STEP = 1.0


@law_settings("law", "guidance law", LAWS)
class PathFollowerConfig:
    """Everything about guidance that is not the path."""

    compensate_current: bool = setting(True, "use the estimated current in Eqs. (22) and (31)", live=True)
    minimum_speed: float = setting(
        0.2,
        "below this speed through water beta_r and alpha mean nothing and are taken as 0",
        unit="m/s",
        ge=0.0,
        live=True,
    )
    approach: ApproachConfig = setting(factory=ApproachConfig, doc="way to the path's start")
    rejoin_reach: float = setting(
        50.0, "after a hold P is looked for at most so far ahead", unit="m", ge=0.0, le=1000.0, live=True
    )
    virtual_point: VirtualPointConfig = setting(factory=VirtualPointConfig, doc="virtual point")
    switching: SwitchingConfig = setting(factory=SwitchingConfig, doc="subpath switching")

    if TYPE_CHECKING:  # the choice and the laws' own settings

        def __init__(self, **fields: Any) -> None: ...
        def __getattr__(self, name: str) -> Any: ...

    @property
    def lookahead(self) -> float:
        """Delta of the chosen law, m; where it adapts, the largest."""
        return float(getattr(self, self.law).largest_lookahead)


class GuidanceOutput(NamedTuple):
    """One update's result with every signal a plot wants (NED, m, rad, s).

    During an approach P, its errors and its course are the approach's, s and i are 0. `approach` is what is
    left of it, m, and part of `distance_to_go`.
    """

    psi_d: float
    r_d: float
    xe: float
    ye: float
    psi_e: float
    s: float
    i: int
    x_p: float
    y_p: float
    chi_p: float
    kappa: float
    U_P: float
    beta_r: float
    chi_r: float
    alpha: float
    theta_n: float
    distance_to_go: float
    approach: float
    switched: bool
    finished: bool


class PathFollower:
    """Follows one composite path from its beginning to its end, and leads to its beginning first.

    Args:
        path: the path.
        config: laws and gains.
        agility: of the hull, for approach and bounds; None: the laws alone, with neither.
    """

    def __init__(
        self, path: CompositePath, config: PathFollowerConfig | None = None, agility: Agility | None = None
    ) -> None:
        self.path = path
        self.progress = Progress(path, agility)
        config = config or PathFollowerConfig()
        self._law: Any = None
        self._turn_rate = agility.turn_rate if agility is not None else math.inf
        self.configure(config)

    def configure(self, config: PathFollowerConfig) -> None:
        """Take new gains; the place on the path and, for the same law, its state are kept."""
        self.config = config
        self.progress.circle.config = config.switching
        self.progress.approach_config = config.approach
        self.progress.circle.lookahead = config.lookahead
        law = law_of(LAWS, config.law)
        prepared = law.prepare(getattr(config, law.name), None)
        if type(prepared) is not type(self._law):
            self._initial = self._state = law.initial
        self._law = prepared

    @property
    def virtual_point(self) -> VirtualPoint:
        """P on the path."""
        return self.progress.on_path

    def reset(self) -> None:
        """Return to the beginning of the path."""
        self.progress.reset()
        self._state = self._initial

    def rejoin(self, navigation: Navigation) -> None:
        """Go on after a hold, from where the vehicle is now: `Progress.rejoin`."""
        self.progress.rejoin(navigation, self.config.rejoin_reach)
        self._state = self._initial

    def look(self, navigation: Navigation) -> GuidanceOutput:
        """The errors as they stand while no mission runs: P rests, the vehicle's own heading is desired."""
        P = self.progress.point
        P.rest()
        point = P.point()
        xe, ye = path_errors(navigation, point, point.chi)
        return GuidanceOutput(
            psi_d=navigation.psi, r_d=0.0, xe=xe, ye=ye, psi_e=0.0, **self._place(), x_p=point.x, y_p=point.y,
            chi_p=point.chi, kappa=point.kappa, U_P=0.0, beta_r=0.0, chi_r=0.0, alpha=0.0, theta_n=0.0,
            switched=False,
        )  # fmt: skip

    def update(
        self, navigation: Navigation, water: WaterVelocity, current: Current, dt: float
    ) -> GuidanceOutput:
        """One step of guidance.

        Args:
            navigation: measured pose, NED.
            water: measured velocity through water, FRD.
            current: the observer's estimate.
            dt: seconds since the last update (0 on the first one); of a gap `LONGEST_STEP` at most counts.
        """
        config, psi, dt = self.config, navigation.psi, min(dt, LONGEST_STEP)
        if not config.compensate_current:
            current = NO_CURRENT

        Ur = math.hypot(water.ur, water.vr)  # Eq. (17)
        switched = self.progress.move(navigation, Ur, current, dt)
        P = self.progress.point
        point = P.point()
        chi_p = point.chi
        xe, ye = path_errors(navigation, point, chi_p)
        self.progress.judge(math.hypot(xe, ye))

        beta_r = math.atan2(water.vr, water.ur)
        if Ur < config.minimum_speed:
            Ur = beta_r = 0.0
        inputs = LawInputs(ye, chi_p, Ur, beta_r, current)
        self._state, law = law_step(self._law, self._state, inputs, dt)

        drawn = saturated(xe, config.virtual_point.saturation)
        desired = tangential_speed(config.virtual_point.k, drawn, psi, water, chi_p, current)
        U_P = P.set_speed(desired, point)
        kappa = point.kappa
        # At the end of the path there is nothing more to turn to.
        psi_d, r_d = (psi, 0.0) if P.finished else (wrap(law.psi_d), kappa * U_P)  # Eq. (9)
        r_d = min(max(r_d, -self._turn_rate), self._turn_rate)
        return GuidanceOutput(
            psi_d=psi_d,
            r_d=r_d,
            xe=xe,
            ye=ye,
            psi_e=wrap(psi - psi_d),
            **self._place(),
            x_p=point.x,
            y_p=point.y,
            chi_p=chi_p,
            kappa=kappa,
            U_P=U_P,
            beta_r=beta_r,
            chi_r=law.chi_r,
            alpha=law.alpha,
            theta_n=law.theta_n,
            switched=switched,
        )

    def _place(self) -> dict[str, Any]:
        """Where P is, as `GuidanceOutput` has it."""
        P, progress = self.progress.on_path, self.progress
        return {
            "s": P.s,
            "i": P.i,
            "distance_to_go": progress.distance_to_go,
            "approach": progress.approach_to_go,
            "finished": P.finished,
        }
