"""mavlink_driver: between a vehicle that speaks MAVLink over UDP and the wire contract."""

from __future__ import annotations

import time
from collections.abc import Sequence
from functools import partial
from typing import Any

from pymavlink.dialects.v20 import common as mavlink
from rclpy.clock import Clock, ClockType
from std_msgs.msg import Float64

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim, of_simulator
from auv_msgs_py.contract.conversions import finite
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_msgs_py.values.types import Command, SpatialCommand
from auv_path_following import vehicle
from auv_sim.driver_parameters import MavlinkDriverParameters
from auv_sim.nodes.held_commands import HeldCommands, orders_of
from auv_sim.nodes.mavlink.mapping import CommandLimits, heartbeat, manual_control
from auv_sim.nodes.mavlink.transport.link import MavlinkLink
from auv_sim.nodes.mavlink.transport.link_watch import LinkWatch
from auv_sim.nodes.mavlink.transport.peer import Configured, Peer
from auv_sim.nodes.mavlink.transport.signing import load_key
from auv_sim.nodes.mavlink.vehicle_messages import VehicleMessages
from auv_sim.nodes.mavlink.vehicle_time import FollowedClock

#: Periods of reading the socket, of the watches, of the heartbeat and of the requests for the vehicle's
#: time, s of ROS time.
_LISTEN, _SUPERVISE, _HEARTBEAT, _TIMESYNC = 0.005, 0.05, 1.0, 0.5
#: Most datagrams read in a row, so that a flood does not starve the node's other work.
_MOST = 200


class MavlinkDriverNode(SuiteNode):
    """Publishes the vehicle's topics of the contract and forwards its commands."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.MAVLINK_DRIVER, MavlinkDriverParameters, **arguments)
        p: MavlinkDriverParameters = self.parameters
        where = f"{self.get_name()}: parameter"
        if p.lockstep:
            raise ConfigurationError(f"{where} lockstep", "true", "false: vehicles never wait")
        hull = vehicle.load(p.vehicle)
        self.limits = CommandLimits.of(hull)
        allowed = Configured(p.peer, f"{where} peer") if p.peer else None
        peer = Peer(p.vehicle_system, p.peer_timeout, allowed)
        key = load_key(p.signing_key, f"{where} signing_key")
        self.link = MavlinkLink(p.address, p.system, p.component, f"{where} address", peer, key)
        self._link_watch = LinkWatch(self.link, p.vehicle_system)
        self._vehicle = VehicleMessages(self, self.limits)
        orders = orders_of(hull)
        self._stop = orders.stop
        self._commands = HeldCommands(orders)
        self._due = dict.fromkeys((_HEARTBEAT, _TIMESYNC), 0)
        for topic in (topics.RUDDER_CMD, topics.THRUST_CMD, topics.STERNPLANE_CMD):
            if topic.name in orders.limits:
                self.listen(topic, partial(self._on_command, topic.name))
        self.listen(topics.MISSION_STATE, self._on_mission_state)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        for period, callback in ((_LISTEN, self._read_link), (_SUPERVISE, self._supervise)):
            self.create_timer(period / max(p.clock_speed, 1.0), callback, clock=steady)

    def claim(self) -> Claim | None:
        emulated = self.parameters.clock_speed > 0.0
        return of_simulator(self.get_namespace(), self.get_name()) if emulated else None

    def report(self) -> dict[str, Any]:
        values = {"vehicle": self._vehicle.status, **self._link_watch.values()}
        return values | self._vehicle.values() | self._vehicle.dropped

    def time_ns(self) -> int:
        """Return ROS time, ns, without waiting for our own /clock."""
        return self._vehicle.time_ns()

    def close(self) -> None:
        self._order(self._stop)
        self.link.close()

    def _read_link(self) -> None:
        """Process the datagrams that have arrived."""
        for _ in range(_MOST):
            if (datagram := self.link.receive(0.0)) is None:
                return
            for message in self.link.messages(datagram):
                try:
                    self._vehicle.process(message)
                except MessageRefused as error:
                    self.health.refuse(error)

    def _on_command(self, topic: str, message: Float64) -> None:
        self._commands.put(topic, finite(message.data, topic), self.time_ns())
        if topic == topics.THRUST_CMD.name and self._commands.is_complete:  # the autopilot sends it last
            self._send_command()

    def _on_mission_state(self, message: Any) -> None:
        refused = self._commands.mission.hear(message.data, time.monotonic())
        if refused is not None:
            raise refused

    def _send_command(self) -> None:
        now, timeout = self.time_ns(), self.parameters.command_timeout
        self.health.error("commands", self._commands.complaint(now, timeout))
        self._order(self._commands.in_force(now, timeout, time.monotonic()))

    def _order(self, command: Command | SpatialCommand) -> None:
        """Send a command to the vehicle."""
        p = self.parameters
        signs = p.turn_axis == "clockwise", p.vehicle_system, p.pitch_axis == "bow-down"
        self.link.send(manual_control(command, self.limits, *signs))

    def _supervise(self) -> None:
        """Watch for silence, report the link, send what is due."""
        p, now, time_of_vehicle = self.parameters, self.time_ns(), self._vehicle.time
        if isinstance(time_of_vehicle, FollowedClock) and time_of_vehicle.pass_silence(time.monotonic_ns()):
            self._vehicle.topics.clock(time_of_vehicle.now)
        if self._commands.silent(now, p.command_timeout):
            self._send_command()
        heard_at = self._vehicle.heard_at
        if heard_at is not None:
            silent = now - heard_at > p.link_timeout * 1e9
            self.health.error("link", f"no word from the vehicle for {p.link_timeout:g} s" if silent else "")
        for name, text in self._link_watch.conditions(time.monotonic(), heard_at is not None).items():
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
                    self._vehicle.requests.append(now)


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `mavlink_driver`."""
    return run_nodes([MavlinkDriverNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
