"""Strange datagrams at the MAVLink driver's port: what a thousand a second cost the vehicle.

    python3 -m auv_sim.checks.faults.strangers --seconds 60

starts the driver and an emulated vehicle on the loopback interface, counts odometries without and then with
strangers, and checks that no stranger ever receives a command. It ends after twice `--seconds`.
"""

from __future__ import annotations

import random
import socket
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import rclpy
from nav_msgs.msg import Odometry
from pymavlink.dialects.v20 import common as mavlink
from rclpy.experimental import EventsExecutor
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import Float64

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.errors import SuiteError
from auv_sim.checks.patience import PATIENCE
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, Parser, command, positive
from auv_sim.launch.processes.process_group import Children
from auv_sim.launch.vehicle_driver import EMULATOR, EMULATOR_MODULE, free_port
from auv_sim.nodes.mavlink.mapping import WATER_LOG, water_track
from auv_sim.nodes.mavlink.transport.datagrams import Codec

#: Share of the undisturbed rate of odometry that strangers may not take.
LEAST_SHARE = 0.95
_DRIVER_MODULE = "auv_sim.nodes.mavlink.driver"
#: For the strangers to be sure of a start after the first odometry, s of wall time.
_SETTLING = 2.0
#: Beyond this the generator stops whatever happens, s.
_LONGEST = 600.0

Maker = Callable[[random.Random], bytes]


def _kinds() -> tuple[Maker, ...]:
    """Ten kinds of datagram: garbage, and forgeries in the name of the vehicle (system 1)."""
    vehicle, other = Codec(1, 1), Codec(77, 1)
    v1 = mavlink.MAVLink(None, 1, 1)

    def position(dice: random.Random) -> bytes:
        far = [1e4 * dice.random(), 1e4, 0.0, 3.0, 3.0, 0.0]
        return vehicle.pack(mavlink.MAVLink_local_position_ned_message(dice.randrange(2**32), *far))

    def attitude(dice: random.Random) -> bytes:
        return vehicle.pack(mavlink.MAVLink_attitude_message(dice.randrange(2**32), *[dice.random()] * 6))

    def wrong_checksum(dice: random.Random) -> bytes:
        data = bytearray(position(dice))
        data[-1] ^= 0xFF
        return bytes(data)

    def unknown_state(dice: random.Random) -> bytes:
        return vehicle.pack(mavlink.MAVLink_heartbeat_message(12, 0, 0, 0, dice.randrange(100, 256), 3))

    return (
        lambda dice: bytes.fromhex("fdff0000000101200000"),  # promises 255 bytes and sends none of them
        lambda dice: dice.randbytes(dice.randrange(1, 300)),
        lambda dice: b"",
        lambda dice: b"\xfd" * 60_000,
        lambda dice: position(dice)[:-5],
        position,
        attitude,
        wrong_checksum,
        unknown_state,
        lambda dice: dice.choice(
            (
                vehicle.pack(water_track(dice.randrange(2**62), 9.0, 9.0), component=WATER_LOG),
                other.pack(mavlink.MAVLink_attitude_message(1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)),
                mavlink.MAVLink_attitude_message(1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0).pack(
                    v1, force_mavlink1=True
                ),
            )
        ),
    )


class Strangers(threading.Thread):
    """Sends datagrams of every kind, each from a socket of its own, and counts what comes back.

    Args:
        port: on the loopback interface.
        rate: datagrams a second, all kinds together.
        seconds: after which it stops; never longer than `_LONGEST`.
    """

    def __init__(self, port: int, rate: float, seconds: float) -> None:
        super().__init__(daemon=True)
        self._to, self._rate, self._seconds = ("127.0.0.1", port), rate, min(seconds, _LONGEST)
        self.sent = self.answered = 0

    def run(self) -> None:
        dice, kinds = random.Random(7), _kinds()  # noqa: S311 - no secrets
        sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in kinds]
        begin = time.monotonic()
        while (passed := time.monotonic() - begin) < self._seconds:
            while self.sent < passed * self._rate:
                k = self.sent % len(kinds)
                sockets[k].sendto(kinds[k](dice), self._to)
                self.sent += 1
            time.sleep(0.002)
        for each in sockets:
            each.setblocking(False)
            try:
                each.recv(1)
                self.answered += 1
            except BlockingIOError:
                pass
            each.close()


