"""The one table of topics: name, type, publisher, subscribers, QoS. Names are relative."""

from __future__ import annotations

from typing import NamedTuple

PLANT = "remus_plant"
OBSERVER = "current_observer"
GUIDANCE = "ailos_guidance"
AUTOPILOT = "heading_autopilot"
RECORDER = "recorder"
#: The node of `scripts/mission.py`.
LAUNCHER = "mission_launcher"
#: Publishes /clock for several simulated vehicles.
FLEET_CLOCK = "fleet_clock"
#: Shows the mission to people; no node waits for it.
DISPLAY = "display"
#: Shows the missions of a domain in the browser, and passes on what an operator asks for.
CONSOLE = "console"
#: Flies manoeuvres in place of guidance and autopilot.
MANOEUVRES = "manoeuvres"
#: Replaces the simulator on a real vehicle.
MAVLINK_DRIVER = "mavlink_driver"


def full_name(namespace: str, name: str) -> str:
    """`/auv`, `odom` -> ``/auv/odom``; the root namespace is `/`."""
    return f"{namespace.rstrip('/')}/{name}"


class Topic(NamedTuple):
    """One row of the wire contract.

    `subscribers` are the suite's nodes of the control chain; any other node may subscribe too. `latched`
    topics are transient local on both sides.
    """

    name: str
    type: str
    publisher: str
    subscribers: tuple[str, ...] = ()
    latched: bool = False


CLOCK = Topic("/clock", "rosgraph_msgs/msg/Clock", PLANT)
ODOM = Topic("odom", "nav_msgs/msg/Odometry", PLANT, (OBSERVER, GUIDANCE, AUTOPILOT))
WATER_VELOCITY = Topic(
    "velocity_through_water", "geometry_msgs/msg/TwistWithCovarianceStamped", PLANT, (OBSERVER, GUIDANCE)
)
RUDDER_STATE = Topic("rudder_state", "std_msgs/msg/Float64", PLANT)
TRUE_CURRENT = Topic("true_current", "geometry_msgs/msg/Vector3Stamped", PLANT)
#: Extension of the contract: true state from a simulator whose navigation has errors. It is not in
#: `PER_STEP`: without a sea it is never published; with one it comes once a step, within `RECORDING_LEAD`.
TRUE_ODOM = Topic("true_odom", "nav_msgs/msg/Odometry", PLANT)
CURRENT_ESTIMATE = Topic("current_estimate", "geometry_msgs/msg/Vector3Stamped", OBSERVER, (GUIDANCE,))
DESIRED_YAW = Topic("desired_yaw", "std_msgs/msg/Float64", GUIDANCE, (AUTOPILOT,))
DESIRED_YAW_RATE = Topic("desired_yaw_rate", "std_msgs/msg/Float64", GUIDANCE, (AUTOPILOT,))
DESIRED_THRUST = Topic("desired_thrust", "std_msgs/msg/Float64", GUIDANCE, (AUTOPILOT,))
VIRTUAL_POINT = Topic("virtual_point", "geometry_msgs/msg/PoseStamped", GUIDANCE)
PATH_PARAMETER = Topic("path_parameter", "std_msgs/msg/Float64", GUIDANCE)
PATH_ERROR = Topic("path_error", "geometry_msgs/msg/Vector3Stamped", GUIDANCE)
DISTANCE_TO_GO = Topic("distance_to_go", "std_msgs/msg/Float64", GUIDANCE)
PATH = Topic("path", "nav_msgs/msg/Path", GUIDANCE, latched=True)
MISSION_STATE = Topic("mission_state", "std_msgs/msg/String", GUIDANCE, (AUTOPILOT, PLANT), latched=True)
#: The area that must not be left, in `map`; empty: none.
GEOFENCE = Topic("geofence", "geometry_msgs/msg/PolygonStamped", GUIDANCE, latched=True)
#: Where `map`'s 0, 0 is; published if the mission has an origin.
ORIGIN = Topic("origin", "sensor_msgs/msg/NavSatFix", GUIDANCE, latched=True)
#: State with its reason, the mission's name and digest, its length, when it began, and the share flown.
MISSION_STATUS = Topic("mission_status", "diagnostic_msgs/msg/DiagnosticStatus", GUIDANCE, latched=True)
#: From people and their tools; taken if guidance's parameter `accept_goal` allows it.
GOAL_POSE = Topic("goal_pose", "geometry_msgs/msg/PoseStamped", "any node", (GUIDANCE,))
RUDDER_CMD = Topic("rudder_cmd", "std_msgs/msg/Float64", AUTOPILOT, (PLANT,))
THRUST_CMD = Topic("thrust_cmd", "std_msgs/msg/Float64", AUTOPILOT, (PLANT,))
DIAGNOSTICS = Topic("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", "every node")
#: Extension of the contract, lockstep only: number of steps that the recorder has in full; the simulator
#: keeps within `RECORDING_LEAD` of it.
RECORDED_STEPS = Topic("recorded_steps", "std_msgs/msg/UInt64", RECORDER, (PLANT,))
#: Extension of the contract: what each launcher and simulator claims, see `claim`. Absolute, because a domain
#: has one /clock.
GRAPH_CLAIMS = Topic("/graph_claims", "std_msgs/msg/String", "every launcher and simulator", latched=True)
#: Extension of the contract, lockstep only: number of steps that the simulator has sent. The recorder fetches
#: them at once, so that no step waits for a timer.
RECORD_REQUEST = Topic("record_request", "std_msgs/msg/UInt64", PLANT, (RECORDER,))

