"""The emulated vehicle that dives: its planes, depth, attitude and echo sounder."""

from __future__ import annotations

import math
from typing import Any

import pytest

from auv_msgs_py.values.attitude import quaternion_of
from auv_msgs_py.values.types import SpatialCommand, SpatialCurrent
from auv_path_following import vehicle
from auv_sim.command_line import EXIT_BAD_INPUT
from auv_sim.nodes.mavlink.emulated_diver import emulator_of
from auv_sim.nodes.mavlink.emulated_vehicle import Emulator
from auv_sim.nodes.mavlink.emulator import main
from auv_sim.nodes.mavlink.mapping import CommandLimits, manual_control
from auv_sim.vehicle.hulls.rigid_body import to_body

REMUS = vehicle.load("remus100_6dof")
LIMITS = CommandLimits.of(REMUS)
CURRENT = SpatialCurrent(0.1, 0.2, -0.05)


@pytest.fixture
def emulator() -> Emulator:
    return emulator_of(REMUS, (10.0, -5.0, 8.0, 0.0, 0.6), 1.9, CURRENT, bottom=20.0)


def live(emulator: Emulator, ms: int, planes: float | None = None) -> dict[str, Any]:
    """Let time pass, with a command every 50 ms; return the last message of each kind."""
    for k in range(ms // 10):
        if planes is not None and k % 5 == 0:
            command = SpatialCommand(0.0, planes, 6.0)
            emulator.hear(manual_control(command, LIMITS, clockwise=True, target=1))
        emulator.step()
    last = {message.get_type(): message for _, message in emulator.sent}
    emulator.sent.clear()
    return last


def test_planes_down_put_the_bow_down_and_it_dives(emulator: Emulator) -> None:
    said = live(emulator, 3_000, planes=0.2)
    attitude, position = said["ATTITUDE"], said["LOCAL_POSITION_NED"]
    assert attitude.pitch < -0.1  # ATTITUDE is FRD: negative is bow down
    assert position.z > 8.3
    assert position.vz > 0.1
    assert said["SERVO_OUTPUT_RAW"].servo2_raw == 1500 - round(400.0 * 0.2 / math.radians(20.0))
    assert said["SERVO_OUTPUT_RAW"].servo1_raw == 1500


def test_planes_up_bring_it_up(emulator: Emulator) -> None:
    said = live(emulator, 3_000, planes=-0.2)
    assert said["ATTITUDE"].pitch > 0.1
    assert said["LOCAL_POSITION_NED"].z < 7.9
    assert said["SERVO_OUTPUT_RAW"].servo2_raw > 1700


def test_its_messages_describe_one_motion(emulator: Emulator) -> None:
    said = live(emulator, 3_070, planes=0.15)
    a, p, water = said["ATTITUDE"], said["LOCAL_POSITION_NED"], said["ODOMETRY"]
    attitude = quaternion_of(a.roll, a.pitch, a.yaw)
    over_ground = p.vx - CURRENT.Vx, p.vy - CURRENT.Vy, p.vz - CURRENT.Vz
    through = to_body(*attitude, *over_ground)
    assert through == pytest.approx((water.vx, water.vy, water.vz), abs=0.02)
    sounding = said["DISTANCE_SENSOR"].current_distance * 0.01
    assert sounding * math.cos(a.pitch) * math.cos(a.roll) == pytest.approx(20.0 - p.z, abs=0.05)


def test_it_floats_up_with_its_planes_neutral_when_nothing_commands(emulator: Emulator) -> None:
    live(emulator, 3_000, planes=0.2)
    said = live(emulator, 3_000)
    assert emulator.failsafe
    assert said["SERVO_OUTPUT_RAW"].servo2_raw == 1500


def test_it_lies_still_at_its_depth_until_the_first_thrust() -> None:
    emulator = emulator_of(REMUS, (0.0, 0.0, 3.0, 0.1, 0.0), 1.9, CURRENT)
    said = live(emulator, 1_000)
    p = said["LOCAL_POSITION_NED"]
    assert (p.z, p.vx, p.vy, p.vz) == (3.0, 0.0, 0.0, 0.0)
    assert said["ATTITUDE"].pitch == pytest.approx(0.1)
    assert "DISTANCE_SENSOR" not in said


def test_a_planar_vehicle_has_no_depth(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--depth", "3"]) == EXIT_BAD_INPUT
    assert capsys.readouterr().err.startswith("--depth: found vehicle REMUS 100, expected")
