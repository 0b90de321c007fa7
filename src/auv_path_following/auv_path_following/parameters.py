"""All parameters of the three nodes as settings: ROS-free, so that files are checked before a node starts."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

from auv_msgs_py.contract.frames import FrameIds
from auv_msgs_py.settings.schema import setting, settings
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.switching import with_overrides
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.missions.mission_state import HoldingConfig
from auv_path_following.navigation.current_observer import CurrentObserverConfig
from auv_path_following.navigation.navigation_gate import NavigationGateConfig

if TYPE_CHECKING:  # reading missions is guidance's affair; the other nodes start faster without it
    from auv_path_following.missions.mission_file import Mission


@settings
class NodeParameters:
    """What every node of the suite has."""

    lockstep: bool = setting(False, "answer every input exactly once, reliable subscriptions, no watchdogs")
    recorded: bool = setting(
        False, "in lockstep: a recorder takes part, nothing is published before it listens"
    )
    flood_rate: float = setting(200.0, "a topic that comes more often is reported", unit="Hz", ge=1.0, le=1e6)


@settings
class NavigationParameters(NodeParameters):
    """What every node that reads the vehicle's navigation has."""

    frames: FrameIds = setting(factory=FrameIds, doc="accepted frame ids")
    vehicle: str = setting("remus100", "vehicle file, or the name of a shipped one: what it can do")
    gate: NavigationGateConfig = setting(factory=NavigationGateConfig, doc="which odometry is believed")
    lateness: float = setting(
        1.0, "odometry that comes so much later after its stamp than it used to is refused", unit="s",
        ge=0.05, le=60.0,
    )  # fmt: skip
    odometry_timeout: float = setting(
        0.5, "odometry silent for this long is an error; the autopilot sets rudder and thrust to 0", unit="s",
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

    mission: str = setting("paper_composite", "mission file, or the name of a shipped one")
    mission_switching: bool = setting(
        True, "at the start guidance.switching takes over what the mission file asks for"
    )
    guidance: PathFollowerConfig = setting(factory=PathFollowerConfig, doc="virtual point, law and switching")
    holding: HoldingConfig = setting(factory=HoldingConfig, doc="what missing navigation leads to")
    limits: LimitsConfig = setting(factory=LimitsConfig, doc="what ends a mission")
    water_velocity_timeout: float = setting(
        1.0, "oldest velocity through water that is still used", unit="s", ge=0.05, le=60.0, live=True
    )
    current_timeout: float = setting(
        5.0,
        "older estimates of the current are reported, and the last one is kept",
        unit="s",
        ge=0.1,
        le=600.0,
        live=True,
    )

    def with_mission_overrides(self, mission: Mission) -> GuidanceParameters:
        """These parameters with the mission's own switching, unless `mission_switching` is off."""
        if not self.mission_switching:
            return self
        wish = mission.switching
        switching = with_overrides(self.guidance.switching, wish.mode, wish.radius)
        return dataclasses.replace(self, guidance=dataclasses.replace(self.guidance, switching=switching))


@settings
class AutopilotParameters(NavigationParameters):
    """heading_autopilot."""

    autopilot: AutopilotConfig = setting(factory=AutopilotConfig, doc="controller and gains")
    reference_timeout: float = setting(
        0.5, "guidance silent for this long: rudder and thrust go to 0", unit="s", ge=0.1, le=10.0, live=True
    )
