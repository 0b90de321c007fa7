"""mavlink_driver: between a vehicle that speaks MAVLink over UDP and the wire contract."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from pymavlink.dialects.v20 import common as mavlink
from rclpy.clock import Clock as RosClock
from rclpy.clock import ClockType
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim, of_simulator
from auv_msgs_py.contract.conversions import fill_odometry, fill_water_velocity, finite, set_stamp
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_msgs_py.values.types import STOP, WaterVelocity
from auv_path_following import vehicle
from auv_sim.driver_parameters import MavlinkDriverParameters
from auv_sim.nodes.mavlink.commands import Commands
from auv_sim.nodes.mavlink.link import MavlinkLink
from auv_sim.nodes.mavlink.link_watch import LinkWatch
from auv_sim.nodes.mavlink.mapping import WATER_LOG, CommandLimits, heartbeat, manual_control, rudder_of_pulse
from auv_sim.nodes.mavlink.navigation import Assembly, Attitude, Position
from auv_sim.nodes.mavlink.peer import Configured, Peer
from auv_sim.nodes.mavlink.signing import load_key
from auv_sim.nodes.mavlink.vehicle_time import ComponentTime, FollowedClock, OffsetEstimate

#: Periods of reading the socket, of the watches, of the heartbeat and of the requests for the vehicle's
#: time, s of ROS time.
_LISTEN, _LOOK, _HEARTBEAT, _TIMESYNC = 0.005, 0.05, 1.0, 0.5
#: Datagrams taken in at once: a flood must not keep the node from everything else.
_MOST = 200
#: Requests for the vehicle's time that may be under way.
_ASKED = 8
#: Step of /clock, ns.
_CLOCK_PERIOD = 20_000_000


class MavlinkDriverNode(SuiteNode):
    """Publishes the vehicle's topics of the contract and hands on its commands."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.MAVLINK_DRIVER, MavlinkDriverParameters, **arguments)
        p: MavlinkDriverParameters = self.parameters
        if p.lockstep:
            raise ConfigurationError(
                f"{self.get_name()}: parameter lockstep", "true", "false: vehicles never wait"
            )
        self.limits = CommandLimits.of(vehicle.load(p.vehicle))
        where = f"{self.get_name()}: parameter"
        allowed = Configured(p.peer, f"{where} peer") if p.peer else None
        peer = Peer(p.vehicle_system, p.peer_timeout, allowed)
        key = load_key(p.signing_key, f"{where} signing_key")
        self.link = MavlinkLink(p.address, p.system, p.component, f"{where} address", peer, key)
        self._link_watch = LinkWatch(self.link, p.vehicle_system)
        settling = 0 if p.clock_speed else round(p.settling * 1e9)
        self._time: OffsetEstimate | FollowedClock = (
            FollowedClock(topics.FIRST_STAMP_NS, p.clock_speed) if p.clock_speed else OffsetEstimate(settling)
        )
        self._log_time = ComponentTime(self._time, settling)
        self._asked: deque[int] = deque(maxlen=_ASKED)
        self._assembly = Assembly()
        self._water_boot_ms = 0
        self._told: dict[Topic, int] = {}
        self._heard_at: int | None = None
        self._status = ""
        self._commands = Commands(self.limits, p.command_timeout)
        self._due = dict.fromkeys((_HEARTBEAT, _TIMESYNC), 0)
        self._odometry, self._water = Odometry(), TwistWithCovarianceStamped()
        self._odometry.header.frame_id, self._odometry.child_frame_id = p.world_frame, p.body_frame
        self._water.header.frame_id = p.body_frame
        self._publish = {
            topic: self.advertise(topic).publish
            for topic in (topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_STATE)
        }
        self._tell_clock = self.advertise(topics.CLOCK).publish if p.clock_speed else None
        self._clock_message, self._told_time = Clock(), 0
        self.listen(topics.RUDDER_CMD, lambda message: self._on_command(topics.RUDDER_CMD.name, message))
        self.listen(topics.THRUST_CMD, lambda message: self._on_command(topics.THRUST_CMD.name, message))
        self.listen(topics.MISSION_STATE, self._on_mission_state)
        autopilot = p.vehicle_component
        # Message -> the component that may send it (None: any), and its handler.
        self._handlers: dict[str, tuple[int | None, Callable[[Any], None]]] = {
            "HEARTBEAT": (autopilot, self._on_heartbeat),
            "STATUSTEXT": (None, self._on_text),
            "TIMESYNC": (autopilot, self._on_timesync),
            "ATTITUDE": (autopilot, self._on_attitude),
            "LOCAL_POSITION_NED": (autopilot, self._on_position),
            "SERVO_OUTPUT_RAW": (autopilot, self._on_servo),
            "ODOMETRY": (WATER_LOG, self._on_water_track),
        }
        steady = RosClock(clock_type=ClockType.STEADY_TIME)
        for period, look in ((_LISTEN, self._listen_to_vehicle), (_LOOK, self._look)):
            self.create_timer(period / max(p.clock_speed, 1.0), look, clock=steady)

    def claim(self) -> Claim | None:
        emulated = self.parameters.clock_speed > 0.0
        return of_simulator(self.get_namespace(), self.get_name()) if emulated else None

    def report(self) -> dict[str, Any]:
        values = {"vehicle": self._status or "not heard yet", **self._link_watch.values()}
        values |= {"vehicle restarts": self._time.restarts, "water log restarts": self._log_time.restarts}
        if isinstance(self._time, OffsetEstimate) and self._time.round_trip is not None:
            values["round trip [ms]"] = f"{self._time.round_trip * 1e-6:.1f}"
        return values | {f"dropped {what}": count for what, count in self._assembly.dropped.items()}

    def time_ns(self) -> int:
        """ROS time, also before our own /clock has come round."""
        if isinstance(self._time, FollowedClock):
            return self._time.now
        return int(self.get_clock().now().nanoseconds)

    def close(self) -> None:
        self.link.send(manual_control(STOP, self.limits, True, self.parameters.vehicle_system))
        self.link.close()

    # --- from the vehicle

    def _listen_to_vehicle(self) -> None:
        p = self.parameters
        for _ in range(_MOST):
            if (datagram := self.link.receive(0.0)) is None:
                return
            for message in self.link.messages(datagram):
                component, handler = self._handlers.get(message.get_type(), (0, None))
                if handler is None or message.get_srcSystem() != p.vehicle_system:
                    continue
                self._heard_at = self.time_ns()
                if component not in (None, message.get_srcComponent()):
                    what = f"{message.get_type()} of component {message.get_srcComponent()}"
                    self._assembly.dropped[what] += 1
                    continue
                try:
                    handler(message)
                except MessageRefused as error:
                    self.health.refuse(error)

    def _hear_time(self, boot_ms: int) -> None:
        """Take in the time of the autopilot; forget the measurements of a vehicle that was restarted."""
        boot = boot_ms * 1_000_000
        if isinstance(self._time, FollowedClock):
            anew = self._time.heard(boot, time.monotonic_ns())
            self._tell_time(self._time.now)
        else:
            anew = self._time.heard(boot, self.time_ns())
        if anew:
            self.get_logger().warning("the vehicle was started anew")
            self._assembly.reset()

    def _tell(self, topic: Topic, message: Any, stamp: int) -> None:
        """Publish a measurement if its stamp does not go back."""
        if stamp <= self._told.get(topic, 0):
            self._assembly.dropped[f"{topic.name} while time was corrected"] += 1
            return
        self._told[topic] = stamp
        self._publish[topic](message)

    def _tell_time(self, now: int) -> None:
        """Publish /clock, in steps of `_CLOCK_PERIOD`."""
        if self._tell_clock is not None and now >= self._told_time + _CLOCK_PERIOD:
            self._told_time = now
            set_stamp(self._clock_message.clock, now)
            self._tell_clock(self._clock_message)

    def _on_heartbeat(self, message: Any) -> None:
        armed = "armed" if message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED else "not armed"
        known = mavlink.enums["MAV_STATE"].get(message.system_status)
        state = known.name.removeprefix("MAV_STATE_").lower() if known else f"state {message.system_status}"
        self._status = f"{state}, {armed}"
        self.health.warn("armed", "the vehicle is not armed" if armed == "not armed" else "")

    def _on_text(self, message: Any) -> None:
        self.get_logger().warning(f"the vehicle says: {message.text}")

    def _on_timesync(self, message: Any) -> None:
        answered = message.tc1 and message.ts1 in self._asked
        if answered and isinstance(self._time, OffsetEstimate):
            self._time.exchanged(message.ts1, message.tc1, self.time_ns())

    def _on_attitude(self, message: Any) -> None:
        self._hear_time(message.time_boot_ms)
        self._assembly.attitude(Attitude(message.time_boot_ms, message.yaw, message.yawspeed))

    def _on_position(self, message: Any) -> None:
        self._hear_time(message.time_boot_ms)
        m = message
        fused = self._assembly.position(Position(m.time_boot_ms, m.x, m.y, m.vx, m.vy))
        if fused is not None and self._time.settled:
            stamp = self._time.stamp(fused.boot_ms * 1_000_000)
            fill_odometry(self._odometry, fused.navigation, fused.u, fused.v, stamp)
            self._tell(topics.ODOM, self._odometry, stamp)

    def _on_water_track(self, message: Any) -> None:
        if message.child_frame_id != mavlink.MAV_FRAME_BODY_FRD:
            raise MessageRefused("ODOMETRY", f"child_frame_id {message.child_frame_id}", "MAV_FRAME_BODY_FRD")
        finite(message.vx + message.vy, "ODOMETRY")
        boot_ms = message.time_usec // 1000
        if self._log_time.heard(boot_ms * 1_000_000, self.time_ns()):
            self.get_logger().warning("the vehicle's water log was started anew")
            self._water_boot_ms = 0
        if boot_ms > self._water_boot_ms and self._log_time.settled:
            self._water_boot_ms = boot_ms
            stamp = self._log_time.stamp(boot_ms * 1_000_000)
            fill_water_velocity(self._water, WaterVelocity(message.vx, message.vy), stamp)
            self._tell(topics.WATER_VELOCITY, self._water, stamp)

    def _on_servo(self, message: Any) -> None:
        if self.parameters.rudder_servo:
            pulse = getattr(message, f"servo{self.parameters.rudder_servo}_raw")
            self._publish[topics.RUDDER_STATE](Float64(data=rudder_of_pulse(pulse, self.limits)))

    # --- to the vehicle

    def _on_command(self, topic: str, message: Float64) -> None:
        if self._commands.put(topic, finite(message.data, topic), self.time_ns()):
            self._send_command()

    def _on_mission_state(self, message: Any) -> None:
        self._commands.mission_is(message.data, time.monotonic())

    def _send_command(self) -> None:
        p, now = self.parameters, self.time_ns()
        silent = self._commands.silent(now)
        self.health.error("commands", "no commands: the vehicle is stopped" if silent else "")
        command = self._commands.command(now, time.monotonic())
        clockwise = p.turn_axis == "clockwise"
        self.link.send(manual_control(command, self.limits, clockwise, p.vehicle_system))

    def _look(self) -> None:
        """Watch for silence, report the link, send what is due."""
        p, now = self.parameters, self.time_ns()
        if isinstance(self._time, FollowedClock) and self._time.pass_silence(time.monotonic_ns()):
            self._tell_time(self._time.now)
        if self._commands.none_since(now):
            self._send_command()
        if self._heard_at is not None:
            silent = now - self._heard_at > p.link_timeout * 1e9
            self.health.error("link", f"no word from the vehicle for {p.link_timeout:g} s" if silent else "")
        for name, text in self._link_watch.conditions(time.monotonic(), self._heard_at is not None).items():
            self.health.warn(name, text)
        if moved := self._link_watch.moved():
            self.get_logger().warning(f"{moved}: the old address was silent for {p.peer_timeout:g} s")
        for period, message in (
            (_HEARTBEAT, heartbeat()),
            (_TIMESYNC, mavlink.MAVLink_timesync_message(0, now)),
        ):
            if now >= self._due[period] or now < self._due[period] - 2e9 * period:  # or the clock went back
                self._due[period] = now + round(period * 1e9)
                self.link.send(message)
                if period == _TIMESYNC:
                    self._asked.append(now)


def main(args: Sequence[str] | None = None) -> int:
    """The executable `mavlink_driver`."""
    return run_nodes([MavlinkDriverNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
