"""A vehicle to try a driver on: the REMUS plant behind MAVLink over UDP, without ROS.

    python3 -m auv_sim.nodes.mavlink.emulator --address udpout:127.0.0.1:14550

It behaves as vehicles do: each message has its own rate and its own delay, some overtake others or are lost,
time counts from its boot, and without a command for a second it stops.
"""

from __future__ import annotations

import heapq
import math
import random
import signal
import time
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, NoReturn

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.types import STOP, Command, Current
from auv_path_following import vehicle
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, Parser, command, finite, not_negative, positive
from auv_sim.nodes.mavlink.link import STANDARD_PORT, MavlinkLink
from auv_sim.nodes.mavlink.mapping import (
    WATER_LOG,
    CommandLimits,
    command_of,
    pulse_of_rudder,
    water_track,
)
from auv_sim.nodes.mavlink.signing import load_key
from auv_sim.sim_parameters import CRUISE
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

#: One step, ms; every period below is a multiple of it.
STEP_MS = 10
#: Without a command for this long the vehicle stops, ms.
COMMAND_TIMEOUT_MS = 1000
#: What the vehicle's clock shows when the program starts, ms: it has been on for a while.
BOOT_MS = 12_340
#: Faster than real time: a lag of more is not caught up, s of the vehicle's time; how long an answer is
#: waited for, and how often looked for, s of wall time.
_PATIENCE, _WAIT, _LOOK = 0.1, 0.25, 0.001


class MessageKind(NamedTuple):
    """A kind of message: its period, the delay on its way and how much that varies (all ms)."""

    period: int
    delay: float
    jitter: float


CHANNELS = {
    "attitude": MessageKind(20, 20.0, 5.0),
    "position": MessageKind(50, 40.0, 10.0),
    "water": MessageKind(100, 60.0, 20.0),
    "servo": MessageKind(100, 30.0, 10.0),
    "heartbeat": MessageKind(1000, 20.0, 5.0),
}
#: Answers and warnings come at any time: with a delay that varied they would overtake each other.
ANSWERS = MessageKind(0, 20.0, 0.0)
#: Signatures have to rise on each line, and messages of different channels overtake each other.
LINES = {channel: number for number, channel in enumerate((*CHANNELS.values(), ANSWERS))}
#: What the vehicle hears: commands and questions.
UPLINK = MessageKind(0, 20.0, 5.0)


class Emulator:
    """The vehicle, its instruments and its failsafe; time comes in from outside, ms since boot.

    Until the first thrust it lies in its launching tube: it stays where it is, and says so.

    Args:
        hull: what it is.
        initial: where it begins; its speed is what the first thrust finds.
        current: of the water, m/s, NED.
    """

    def __init__(self, hull: Vehicle, initial: PlantState, current: Current) -> None:
        self.plant = SimulatedVehicle(hull, initial, current=current)
        self.limits = CommandLimits.of(hull)
        self.now_ms = BOOT_MS
        self.in_tube = True
        self.failsafe = True
        self.failsafes = 0
        #: What it has said since this was last cleared: (kind of message, message).
        self.said: list[tuple[MessageKind, Any]] = []
        self._command, self._commanded_at = STOP, -COMMAND_TIMEOUT_MS

    def hear(self, message: Any) -> None:
        """Take in what came from the driver."""
        kind = message.get_type()
        if kind == "MANUAL_CONTROL":
            self._command, self._commanded_at = command_of(message, self.limits, clockwise=True), self.now_ms
            self.failsafe = False
            if self._command.thrust > 0.0:
                self.in_tube = False
        elif kind == "TIMESYNC" and message.tc1 == 0:
            answer = mavlink.MAVLink_timesync_message(self.now_ms * 1_000_000, message.ts1)
            self.said.append((ANSWERS, answer))

    def step(self) -> None:
        """Measure and say so, then let one step pass."""
        for name, channel in CHANNELS.items():
            if self.now_ms % channel.period == 0:
                self.said.append((channel, getattr(self, f"_{name}")()))
        if not self.failsafe and self.now_ms - self._commanded_at > COMMAND_TIMEOUT_MS:
            self.failsafe = True
            self.failsafes += 1
            text = f"failsafe: no command for {COMMAND_TIMEOUT_MS / 1000:g} s".encode()
            message = mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_CRITICAL, text)
            self.said.append((ANSWERS, message))
        command: Command = STOP if self.failsafe else self._command
        if not self.in_tube:
            self.plant.advance(command, STEP_MS * 1e-3)
        self.now_ms += STEP_MS

    def _heartbeat(self) -> Any:
        state = mavlink.MAV_STATE_CRITICAL if self.failsafe and not self.in_tube else mavlink.MAV_STATE_ACTIVE
        mode = mavlink.MAV_MODE_FLAG_SAFETY_ARMED | mavlink.MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
        return mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_SUBMARINE, mavlink.MAV_AUTOPILOT_GENERIC, mode, 0, state, 3
        )

    def _attitude(self) -> Any:
        state = self.plant.motion
        psi, r = math.remainder(state.psi, math.tau), 0.0 if self.in_tube else state.r
        return mavlink.MAVLink_attitude_message(self.now_ms, 0.0, 0.0, psi, 0.0, 0.0, r)

    def _position(self) -> Any:
        state = self.plant.motion
        u, v = (0.0, 0.0) if self.in_tube else self.plant.ground_velocity
        cos_psi, sin_psi = math.cos(state.psi), math.sin(state.psi)
        return mavlink.MAVLink_local_position_ned_message(
            self.now_ms, state.x, state.y, 0.0, u * cos_psi - v * sin_psi, u * sin_psi + v * cos_psi, 0.0
        )

    def _water(self) -> Any:
        ur, vr = (0.0, 0.0) if self.in_tube else self.plant.water_velocity
        return water_track(self.now_ms * 1000, ur, vr)

    def _servo(self) -> Any:
        pulse = pulse_of_rudder(self.plant.rudder, self.limits)
        return mavlink.MAVLink_servo_output_raw_message(self.now_ms * 1000 % 2**32, 0, pulse, *[0] * 7)


