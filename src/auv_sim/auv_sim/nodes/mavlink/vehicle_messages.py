"""The vehicle's MAVLink messages, each turned into a measurement, a time or a condition."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import finite
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SpatialWater, WaterVelocity
from auv_sim.nodes.mavlink.mapping import (
    NO_COVARIANCE,
    WATER_LOG,
    CommandLimits,
    angle_of_pulse,
    covariance_of,
)
from auv_sim.nodes.mavlink.navigation import Assembly, Attitude, Position, fuse, fuse_in_space
from auv_sim.nodes.mavlink.soundings import sounding_of
from auv_sim.nodes.mavlink.vehicle_time import ComponentTime, FollowedClock, OffsetEstimate
from auv_sim.nodes.mavlink.vehicle_topics import VehicleTopics

#: Age of the autopilot's covariances beyond which they are not known, ns.
_COVARIANCE_AGE = 1_000_000_000
#: Requests for the vehicle's time that may await their answer.
_REQUESTS = 8


class VehicleMessages:
    """Handles each kind of message; keeps the estimates of the vehicle's time.

    Args:
        node: the driver.
        limits: full deflection of the vehicle; one with stern planes dives.
    """

    def __init__(self, node: SuiteNode, limits: CommandLimits) -> None:
        p = node.parameters
        self._node, self._limits, self._system = node, limits, p.vehicle_system
        settling = 0 if p.clock_speed else round(p.settling * 1e9)
        self.time: OffsetEstimate | FollowedClock = (
            FollowedClock(topics.FIRST_STAMP_NS, p.clock_speed) if p.clock_speed else OffsetEstimate(settling)
        )
        self._log_time = ComponentTime(self.time, settling)
        #: Times of our requests for the vehicle's time, ns.
        self.requests: deque[int] = deque(maxlen=_REQUESTS)
        self._dives = limits.sternplanes is not None
        self._assembly = Assembly(fuse_in_space if self._dives else fuse)
        self.topics = VehicleTopics(node, self._assembly.dropped, self._dives)
        self._water_boot_ms = 0
        #: Of pose and twist, NED and FRD, and the ROS time of their arrival, ns.
        self._covariances, self._covariances_at = (NO_COVARIANCE, NO_COVARIANCE), 0
        #: ROS time of the newest message, ns; None before the first.
        self.heard_at: int | None = None
        self._status = ""
        autopilot = p.vehicle_component
        # Message -> the components that may send it (None: any), and what handles it.
        self._handlers: dict[str, dict[int | None, Callable[[Any], None]]] = {
            "HEARTBEAT": {autopilot: self._on_heartbeat},
            "STATUSTEXT": {None: self._on_text},
            "TIMESYNC": {autopilot: self._on_timesync},
            "ATTITUDE": {autopilot: self._on_attitude},
            "LOCAL_POSITION_NED": {autopilot: self._on_position},
            "SERVO_OUTPUT_RAW": {autopilot: self._on_servo},
            "ODOMETRY": {autopilot: self._on_own_odometry, WATER_LOG: self._on_water_track},
        }
        if self._dives:
            self._handlers["DISTANCE_SENSOR"] = {autopilot: self._on_distance}

    def time_ns(self) -> int:
        """Return ROS time, ns, without waiting for our own /clock."""
        if isinstance(self.time, FollowedClock):
            return self.time.now
        return int(self._node.get_clock().now().nanoseconds)

    def process(self, message: Any) -> None:
        """Process a message of the vehicle; ignore other systems and unknown kinds.

        Raises:
            MessageRefused: its content is outside its limits.
        """
        handlers = self._handlers.get(message.get_type())
        if handlers is None or message.get_srcSystem() != self._system:
            return
        self.heard_at = self.time_ns()
        component = message.get_srcComponent()
        handler = handlers.get(component) or handlers.get(None)
        if handler is None:
            self._assembly.dropped[f"{message.get_type()} of component {component}"] += 1
            return
        handler(message)

    def values(self) -> dict[str, Any]:
        """Return restarts and round trip for /diagnostics."""
        restarts: dict[str, Any] = {
            "vehicle restarts": self.time.restarts,
            "water log restarts": self._log_time.restarts,
        }
        if isinstance(self.time, OffsetEstimate) and self.time.round_trip is not None:
            restarts["round trip [ms]"] = f"{self.time.round_trip * 1e-6:.1f}"
        return restarts

    @property
    def status(self) -> str:
        """The vehicle's state, and whether it is armed."""
        return self._status or "not heard yet"

    @property
    def dropped(self) -> dict[str, int]:
        """Messages left out, by reason, for /diagnostics."""
        return {f"dropped {what}": count for what, count in self._assembly.dropped.items()}

    def _hear_time(self, boot_ms: int) -> None:
        """Process the time of the autopilot; forget the measurements of a vehicle that was restarted."""
        boot = boot_ms * 1_000_000
        if isinstance(self.time, FollowedClock):
            restarted = self.time.heard(boot, time.monotonic_ns())
            self.topics.clock(self.time.now)
        else:
            restarted = self.time.heard(boot, self.time_ns())
        if restarted:
            self._node.get_logger().warning("the vehicle was restarted")
            self._assembly.reset()
            self._covariances = NO_COVARIANCE, NO_COVARIANCE

    def _on_heartbeat(self, message: Any) -> None:
        armed = "armed" if message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED else "not armed"
        known = mavlink.enums["MAV_STATE"].get(message.system_status)
        state = known.name.removeprefix("MAV_STATE_").lower() if known else f"state {message.system_status}"
        self._status = f"{state}, {armed}"
        self._node.health.warn("armed", "the vehicle is not armed" if armed == "not armed" else "")

    def _on_text(self, message: Any) -> None:
        self._node.get_logger().warning(f"text from the vehicle: {message.text}")

    def _on_timesync(self, message: Any) -> None:
        is_answer = message.tc1 and message.ts1 in self.requests
        if is_answer and isinstance(self.time, OffsetEstimate):
            self.time.exchanged(message.ts1, message.tc1, self.time_ns())

    def _on_attitude(self, message: Any) -> None:
        self._hear_time(message.time_boot_ms)
        m = message
        more = (m.roll, m.pitch, m.rollspeed, m.pitchspeed) if self._dives else ()
        self._assembly.attitude(Attitude(m.time_boot_ms, m.yaw, m.yawspeed, *more))

    def _on_position(self, message: Any) -> None:
        self._hear_time(message.time_boot_ms)
        m = message
        more = (m.z, m.vz) if self._dives else ()
        fused = self._assembly.position(Position(m.time_boot_ms, m.x, m.y, m.vx, m.vy, *more))
        if fused is not None and self.time.settled:
            is_fresh = self.time_ns() - self._covariances_at <= _COVARIANCE_AGE
            covariances = self._covariances if is_fresh else (NO_COVARIANCE, NO_COVARIANCE)
            self.topics.odometry(fused, self.time.stamp(fused.boot_ms * 1_000_000), covariances)

    def _on_own_odometry(self, message: Any) -> None:
        """Keep the covariances of the autopilot's ODOMETRY that are in NED and FRD."""
        pose, twist = (covariance_of(m) for m in (message.pose_covariance, message.velocity_covariance))
        self._covariances = (
            pose if message.frame_id == mavlink.MAV_FRAME_LOCAL_NED else NO_COVARIANCE,
            twist if message.child_frame_id == mavlink.MAV_FRAME_BODY_FRD else NO_COVARIANCE,
        )
        self._covariances_at = self.time_ns()

    def _on_water_track(self, message: Any) -> None:
        if message.child_frame_id != mavlink.MAV_FRAME_BODY_FRD:
            raise MessageRefused("ODOMETRY", f"child_frame_id {message.child_frame_id}", "MAV_FRAME_BODY_FRD")
        finite(message.vx + message.vy, "ODOMETRY")
        boot_ms = message.time_usec // 1000
        if self._log_time.heard(boot_ms * 1_000_000, self.time_ns()):
            self._node.get_logger().warning("the vehicle's water log was restarted")
            self._water_boot_ms = 0
        if boot_ms > self._water_boot_ms and self._log_time.settled:
            self._water_boot_ms = boot_ms
            stamp = self._log_time.stamp(boot_ms * 1_000_000)
            covariance = covariance_of(message.velocity_covariance)
            self.topics.water_velocity(self._water_velocity(message), stamp, covariance)

    def _water_velocity(self, message: Any) -> WaterVelocity | SpatialWater:
        """Return the velocity of a water log; NaN downwards means that it is not measured."""
        if self._dives:
            return SpatialWater(message.vx, message.vy, message.vz)
        return WaterVelocity(message.vx, message.vy)

    def _on_distance(self, message: Any) -> None:
        self._hear_time(message.time_boot_ms)
        sounding = sounding_of(message)
        if sounding is not None and self.time.settled:
            self.topics.altitude(sounding, self.time.stamp(message.time_boot_ms * 1_000_000))

    def _on_servo(self, message: Any) -> None:
        p, limits = self._node.parameters, self._limits
        if p.rudder_servo:
            pulse = getattr(message, f"servo{p.rudder_servo}_raw")
            self.topics.rudder(angle_of_pulse(pulse, limits.rudder))
        if p.sternplane_servo and limits.sternplanes is not None:
            pulse = getattr(message, f"servo{p.sternplane_servo}_raw")
            self.topics.sternplanes(angle_of_pulse(pulse, limits.sternplanes))
