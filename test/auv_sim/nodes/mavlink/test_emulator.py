"""The emulated vehicle: its messages, their rates, and its stop without commands."""

from __future__ import annotations

import itertools
import random
from collections import Counter
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.types import STOP, Command, Current
from auv_path_following import vehicle
from auv_sim.nodes.mavlink.delay_line import DelayLine, MessageKind
from auv_sim.nodes.mavlink.emulated_vehicle import ALTITUDE, ANSWERS, BOOT_MS, KINDS, LINKS, Emulator
from auv_sim.nodes.mavlink.mapping import CommandLimits, manual_control
from auv_sim.vehicle.remus import PlantState

REMUS = vehicle.load("remus100")
START = PlantState(10.0, -5.0, 0.6, 1.9, 0.0, 0.0)
CURRENT = Current(0.1, 0.2)


@pytest.fixture
def emulator() -> Emulator:
    return Emulator(REMUS, START, CURRENT)


def order(emulator: Emulator, rudder: float, thrust: float) -> None:
    command = Command(rudder, thrust)
    emulator.hear(manual_control(command, CommandLimits.of(REMUS), clockwise=True, target=1))


def live(emulator: Emulator, ms: int, command: Command | None = None) -> list[Any]:
    """Let time pass, with a command every 50 ms; return what it sent."""
    for k in range(ms // 10):
        if command is not None and k % 5 == 0:
            order(emulator, *command)
        emulator.step()
    said = [message for _, message in emulator.sent]
    emulator.sent.clear()
    return said


def test_each_kind_of_message_has_its_rate(emulator: Emulator) -> None:
    counted = Counter(message.get_type() for message in live(emulator, 10_000, Command(0.1, 4.0)))
    assert counted == {
        "ATTITUDE": 500, "LOCAL_POSITION_NED": 200, "ODOMETRY": 100, "SERVO_OUTPUT_RAW": 100, "HEARTBEAT": 10,
    }  # fmt: skip


def test_it_lies_still_until_the_first_thrust(emulator: Emulator) -> None:
    said = live(emulator, 2_000, STOP)
    positions = {(m.x, m.y, m.vx, m.vy) for m in said if m.get_type() == "LOCAL_POSITION_NED"}
    assert positions == {(10.0, -5.0, 0.0, 0.0)}
    live(emulator, 1_000, Command(0.0, 4.0))
    assert emulator.plant.motion.x > 11.0


def test_a_rudder_to_port_turns_it_counter_clockwise(emulator: Emulator) -> None:
    said = live(emulator, 3_000, Command(0.2, 4.0))
    turns = [m.yawspeed for m in said if m.get_type() == "ATTITUDE"]
    assert turns[-1] < -0.05  # ATTITUDE is FRD: negative is to port
    assert [m.servo1_raw for m in said if m.get_type() == "SERVO_OUTPUT_RAW"][-1] < 1500


def test_it_stops_by_itself_when_nobody_commands(emulator: Emulator) -> None:
    live(emulator, 2_000, Command(0.2, 5.0))
    assert emulator.plant.rudder == pytest.approx(0.2, abs=1e-3)
    said = live(emulator, 900)
    assert emulator.plant.rudder == pytest.approx(0.2, abs=1e-3)
    said = live(emulator, 200)
    assert emulator.failsafe
    assert emulator.plant.rudder < 0.19  # on its way to neutral
    assert any("failsafe" in m.text for m in said if m.get_type() == "STATUSTEXT")
    live(emulator, 2_000, Command(-0.1, 5.0))
    assert not emulator.failsafe
    assert emulator.plant.rudder == pytest.approx(-0.1, abs=1e-3)


def test_it_answers_timesync_with_its_own_time(emulator: Emulator) -> None:
    from pymavlink.dialects.v20 import common as mavlink

    live(emulator, 500)
    emulator.hear(mavlink.MAVLink_timesync_message(0, 123))
    emulator.hear(mavlink.MAVLink_timesync_message(99, 123))  # an answer to somebody else
    ((_, answer),) = emulator.sent
    assert (answer.ts1, answer.tc1) == (123, (BOOT_MS + 500) * 1_000_000)


def test_a_line_delays_shuffles_and_loses() -> None:
    line, channel = DelayLine(0.2, random.Random(5)), MessageKind(10, 50.0, 30.0)
    out: list[int] = []
    for now in range(0, 20_000, 10):
        line.put(now, channel, now)
        out += [now - sent for sent in line.take(now)]
    assert len(out) == pytest.approx(0.8 * 2000, rel=0.05)
    assert min(out) >= 20
    assert max(out) <= 80 + 10
    assert any(a < b - 10 for a, b in itertools.pairwise(out))


def test_every_period_is_a_multiple_of_the_step() -> None:
    assert all(channel.period % 10 == 0 for channel in KINDS.values())


def test_messages_of_one_line_keep_their_order() -> None:
    """Signatures have to rise on a line: what overtakes there is refused as a replay."""
    assert len(set(LINKS.values())) == len({*KINDS.values(), ANSWERS, ALTITUDE})
    way, dice = DelayLine(0.0, random.Random(3)), random.Random(4)
    arrived: dict[MessageKind, list[int]] = {channel: [] for channel in LINKS}
    for now in range(0, 20_000, 10):
        for channel in LINKS:
            due = dice.random() < 0.3 if channel is ANSWERS else now % channel.period == 0
            for number in range(int(due) * (1 + (channel is ANSWERS))):
                way.put(float(now), channel, (channel, 2 * now + number))
        for channel, number in way.take(float(now)):
            arrived[channel].append(number)
    assert all(numbers and numbers == sorted(numbers) for numbers in arrived.values())


def test_what_the_vehicle_says_at_any_time_has_a_line_of_its_own(emulator: Emulator) -> None:
    emulator.hear(mavlink.MAVLink_timesync_message(0, 5))
    assert [channel for channel, _ in emulator.sent] == [ANSWERS]