class StrangerCounts(NamedTuple):
    """Odometries and datagrams of a measurement.

    Attributes:
        calm, disturbed: odometries a second without and with strangers.
        sent: datagrams of strangers.
        answered: strangers that received anything.
        misled: odometries that a forgery moved, by more than 100 m.
    """

    calm: float
    disturbed: float
    sent: int
    answered: int
    misled: int

    @property
    def passed(self) -> bool:
        """Whether the strangers changed nothing."""
        return self.disturbed >= LEAST_SHARE * self.calm and not self.answered and not self.misled

    def __str__(self) -> str:
        share = 100.0 * self.disturbed / self.calm
        return (
            f"odometry {self.calm:.2f} Hz undisturbed, {self.disturbed:.2f} Hz ({share:.1f} %) under"
            f" {self.sent} datagrams of strangers; {self.answered} strangers received a command,"
            f" {self.misled} odometries were misled"
        )


def measure(seconds: float, rate: float = 1000.0) -> StrangerCounts:
    """Start driver and emulated vehicle; count odometries for `seconds` s each without and with strangers.

    Raises:
        SuiteError: no odometry came at all.
    """
    port = free_port()
    with tempfile.TemporaryDirectory(prefix="auv-strangers-") as directory:
        children = Children(Path(directory), {})
        parameters = ("-p", f"address:=udpin:127.0.0.1:{port}", "-r", "__ns:=/auv")
        children.start(topics.MAVLINK_DRIVER, _DRIVER_MODULE, ("--ros-args", *parameters))
        children.start(EMULATOR, EMULATOR_MODULE, ("--address", f"udpout:127.0.0.1:{port}"))
        try:
            return _count(port, seconds, rate)
        finally:
            children.stop()


def _count(port: int, seconds: float, rate: float) -> StrangerCounts:
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("strangers", namespace="/auv", use_global_arguments=False)
    executor = EventsExecutor()
    executor.add_node(node)
    heard: list[Odometry] = []
    node.create_subscription(Odometry, topics.ODOM.name, heard.append, qos.requested(topics.ODOM, True, 100))
    commands = [
        node.create_publisher(Float64, topic.name, qos.offered(topic))
        for topic in (topics.RUDDER_CMD, topics.THRUST_CMD)
    ]

    def spin(duration: float) -> int:
        """Return how many odometries came; answer each with a command, as the autopilot does."""
        heard.clear()
        answered, end = 0, time.monotonic() + duration
        while time.monotonic() < end:
            executor.spin_once(timeout_sec=0.02)
            if len(heard) > answered:
                answered = len(heard)
                for publisher in commands:
                    publisher.publish(Float64(data=0.0))
        return len(heard)

    try:
        deadline = time.monotonic() + PATIENCE
        while not spin(0.5):
            if time.monotonic() > deadline:
                raise SuiteError(f"no odometry within {PATIENCE:g} s")
        spin(_SETTLING)
        calm = spin(seconds)
        strangers = Strangers(port, rate, seconds)
        strangers.start()
        disturbed = spin(seconds)
        misled = sum(abs(message.pose.pose.position.x) > 100.0 for message in heard)
        strangers.join()
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
    return StrangerCounts(calm / seconds, disturbed / seconds, strangers.sent, strangers.answered, misled)


@command("strangers")
def main(argv: Sequence[str] | None = None) -> int:
    """Measure and print; return 0 if the vehicle was not disturbed, else 1."""
    p = Parser(prog="mavlink_strangers", description="Strangers at the MAVLink driver's door.")
    p.add_argument("--seconds", type=positive, default=60.0, help="without, and with strangers (default 60)")
    p.add_argument("--rate", type=positive, default=1000.0, help="datagrams a second (default 1000)")
    options = p.parse_args(sys.argv[1:] if argv is None else argv)
    result = measure(min(options.seconds, _LONGEST), options.rate)
    print(result)
    return EXIT_DONE if result.passed else EXIT_FAILED


if __name__ == "__main__":
    raise SystemExit(main())
