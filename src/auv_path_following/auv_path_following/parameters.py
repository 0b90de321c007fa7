"""All parameters of the three nodes as settings; ROS-free, so that files are checked before a node starts."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

from auv_msgs_py.contract.frames import FrameIds
from auv_msgs_py.settings.schema import setting, settings
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.fin_watch import FinWatchConfig
from auv_path_following.control.pitch_plane import pitch_gains
from auv_path_following.guidance.failsafe.ascent import AscentConfig
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.switching import SwitchingConfig, with_overrides
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.missions.mission_state import HoldingConfig
from auv_path_following.navigation.current_observer import CurrentObserverConfig
from auv_path_following.navigation.depth_gate import DepthGateConfig
from auv_path_following.navigation.navigation_gate import NavigationGateConfig

if TYPE_CHECKING:  # only guidance reads missions; the other nodes start faster without it
    from auv_path_following.missions.mission_file import Mission


@settings
class NodeParameters:
    """Parameters of every node of the suite."""

    lockstep: bool = setting(False, "answer every input exactly once, reliable subscriptions, no watchdogs")
    recorded: bool = setting(
        False, "in lockstep: a recorder takes part, nothing is published before it has subscribed"
    )
    flood_rate: float = setting(200.0, "a topic with a higher rate is reported", unit="Hz", ge=1.0, le=1e6)


@settings
class NavigationParameters(NodeParameters):
    """Parameters of every node that reads the vehicle's navigation."""

    frames: FrameIds = setting(factory=FrameIds, doc="accepted frame ids")
    vehicle: str = setting("remus100", "vehicle file, or the name of a shipped one")
    gate: NavigationGateConfig = setting(factory=NavigationGateConfig, doc="which odometry is accepted")
    depth_gate: DepthGateConfig = setting(
        factory=DepthGateConfig, doc="which depth is accepted, of a vehicle with stern planes"
    )
    lateness: float = setting(
        1.0, "odometry is refused when its delay behind its stamp has grown by more than this", unit="s",
        ge=0.05, le=60.0,
    )  # fmt: skip
    odometry_timeout: float = setting(
        0.5, "without odometry for this long: an error; the autopilot sets rudder and thrust to 0", unit="s",
        ge=0.1, le=10.0, live=True,
    )  # fmt: skip


@settings
class ObserverParameters(NavigationParameters):
    """current_observer."""

    observer: CurrentObserverConfig = setting(factory=CurrentObserverConfig, doc="Eq. (35)")
    water_velocity_timeout: float = setting(
        1.0, "oldest velocity through water that is still used", unit="s", ge=0.05, le=60.0, live=True
    )


@settings
class GuidanceParameters(NavigationParameters):
    """ailos_guidance."""

    mission: str = setting("paper_composite", "mission file, or the name of a shipped one", live=True)
    mission_text: str = setting(
        "",
        "instead of `mission`, which is then empty: the content of a mission file, without waypoint files",
        live=True,
    )
    start_at: str = setting(
        "", "where the mission begins: `subpath 3`, or `120 m` along the path; empty: its start", live=True
    )
    check_mission: bool = setting(
        True, "refuse a mission set in flight that the check refuses, as the launcher does", live=True
    )
    accept_goal: bool = setting(
        False, "take goal_pose for a mission: a Dubins path from here to there", live=True
    )
    mission_switching: bool = setting(
        True, "at the start guidance.switching takes the values of the mission file"
    )
    guidance: PathFollowerConfig = setting(factory=PathFollowerConfig, doc="virtual point, law and switching")
    holding: HoldingConfig = setting(factory=HoldingConfig, doc="response to missing navigation")
    limits: LimitsConfig = setting(factory=LimitsConfig, doc="what ends a mission")
    diving: DiveLimitsConfig = setting(
        factory=DiveLimitsConfig, doc="what ends the mission of a vehicle with stern planes"
    )
    ascent: AscentConfig = setting(
        factory=AscentConfig, doc="ascent of a vehicle with stern planes, after a limit has ended its mission"
    )
    water_velocity_timeout: float = setting(
        1.0, "oldest velocity through water that is still used", unit="s", ge=0.05, le=60.0, live=True
    )
    current_timeout: float = setting(
        5.0,
        "an older estimate of the current is reported, and still used",
        unit="s",
        ge=0.1,
        le=600.0,
        live=True,
    )

    def with_mission_overrides(self, mission: Mission) -> GuidanceParameters:
        """Return these parameters with the mission's own switching, unless `mission_switching` is off."""
        if not self.mission_switching:
            return self
        own = mission.switching
        return self.with_switching(with_overrides(self.guidance.switching, own.mode, own.radius))

    def with_switching(self, switching: SwitchingConfig) -> GuidanceParameters:
        """Return these parameters with other circles of acceptance."""
        return dataclasses.replace(self, guidance=dataclasses.replace(self.guidance, switching=switching))


@settings
class AutopilotParameters(NavigationParameters):
    """heading_autopilot."""

    autopilot: AutopilotConfig = setting(factory=AutopilotConfig, doc="heading: controller and gains")
    pitch: AutopilotConfig = setting(
        factory=pitch_gains, doc="pitch of a vehicle with stern planes: controller and gains"
    )
    planes: FinWatchConfig = setting(
        factory=FinWatchConfig, doc="what is reported of the stern planes; it stops nothing"
    )
    reference_timeout: float = setting(
        0.5, "without guidance for this long: rudder and thrust go to 0", unit="s", ge=0.1, le=10.0, live=True
    )
