"""The parameters of simulator, recorder and fault relay, and the table of all nodes' parameter classes."""

from __future__ import annotations

from typing import Any, Literal

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.contract.topics import MOST_RECORDED
from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_msgs_py.values.types import Current, SpatialCurrent
from auv_path_following.parameters import (
    AutopilotParameters,
    GuidanceParameters,
    NodeParameters,
    ObserverParameters,
)
from auv_sim.driver_parameters import MavlinkDriverParameters
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.remus import PlantState

#: Initial speed of a simulated vehicle through the water, m/s.
CRUISE = 1.9


@settings
class InitialPose:
    """Initial state of the simulated vehicle, NED."""

    x: float = setting(0.0, "north", unit="m")
    y: float = setting(0.0, "east", unit="m")
    psi: float = setting(0.0, "heading, clockwise from north", unit="rad")
    surge: float = setting(CRUISE, "speed through the water", unit="m/s", ge=0.0, le=10.0)
    depth: float = setting(0.0, "depth, of a vehicle with stern planes", unit="m", ge=0.0)
    theta: float = setting(
        0.0, "pitch of a vehicle with stern planes, positive bow up", unit="rad", gt=-1.5, lt=1.5
    )

    @property
    def state(self) -> PlantState:
        """The same as the plant's state."""
        return PlantState(self.x, self.y, self.psi, self.surge, 0.0, 0.0)

    @property
    def spatial_state(self) -> BodyState:
        """The same of a vehicle with stern planes."""
        return body_at(self.x, self.y, self.depth, 0.0, self.theta, self.psi, self.surge)


@settings
class ConstantCurrent:
    """Velocity of the water over ground, NED."""

    Vx: float = setting(0.0, "towards north", unit="m/s", ge=-5.0, le=5.0, live=True)
    Vy: float = setting(0.0, "towards east", unit="m/s", ge=-5.0, le=5.0, live=True)
    Vz: float = setting(
        0.0, "downwards, for a vehicle with stern planes", unit="m/s", ge=-5.0, le=5.0, live=True
    )

    @property
    def value(self) -> Current:
        """The same as a vector, m/s, NED."""
        return Current(self.Vx, self.Vy)

    @property
    def spatial_value(self) -> SpatialCurrent:
        """The same in three dimensions."""
        return SpatialCurrent(self.Vx, self.Vy, self.Vz)

    def of(self, dives: bool) -> Current | SpatialCurrent:
        """Return the current for a vehicle that dives, or for one that does not."""
        return self.spatial_value if dives else self.value


@settings
class PlantParameters(NodeParameters):
    """remus_plant."""

    vehicle: str = setting("remus100", "vehicle file, or the name of a shipped one")
    initial: InitialPose = setting(factory=InitialPose, doc="initial state")
    current: ConstantCurrent = setting(
        factory=ConstantCurrent, doc="constant current, added to the sea's own"
    )
    sea: str = setting("", "sea file, or the name of a shipped one; empty: an ideal sea")
    seed: int = setting(0, "seed of all random numbers of the sea", ge=0)
    step: float = setting(0.05, "period of the odometry", unit="s", ge=0.001, le=1.0)
    speed: float = setting(1.0, "free running: times real time", ge=0.01, le=1000.0)
    hold_until_running: bool = setting(True, "hold the initial state until the mission runs")
    publish_at_rest: bool = setting(
        True, "free running: publish the state while it is held, for checks before the mission"
    )
    command_timeout: float = setting(
        1.0,
        "age of the newest command of a kind after which fins and thrust are 0",
        unit="s",
        ge=0.1,
        le=60.0,
    )
    answer_timeout: float = setting(
        10.0,
        "lockstep: wall time after which a step without an answer ends the run",
        unit="s",
        ge=0.1,
        le=3600.0,
    )
    shared_clock: bool = setting(
        False, "one of several simulated vehicles, for which fleet_clock publishes /clock"
    )
    recorded_vehicles: int = setting(
        1, "lockstep: number of vehicles that the same recorder records", ge=1, le=MOST_RECORDED
    )
    world_frame: str = setting(
        "map", "frame id of the odometry; map and odom are ENU, map_ned and odom_ned NED"
    )
    body_frame: str = setting("base_link", "frame id of the vehicle; base_link is FLU, base_link_frd FRD")

    def check_frames(self, node: str) -> None:
        """Check that the two frames are compatible.

        Raises:
            ConfigurationError: they are not; it names the node.
        """
        try:
            FrameTable(FrameIds()).of_pose(topics.ODOM.name, self.world_frame, self.body_frame)
        except MessageRefused as error:
            where = f"{node}: world_frame, body_frame"
            raise ConfigurationError(where, error.found, error.expected) from None


