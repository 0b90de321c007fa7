"""Settings of guidance, and guidance along one path: configuration and state of `follow`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from auv_msgs_py.settings.schema import setting
from auv_msgs_py.values.types import Current, Navigation, WaterVelocity
from auv_path_following.curves.composite import CompositePath
from auv_path_following.guidance import follow as steps
from auv_path_following.guidance.approach import Agility, ApproachConfig, empty_approach, turn_radius
from auv_path_following.guidance.follow import (
    FollowerConfig,
    FollowerState,
    GuidanceOutput,
    first_state,
    follow,
)
from auv_path_following.guidance.laws.registered import LAWS
from auv_path_following.guidance.measured import Measured
from auv_path_following.guidance.progress import ProgressConfig, approach_to_go, beginning
from auv_path_following.guidance.spatial.vertical_modes import VerticalConfig
from auv_path_following.guidance.switching import SwitchingConfig, circles_of
from auv_path_following.guidance.virtual_point import VirtualPoint, VirtualPointConfig
from auv_path_following.registry import law_of, law_settings


@law_settings("law", "guidance law", LAWS)
class PathFollowerConfig:
    """Settings of guidance along a path."""

    compensate_current: bool = setting(True, "use the estimated current in Eqs. (22) and (31)", live=True)
    minimum_speed: float = setting(
        0.2,
        "below this speed through water beta_r and alpha are taken as 0",
        unit="m/s",
        ge=0.0,
        live=True,
    )
    approach: ApproachConfig = setting(factory=ApproachConfig, doc="approach to the path's start")
    rejoin_reach: float = setting(
        50.0,
        "largest distance ahead at which P is sought after a hold",
        unit="m",
        ge=0.0,
        le=1000.0,
        live=True,
    )
    virtual_point: VirtualPointConfig = setting(factory=VirtualPointConfig, doc="virtual point")
    switching: SwitchingConfig = setting(factory=SwitchingConfig, doc="subpath switching")
    vertical: VerticalConfig = setting(
        factory=VerticalConfig, doc="vertical plane of a vehicle with stern planes"
    )

    if TYPE_CHECKING:  # the choice and the laws' own settings

        def __init__(self, **fields: Any) -> None: ...
        def __getattr__(self, name: str) -> Any: ...

    @property
    def lookahead(self) -> float:
        """Delta of the chosen law, m; where it adapts, the largest."""
        return float(getattr(self, self.law).largest_lookahead)


def prepare(
    config: PathFollowerConfig, agility: Agility | None = None, begins_at: float = 0.0
) -> FollowerConfig:
    """Return the configuration of guidance.

    Args:
        config: laws and gains.
        agility: of the hull, for approach and bounds; None: the laws alone, with neither.
        begins_at: path parameter s at which a mission begins, Eq. (1), in [0, n).
    """
    law = law_of(LAWS, config.law)
    lookahead, approach = config.lookahead, config.approach
    progress = ProgressConfig(
        circles_of(config.switching, None if agility is None else agility.cornering, lookahead),
        agility is not None and approach.enabled,
        0.0 if agility is None else float(turn_radius(approach, agility, lookahead)),
        float(config.rejoin_reach),
        float(begins_at),
    )
    return FollowerConfig(
        law.prepare(getattr(config, law.name), None),
        law.initial,
        config.compensate_current,
        float(config.minimum_speed),
        float(config.virtual_point.k),
        float(config.virtual_point.saturation),
        math.inf if agility is None else float(agility.turn_rate),
        progress,
    )


def distance_to_go(path: CompositePath, config: ProgressConfig, state: FollowerState) -> float:
    """Return the length from P to the end of the path, the rest of an approach included, m."""
    P, legs, approach = state.progress[:3]
    i, t = beginning(config) if legs > 0 else (P.i, P.t)
    return approach_to_go(legs, approach, P.i, P.t) + path.distance_to_go(i, t)


class PathFollower:
    """Guidance along one path: configuration and state.

    Args:
        path: the path.
        config: laws and gains.
        agility: of the hull, for approach and bounds; None: the laws alone, with neither.
    """

    def __init__(
        self, path: CompositePath, config: PathFollowerConfig | None = None, agility: Agility | None = None
    ) -> None:
        self.path = path
        self._agility = agility
        self.config = prepare(config or PathFollowerConfig(), agility)
        self.state = first_state(self.config, empty_approach())

    def configure(self, config: PathFollowerConfig) -> None:
        """Take new gains; keep the place on the path and, for the same law, its state."""
        self.config = prepare(config, self._agility)
        self.state = steps.reconfigured(self.config, self.state)

    def reset(self) -> None:
        """Return to the beginning of the path."""
        self.state = first_state(self.config, empty_approach())

    def place_at(self, i: int, t: float = 0.0) -> None:
        """Put P at t of subpath `i` (from 0), where it rests until the next update."""
        self.state = self.state._replace(progress=self.state.progress._replace(point=VirtualPoint(i, t)))

    @property
    def s(self) -> float:
        """P on the path, Eq. (1), in [0, n]; during an approach it waits where the mission begins."""
        progress = self.state.progress
        return progress.point.s if progress.legs == 0 else self.config.progress.begins_at

    @property
    def distance_to_go(self) -> float:
        """Length from P to the end of the path, the rest of an approach included, m."""
        return distance_to_go(self.path, self.config.progress, self.state)

    def rejoin(self, navigation: Navigation) -> None:
        """Continue after a hold, see `rejoin`."""
        self.state = steps.rejoin(self.config, self.path.rows, self.state, navigation)

    def look(self, navigation: Navigation) -> GuidanceOutput:
        """Return the errors while no mission runs, see `look`."""
        self.state, output = steps.look(self.config, self.path.rows, self.state, navigation)
        return output

    def update(
        self, navigation: Navigation, water: WaterVelocity, current: Current, dt: float
    ) -> GuidanceOutput:
        """Take one step, see `follow`."""
        measured = Measured(navigation, water, True, False, 0.0, 0.0)
        self.state, output = follow(self.config, self.path.rows, self.state, measured, current, dt)
        return output
