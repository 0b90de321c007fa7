"""The driver's parameters. ROS-free, so that a file is checked before the node starts."""

from __future__ import annotations

from typing import Literal

from auv_msgs_py.settings.schema import setting, settings
from auv_path_following.parameters import NodeParameters


@settings
class MavlinkDriverParameters(NodeParameters):
    """mavlink_driver."""

    address: str = setting(
        "udpin:0.0.0.0:14550", "udpin:HOST:PORT waits for the vehicle, udpout:HOST:PORT sends to it"
    )
    vehicle: str = setting(
        "remus100", "vehicle file, or the name of a shipped one: its limits are full deflection"
    )
    vehicle_system: int = setting(1, "MAVLink system id of the vehicle", ge=1, le=255)
    vehicle_component: int = setting(
        1,
        "MAVLink component id of the vehicle's autopilot; the motion that others report is ignored",
        ge=1,
        le=255,
    )
    peer: str = setting(
        "",
        "with udpin, the HOST or HOST:PORT of the vehicle; empty: the first sender with its system id",
    )
    peer_timeout: float = setting(
        5.0,
        "silence of the vehicle after which another address can take its place",
        unit="s",
        ge=0.1,
        le=3600.0,
    )
    signing_key: str = setting(
        "", "file with the key of MAVLink 2 signing, mode 0600: unsigned messages are refused; empty: none"
    )
    system: int = setting(
        255,
        "our MAVLink system id; most autopilots obey only the id that their parameters name",
        ge=1,
        le=255,
    )
    component: int = setting(191, "our MAVLink component id: an onboard computer", ge=1, le=255)
    turn_axis: Literal["clockwise", "counter-clockwise"] = setting(
        "clockwise", "direction in which a positive r axis of MANUAL_CONTROL turns the vehicle"
    )
    pitch_axis: Literal["bow-down", "bow-up"] = setting(
        "bow-down",
        "direction in which a positive s axis of MANUAL_CONTROL pitches a vehicle with stern planes",
    )
    rudder_servo: int = setting(
        1, "output of SERVO_OUTPUT_RAW that moves the rudder, for rudder_state; 0: none", ge=0, le=8
    )
    sternplane_servo: int = setting(
        2, "output that moves the stern planes, for sternplane_state; 0: none", ge=0, le=8
    )
    command_timeout: float = setting(
        1.0,
        "age of the newest command of a kind after which the vehicle stops",
        unit="s",
        ge=0.1,
        le=10.0,
    )
    link_timeout: float = setting(
        1.0, "silence of the vehicle after which /diagnostics shows an error", unit="s", ge=0.1, le=60.0
    )
    settling: float = setting(
        1.0,
        "time for which the vehicle's clock is watched before anything is published",
        unit="s",
        ge=0.0,
        le=60.0,
    )
    clock_speed: float = setting(
        0.0,
        "0 for a vehicle; N for an emulator at N times real time: the driver publishes /clock",
        ge=0.0,
        le=1000.0,
    )
    world_frame: Literal["map", "odom"] = setting("map", "frame id of the odometry, ENU")
    body_frame: Literal["base_link"] = setting("base_link", "frame id of the vehicle, FLU")
