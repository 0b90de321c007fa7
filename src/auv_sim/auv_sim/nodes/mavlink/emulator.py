"""A vehicle to try a driver on: the REMUS plant behind MAVLink over UDP, without ROS.

    python3 -m auv_sim.nodes.mavlink.emulator --address udpout:127.0.0.1:14550

It behaves as vehicles do: each message has its own rate and its own delay, some overtake others or are lost,
time counts from its boot, and without a command for a second it stops.
"""

from __future__ import annotations

import argparse
import math
import random
import signal
import time
from collections.abc import Callable, Sequence
from typing import NoReturn

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SpatialCurrent
from auv_path_following import vehicle
from auv_sim.command_line import EXIT_DONE, Parser, command, finite, not_negative, positive
from auv_sim.nodes.mavlink.delay_line import DelayLine
from auv_sim.nodes.mavlink.emulated_diver import emulator_of
from auv_sim.nodes.mavlink.emulated_vehicle import KINDS, LINKS, STEP_MS, UPLINK, Emulator
from auv_sim.nodes.mavlink.mapping import WATER_LOG
from auv_sim.nodes.mavlink.transport.link import STANDARD_PORT, MavlinkLink
from auv_sim.nodes.mavlink.transport.signing import load_key
from auv_sim.sim_parameters import CRUISE

#: Faster than real time: largest lag that is caught up, s of the vehicle's time; longest wait for an answer,
#: and the period of looking for it, s of wall time.
_PATIENCE, _WAIT, _LOOK = 0.1, 0.25, 0.001

#: Options of a vehicle with stern planes: flag, type, metavar, help.
_DIVING: tuple[tuple[str, Callable[[str], float], str, str], ...] = (
    ("--depth", not_negative, "M", "depth at the start"),
    ("--pitch", finite, "DEG", "pitch at the start, positive bow up"),
    ("--upwelling", finite, "VZ", "current upwards, m/s"),
    ("--bottom", not_negative, "M", "depth of the bottom below its echo sounder; 0: it has none"),
)


class LiveVehicle:
    """The vehicle on its link, at a multiple of real time, with a share of messages lost both ways.

    In real time it never waits. Faster, every delay of this machine would be `speed` times as long for the
    vehicle. There its time stands still between a position and the command that answers it, so that only the
    line's own delays are left; but for `_WAIT` at most, and only while commands arrive.

    Args:
        emulator: the vehicle.
        link: to the driver.
        speed: times real time.
        loss: share of messages lost.
        seed: of delays and losses.
    """

    def __init__(self, emulator: Emulator, link: MavlinkLink, speed: float, loss: float, seed: int) -> None:
        self._emulator, self._link, self._speed = emulator, link, speed
        dice = random.Random(seed)  # noqa: S311 - delays, not secrets
        self._down, self._up = DelayLine(loss, dice), DelayLine(loss, dice)
        self._next_step = time.monotonic()
        self._answer_due = float("-inf")

    def run(self) -> NoReturn:
        """Step and exchange messages until interrupted."""
        while True:
            self._receive()
            now = time.monotonic()
            if now < self._next_step:
                continue  # an ICMP error: no socket at the other end yet
            if now < self._answer_due:
                self._next_step = now + _LOOK
                continue
            for message in self._up.take(self._emulator.now_ms):
                self._emulator.hear(message)
            self._emulator.step()
            # In the tube at real time: waiting faster gains nothing.
            self._next_step += STEP_MS * 1e-3 / (1.0 if self._emulator.in_tube else self._speed)
            if self._speed > 1.0:
                self._next_step = max(self._next_step, now - _PATIENCE / self._speed)
            self._send()

    def _receive(self) -> None:
        """Put what arrives before the next step into the uplink."""
        wait = self._next_step - time.monotonic()
        while (datagram := self._link.receive(max(wait, 0.0))) is not None:
            for message in self._link.messages(datagram):
                self._up.put(self._emulator.now_ms, UPLINK, message)
                if message.get_type() == "MANUAL_CONTROL":
                    self._answer_due = float("-inf")
            wait = self._next_step - time.monotonic()

    def _send(self) -> None:
        """Put the vehicle's messages into the downlink, and send those that have passed it."""
        now_ms = self._emulator.now_ms
        for kind, message in self._emulator.sent:
            component = WATER_LOG if message.get_type() == "ODOMETRY" else None
            data = self._link.pack(message, component, line=LINKS[kind])
            self._down.put(now_ms, kind, (kind, data))
        self._emulator.sent.clear()
        for kind, data in self._down.take(now_ms):
            self._link.send_bytes(data)
            if self._speed > 1.0 and kind is KINDS["position"] and not self._emulator.failsafe:
                self._answer_due = time.monotonic() + _WAIT


def _arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    p = Parser(
        prog="emulator", description="A REMUS 100 behind MAVLink, to try a driver on.", allow_abbrev=False
    )
    p.add_argument(
        "--address",
        default=f"udpout:127.0.0.1:{STANDARD_PORT}",
        help="where the driver is (default %(default)s)",
    )
    vehicle_help = "vehicle file, or the name of a shipped one"
    p.add_argument("--vehicle", default="remus100", metavar="FILE", help=vehicle_help)
    p.add_argument(
        "--initial",
        nargs=3,
        type=finite,
        default=(0.0, 0.0, 0.0),
        metavar=("X", "Y", "PSI_DEG"),
        help="start: north, east (m), heading (deg)",
    )
    surge_help = "speed at the first thrust, m/s (default %(default)s)"
    p.add_argument("--surge", type=not_negative, default=CRUISE, help=surge_help)
    p.add_argument(
        "--current",
        nargs=2,
        type=finite,
        default=(0.0, 0.0),
        metavar=("VX", "VY"),
        help="current towards north and east, m/s",
    )
    for flag, kind, metavar, text in _DIVING:
        p.add_argument(flag, type=kind, default=0.0, metavar=metavar, help=f"{text}; with stern planes")
    p.add_argument("--speed", type=positive, default=1.0, metavar="N", help="times real time")
    p.add_argument(
        "--loss", type=not_negative, default=0.0, metavar="P", help="share of messages lost, both ways"
    )
    p.add_argument("--seed", type=int, default=1, help="of delays and losses")
    p.add_argument(
        "--signing-key", default="", metavar="FILE", help="sign, and obey signed commands only (mode 0600)"
    )
    return p.parse_args(argv)


@command("emulator")
def main(argv: Sequence[str] | None = None) -> int:
    """Run until interrupted."""
    a = _arguments(argv)
    hull = vehicle.load(a.vehicle)
    for flag, *_ in _DIVING:
        if getattr(a, flag[2:]) and not hull.dives:
            raise ConfigurationError(flag, f"vehicle {hull.name}", "a vehicle with stern planes")
    north, east, heading = a.initial
    start = north, east, a.depth, math.radians(a.pitch), math.radians(heading)
    current = SpatialCurrent(a.current[0], a.current[1], -a.upwelling)
    emulator = emulator_of(hull, start, a.surge, current, a.bottom)
    key = load_key(a.signing_key, "--signing-key")
    link = MavlinkLink(a.address, 1, mavlink.MAV_COMP_ID_AUTOPILOT1, "--address", key=key)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        LiveVehicle(emulator, link, a.speed, a.loss, a.seed).run()
    except KeyboardInterrupt:
        return EXIT_DONE
    finally:
        link.close()


if __name__ == "__main__":
    raise SystemExit(main())