#: Extension of the contract, a fleet in lockstep only: the time of this vehicle's step, in place of /clock,
#: which `fleet_clock` publishes.
VEHICLE_CLOCK = Topic("vehicle_clock", CLOCK.type, PLANT)
#: Extension of the contract, a fleet only: the time up to which the nodes have answered this vehicle's steps,
#: at least once in `FLEET_REPORT_NS`; not recorded.
VEHICLE_PROGRESS = Topic("vehicle_progress", CLOCK.type, PLANT)

# Of a vehicle with stern planes only; the others neither publish nor subscribe to them.
STERNPLANE_CMD = Topic("sternplane_cmd", "std_msgs/msg/Float64", AUTOPILOT, (PLANT,))
STERNPLANE_STATE = Topic("sternplane_state", "std_msgs/msg/Float64", PLANT)
#: Only with an altimeter.
ALTITUDE = Topic("altitude", "sensor_msgs/msg/Range", PLANT, (GUIDANCE,))
DESIRED_PITCH = Topic("desired_pitch", "std_msgs/msg/Float64", GUIDANCE, (AUTOPILOT,))
DESIRED_PITCH_RATE = Topic("desired_pitch_rate", "std_msgs/msg/Float64", GUIDANCE, (AUTOPILOT,))
DESIRED_DEPTH = Topic("desired_depth", "std_msgs/msg/Float64", GUIDANCE)
PATH_ERROR_3D = Topic("path_error_3d", "geometry_msgs/msg/Vector3Stamped", GUIDANCE)

#: Topics with one message per odometry while the mission runs.
PER_STEP = (
    ODOM, WATER_VELOCITY, RUDDER_STATE, TRUE_CURRENT, CURRENT_ESTIMATE, DESIRED_YAW, DESIRED_YAW_RATE,
    DESIRED_THRUST, VIRTUAL_POINT, PATH_PARAMETER, PATH_ERROR, DISTANCE_TO_GO, RUDDER_CMD, THRUST_CMD,
)  # fmt: skip
#: What an operator sees of the mission beside its state and its path.
OPERATION = (GEOFENCE, ORIGIN, MISSION_STATUS)
CONTRACT = (CLOCK, *PER_STEP, TRUE_ODOM, PATH, MISSION_STATE, *OPERATION, DIAGNOSTICS)
#: The same of a vehicle with stern planes, in addition.
SPATIAL_PER_STEP = (
    STERNPLANE_CMD, STERNPLANE_STATE, DESIRED_PITCH, DESIRED_PITCH_RATE, DESIRED_DEPTH, PATH_ERROR_3D,
)  # fmt: skip
SPATIAL_CONTRACT = (*SPATIAL_PER_STEP, ALTITUDE)
#: Between the simulator and the recorder in lockstep; not recorded.
RECORDING = (RECORDED_STEPS, RECORD_REQUEST)

START_SERVICE = "start"
ABORT_SERVICE = "abort"
HOLD_SERVICE = "hold"
RESUME_SERVICE = "resume"
RESET_SERVICE = "reset"

#: The simulator's first stamp: zero reads as "unset" in ROS 2.
FIRST_STAMP_NS = 1_000_000_000

#: Lockstep: largest lead of the simulator over the recorder, steps. A reader's transport queue holds 512
#: messages, and a step has at most 16, with stern planes 23: within this lead no queue overflows, however
#: long the recorder gets no processor time.
#: In lockstep publishers keep the last `RECORDING_LEAD` messages of each topic (`contract.qos`): what the
#: recorder missed, because it had not matched a publisher or was paused for 1 s, is sent again.
RECORDING_LEAD, SPATIAL_RECORDING_LEAD = 30, 20
#: Interval between the recorder's reports, steps.
RECORDING_REPORT = 8
#: Interval between the simulator's requests to the recorder, steps: a third of the lead, or half of it with
#: stern planes, so that the report is back before the lead is used up.
RECORDING_REQUEST = 10
#: Most vehicles that one recorder can record. All share its transport queue, so `shared` divides the numbers
#: above; for more of them a request and its report would no longer fit into the lead.
MOST_RECORDED = 10

#: Lockstep of a fleet: a vehicle reports its time when at least this much has passed, ns, and waits when it
#: is `FLEET_LEAD_NS` ahead of /clock. The lead is at least one report and one step, so the last vehicle waits
#: for nothing but its own report.
FLEET_REPORT_NS, FLEET_LEAD_NS = 500_000_000, 1_000_000_000


def shared(steps: int, vehicles: int) -> int:
    """Return an interval of the recording, or the lead, steps, where one recorder has several vehicles."""
    return max(1, steps // vehicles)