class DelayLine:
    """A cable or an acoustic modem: what goes in comes out later, perhaps in another order, perhaps never.

    Args:
        loss: the share of messages that never arrives.
        dice: seeded.
    """

    def __init__(self, loss: float, dice: random.Random) -> None:
        self._loss, self._dice = loss, dice
        self._under_way: list[tuple[float, int, Any]] = []
        self._number = 0

    def put(self, now: float, channel: MessageKind, item: Any) -> None:
        """Something goes in at `now`, ms."""
        if self._dice.random() < self._loss:
            return
        self._number += 1
        due = now + max(0.0, channel.delay + self._dice.uniform(-channel.jitter, channel.jitter))
        heapq.heappush(self._under_way, (due, self._number, item))

    def take(self, now: float) -> Iterator[Any]:
        """What has come out by `now`, ms."""
        while self._under_way and self._under_way[0][0] <= now:
            yield heapq.heappop(self._under_way)[2]


def live(emulator: Emulator, link: MavlinkLink, speed: float, loss: float, seed: int) -> NoReturn:
    """Let the vehicle live at `speed` times real time, with a share of messages lost both ways.

    In real time it never waits. Faster, every delay of this machine would be `speed` times as
    long for the vehicle. There its time stands still between a position and the command that answers it, so
    that only the line's own delays are left; but for `_WAIT` at most, and only while commands come.
    """
    dice = random.Random(seed)  # noqa: S311 - delays, not secrets
    down, up = DelayLine(loss, dice), DelayLine(loss, dice)
    next_step = time.monotonic()
    answer_due = float("-inf")
    while True:
        wait = next_step - time.monotonic()
        while (datagram := link.receive(max(wait, 0.0))) is not None:
            for message in link.messages(datagram):
                up.put(emulator.now_ms, UPLINK, message)
                if message.get_type() == "MANUAL_CONTROL":
                    answer_due = float("-inf")
            wait = next_step - time.monotonic()
        now = time.monotonic()
        if now < next_step:
            continue  # it was an ICMP error: no socket at the other end yet
        if now < answer_due:
            next_step = now + _LOOK
            continue
        for message in up.take(emulator.now_ms):
            emulator.hear(message)
        emulator.step()
        next_step += (
            STEP_MS * 1e-3 / (1.0 if emulator.in_tube else speed)
        )  # nothing is gained by waiting fast
        if speed > 1.0:
            next_step = max(next_step, now - _PATIENCE / speed)
        for channel, message in emulator.said:
            component = WATER_LOG if message.get_type() == "ODOMETRY" else None
            data = link.pack(message, component, line=LINES[channel])
            down.put(emulator.now_ms, channel, (channel, data))
        emulator.said.clear()
        for channel, data in down.take(emulator.now_ms):
            link.send_bytes(data)
            if speed > 1.0 and channel is CHANNELS["position"] and not emulator.failsafe:
                answer_due = time.monotonic() + _WAIT


@command("emulator")
def main(argv: Sequence[str] | None = None) -> int:
    """Run until interrupted."""
    p = Parser(
        prog="emulator", description="A REMUS 100 behind MAVLink, to try a driver on.", allow_abbrev=False
    )
    p.add_argument(
        "--address",
        default=f"udpout:127.0.0.1:{STANDARD_PORT}",
        help="where the driver is (default %(default)s)",
    )
    p.add_argument(
        "--vehicle", default="remus100", metavar="FILE", help="vehicle file, or the name of a shipped one"
    )
    p.add_argument(
        "--initial",
        nargs=3,
        type=finite,
        default=(0.0, 0.0, 0.0),
        metavar=("X", "Y", "PSI_DEG"),
        help="start: north, east (m), heading (deg)",
    )
    p.add_argument(
        "--surge",
        type=not_negative,
        default=CRUISE,
        help="speed at the first thrust, m/s (default %(default)s)",
    )
    p.add_argument(
        "--current",
        nargs=2,
        type=finite,
        default=(0.0, 0.0),
        metavar=("VX", "VY"),
        help="current towards north and east, m/s",
    )
    p.add_argument("--speed", type=positive, default=1.0, metavar="N", help="times real time")
    p.add_argument(
        "--loss", type=not_negative, default=0.0, metavar="P", help="share of messages lost, both ways"
    )
    p.add_argument("--seed", type=int, default=1, help="of delays and losses")
    p.add_argument(
        "--signing-key", default="", metavar="FILE", help="sign, and obey signed commands only (mode 0600)"
    )
    a = p.parse_args(argv)
    hull = vehicle.load(a.vehicle)
    north, east, heading = a.initial
    start = PlantState(north, east, math.radians(heading), a.surge, 0.0, 0.0)
    emulator = Emulator(hull, start, Current(*a.current))
    key = load_key(a.signing_key, "--signing-key")
    link = MavlinkLink(a.address, 1, mavlink.MAV_COMP_ID_AUTOPILOT1, "--address", key=key)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        live(emulator, link, a.speed, a.loss, a.seed)
    except KeyboardInterrupt:
        return EXIT_DONE
    finally:
        link.close()


if __name__ == "__main__":
    raise SystemExit(main())