@settings
class RecorderParameters(NodeParameters):
    """recorder. It records the wire contract and whatever else `topics`, `regex` or `all_topics` name."""

    directory: str = setting(
        "",
        "rosbag2 directory to write; it must not exist yet; empty: bag-DATE-TIME in the working directory",
    )
    contract: bool = setting(True, "record the wire contract, /rosout and /parameter_events from the start")
    sternplanes: bool = setting(False, "record the topics of a vehicle with stern planes as well")
    shared_clock: bool = setting(
        False, "lockstep: take the time from the vehicle_clock of a simulator with shared_clock"
    )
    vehicles: str = setting(
        "", "namespaces of a fleet's vehicles: lines of the others in /diagnostics, /rosout and"
        " /parameter_events are not recorded",
    )  # fmt: skip
    topics: str = setting("", "further topics: names, separated by spaces")
    regex: str = setting("", "further topics: regular expression for their full names")
    exclude: str = setting("", "regular expression for full names not to record, unless named elsewhere")
    all_topics: bool = setting(False, "record every topic that appears")
    compression: Literal["none", "zstd"] = setting("zstd", "compression of the chunks: zstd or none")
    flush_period: float = setting(
        0.5, "longest time, wall and recorded, that a crash loses", unit="s", ge=0.05, le=60.0
    )
    max_size: int = setting(0, "size at which a new file is begun, MB; 0: never", ge=0, le=1_000_000)
    max_duration: float = setting(
        0.0, "recorded time after which a new file is begun; 0: never", unit="s", ge=0.0, le=1e6
    )
    min_free_space: int = setting(
        200, "free space on the disk below which the recording is closed, MB; 0: never", ge=0, le=1_000_000
    )


@settings
class FleetClockParameters(NodeParameters):
    """fleet_clock."""

    vehicles: str = setting("", "the vehicles' namespaces, separated by spaces")
    step: float = setting(0.05, "free running: period of /clock", unit="s", ge=0.001, le=1.0)
    speed: float = setting(1.0, "free running: times real time", ge=0.01, le=1000.0)


#: Faults of `fault_relay`; `auv_sim.nodes.fault_injection` describes each.
Fault = Literal[
    "none",
    "stop",
    "delay",
    "nan",
    "freeze",
    "jump",
    "reverse",
    "flood",
    "frameless",
    "timeless",
    "cut",
    "forge",
    "weak",
    "depth_nan",
    "depth_freeze",
    "depth_jump",
    "depth_turn",
    "planar",
    "rolled",
]


@settings
class FaultRelayParameters(NodeParameters):
    """fault_relay. It reads each topic as <topic>_raw; with fault none it only forwards."""

    topics: str = setting(
        "odom velocity_through_water current_estimate desired_yaw desired_yaw_rate desired_thrust"
        " rudder_cmd thrust_cmd mission_state",
        "the topics that it forwards, separated by spaces",
    )
    fault: Fault = setting(
        "none",
        "stop, delay, nan, freeze, jump, reverse, flood, frameless, timeless, cut, forge, weak, depth_nan,"
        " depth_freeze, depth_jump, depth_turn, planar, rolled, or none",
        live=True,
    )  # fmt: skip
    on: str = setting("", "the topics with the fault; empty: all", live=True)
    delay: float = setting(2.0, "delay of the fault delay", unit="s", ge=0.001, le=600.0, live=True)
    jump: float = setting(100.0, "size of the fault jump, in the unit of the topic", live=True)
    copies: int = setting(100, "copies of each message in the fault flood", ge=1, le=10_000, live=True)


@settings
class DisplayParameters:
    """display."""

    rate: float = setting(10.0, "rate of markers and transforms, wall time", unit="Hz", ge=0.1, le=50.0)
    tf: bool = setting(
        True, "publish transforms; false where the vehicle's own localisation publishes map to base_link"
    )
    frame_prefix: str = setting("", "prefix of the vehicle's frames in transforms and model, such as auv1/")
    mission: str = setting(
        "", "mission file, or the name of a shipped one, whose joints are drawn; empty: none"
    )
    vehicle: str = setting("remus100", "vehicle file, or the name of a shipped one, whose hull is drawn")
    frames: FrameIds = setting(factory=FrameIds, doc="accepted frame ids of the odometry")


#: Node name -> the class of its parameters, which a parameter file may contain.
SUITE: dict[str, type[Any]] = {
    topics.PLANT: PlantParameters,
    topics.OBSERVER: ObserverParameters,
    topics.GUIDANCE: GuidanceParameters,
    topics.AUTOPILOT: AutopilotParameters,
    topics.RECORDER: RecorderParameters,
    topics.MAVLINK_DRIVER: MavlinkDriverParameters,
    topics.DISPLAY: DisplayParameters,
}
