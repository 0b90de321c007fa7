"""mavlink_driver over real DDS on one side and real UDP on the other."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from pymavlink.dialects.v20 import common as mavlink
from std_msgs.msg import Float64, String

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import nanoseconds
from auv_msgs_py.contract.frames import yaw_of_quaternion
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following import config_files
from auv_sim.cli.mission import main
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.nodes.mavlink.driver import MavlinkDriverNode
from auv_sim.nodes.mavlink.mapping import WATER_LOG, water_track
from auv_sim.nodes.mavlink.transport.link import MavlinkLink
from node_bench import Bench

FULL_RUDDER = math.radians(35.0)


class Vehicle:
    """The far end of the link: sends on request, and keeps the commands that arrive."""

    def __init__(self, port: int) -> None:
        self.link = MavlinkLink(f"udpout:127.0.0.1:{port}", 1, 1)
        self.stranger = MavlinkLink(f"udpout:127.0.0.1:{port}", 9, 1)

    def measure(self, boot_ms: int, yaw: float = 0.0, north: float = 100.0, **changes: float) -> None:
        """Heading `yaw` (default north) at 2 m/s and 0.5 m/s to starboard, turning to starboard."""
        attitude = [0.0, 0.0, yaw, 0.0, 0.0, changes.get("r", 0.1)]
        self.link.send(mavlink.MAVLink_attitude_message(boot_ms, *attitude))
        position = [north, 20.0, 0.0, 2.0, 0.5, 0.0]
        self.link.send(mavlink.MAVLink_local_position_ned_message(boot_ms, *position))

    def log(self, boot_us: int, ur: float, vr: float, component: int = WATER_LOG) -> None:
        self.link.send_bytes(self.link.pack(water_track(boot_us, ur, vr), component))

    def commands(self) -> list[Any]:
        found: list[Any] = []
        while (datagram := self.link.receive(0.0)) is not None:
            found += [m for m in self.link.messages(datagram) if m.get_type() == "MANUAL_CONTROL"]
        return found

    def stranger_heard(self) -> bool:
        return self.stranger.receive(0.0) is not None


@pytest.fixture
def vehicle_and_driver(bench: Bench) -> Iterator[tuple[Vehicle, SuiteNode]]:
    port = free_port()
    node = bench.start(
        MavlinkDriverNode,
        topics.PLANT,
        address=f"udpin:127.0.0.1:{port}",
        link_timeout=0.4,
        command_timeout=0.4,
        settling=0.0,
    )
    vehicle = Vehicle(port)
    yield vehicle, node
    vehicle.link.close()
    vehicle.stranger.close()


def stamps(bench: Bench) -> list[int]:
    return [nanoseconds(message.header.stamp) for message in bench.received["odom"]]


def test_what_the_vehicle_measures_arrives_in_the_contracts_frames(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode]
) -> None:
    vehicle, node = vehicle_and_driver
    vehicle.measure(5_000)
    vehicle.log(5_000_000, 1.8, 0.3)
    vehicle.link.send(mavlink.MAVLink_servo_output_raw_message(5_000_000, 0, 1100, *[1500] * 7))
    bench.until(lambda: bench.received["odom"] and bench.received["rudder_state"])
    (odometry,), (water,) = bench.received["odom"], bench.received["velocity_through_water"]
    assert (odometry.header.frame_id, odometry.child_frame_id) == ("map", "base_link")
    pose, twist = odometry.pose.pose, odometry.twist.twist
    assert (pose.position.x, pose.position.y) == pytest.approx((20.0, 100.0))
    q = pose.orientation
    assert yaw_of_quaternion(q.x, q.y, q.z, q.w) == pytest.approx(math.pi / 2.0)
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == pytest.approx((2.0, -0.5, -0.1))
    assert water.header.frame_id == "base_link"
    assert (water.twist.twist.linear.x, water.twist.twist.linear.y) == pytest.approx((1.8, -0.3))
    assert bench.received["rudder_state"][0].data == pytest.approx(FULL_RUDDER)
    age = node.get_clock().now().nanoseconds - nanoseconds(odometry.header.stamp)
    assert 0 <= age < 20e9


def test_commands_are_handed_on_and_a_missing_one_is_a_stop(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode]
) -> None:
    vehicle, _ = vehicle_and_driver
    vehicle.measure(5_000)
    bench.until(lambda: bench.received["odom"])
    heard: list[Any] = []

    def hears(x: int, r: int) -> bool:
        heard.extend(vehicle.commands())
        return any((command.x, command.r, command.target) == (x, r, 1) for command in heard)

    def obeyed() -> bool:
        """Command once more: a pause between the two commands is longer than they count."""
        vehicle.commands()
        heard.clear()
        bench.send(topics.RUDDER_CMD, Float64(data=FULL_RUDDER / 2.0))
        bench.spin(0.05)
        bench.send(topics.THRUST_CMD, Float64(data=6.48 / 4.0))
        bench.spin(0.05)
        return hears(250, -500) and not hears(0, 0)

    bench.until(obeyed)
    bench.until(lambda: hears(0, 0))

    def diagnosed() -> bool:
        vehicle.measure(next(boot_ms))
        return bench.diagnosed("no rudder_cmd, thrust_cmd for 0.4 s: stopped")

    boot_ms = itertools.count(5_050, 50)
    bench.until(diagnosed)


def test_a_silent_thrust_alone_is_a_stop_that_reaches_the_vehicle(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode]
) -> None:
    vehicle, _ = vehicle_and_driver
    vehicle.measure(5_000)
    bench.until(lambda: bench.received["odom"])

    def moves() -> bool:
        bench.send(topics.RUDDER_CMD, Float64(data=0.2))
        bench.send(topics.THRUST_CMD, Float64(data=6.48 / 4.0))
        return any(command.x == 250 for command in vehicle.commands())

    bench.until(moves)

    def stopped() -> bool:
        bench.send(topics.RUDDER_CMD, Float64(data=0.2))
        return any((command.x, command.r) == (0, 0) for command in vehicle.commands())

    bench.until(stopped)


def test_a_ground_station_that_talks_as_well_gets_no_commands(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode]
) -> None:
    vehicle, _ = vehicle_and_driver
    boot_ms = itertools.count(5_000, 50)
    heard: list[Any] = []

    def commanded() -> bool:
        vehicle.measure(next(boot_ms))
        vehicle.stranger.send(mavlink.MAVLink_attitude_message(99_000, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0))
        vehicle.stranger.send_bytes(b"not MAVLink at all")
        bench.spin(0.02)
        bench.send(topics.RUDDER_CMD, Float64(data=0.1))
        bench.send(topics.THRUST_CMD, Float64(data=5.0))
        heard.extend(vehicle.commands())
        return len(heard) > 10

    bench.until(commanded)
    assert not vehicle.stranger_heard()


@pytest.mark.parametrize("state", ["holding", "complete", "aborted"])
def test_no_command_moves_the_vehicle_when_the_mission_is_over(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode], state: str
) -> None:
    vehicle, _ = vehicle_and_driver
    vehicle.measure(5_000)
    bench.send(topics.MISSION_STATE, String(data=state))
    bench.spin(0.2)
    heard: list[Any] = []

    def commanded() -> bool:
        bench.send(topics.RUDDER_CMD, Float64(data=0.1))
        bench.send(topics.THRUST_CMD, Float64(data=5.0))
        heard.extend(vehicle.commands())
        return len(heard) > 3

    bench.until(commanded)
    assert {(command.x, command.r) for command in heard} == {(0, 0)}
    bench.send(topics.MISSION_STATE, String(data="running"))
    bench.until(lambda: commanded() and heard[-1].x > 0)


@pytest.mark.parametrize(("rudder", "thrust"), [(math.nan, 1.0), (0.1, math.inf), (0.7, 1.0), (0.1, -1.0)])
def test_a_command_that_cannot_be_never_reaches_the_vehicle(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode], rudder: float, thrust: float
) -> None:
    vehicle, node = vehicle_and_driver
    vehicle.measure(5_000)
    bench.until(lambda: bench.received["odom"])
    bench.send(topics.RUDDER_CMD, Float64(data=rudder))
    bench.spin(0.05)
    bench.send(topics.THRUST_CMD, Float64(data=thrust))
    bench.until(lambda: node.health.refused)
    heard: list[Any] = []
    bench.until(lambda: heard.extend(vehicle.commands()) or heard)  # a stop, as one of the two is missing
    assert {(command.x, command.r) for command in heard} == {(0, 0)}


def test_silence_is_an_error_until_the_vehicle_is_back(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode]
) -> None:
    vehicle, node = vehicle_and_driver
    vehicle.measure(5_000)
    bench.until(lambda: bench.diagnosed("no word from the vehicle for 0.4 s"))
    bench.received["/diagnostics"].clear()

    def back() -> bool:
        vehicle.measure(round(node.get_clock().now().nanoseconds * 1e-6) % 2**31)
        return any(
            status.level == b"\0" for array in bench.received["/diagnostics"] for status in array.status
        )

    bench.until(back)


def test_stamps_rise_over_a_restart_and_old_messages_are_left_out(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode]
) -> None:
    vehicle, node = vehicle_and_driver
    for boot_ms in (60_000, 60_050, 60_020, 60_100):
        vehicle.measure(boot_ms, north=float(boot_ms))
        bench.spin(0.03)
    bench.until(lambda: len(bench.received["odom"]) == 3)
    for boot_ms in (300, 350):
        vehicle.measure(boot_ms)
        bench.spin(0.05)
    bench.until(lambda: len(bench.received["odom"]) == 5)
    assert stamps(bench) == sorted(set(stamps(bench)))
    assert node.report()["vehicle restarts"] == 1
    assert node.report()["dropped ATTITUDE out of order"] == 1


def test_strangers_and_impossible_values_are_left_out(
    bench: Bench, vehicle_and_driver: tuple[Vehicle, SuiteNode]
) -> None:
    vehicle, node = vehicle_and_driver
    vehicle.stranger.send(mavlink.MAVLink_attitude_message(99_000, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0))
    vehicle.measure(5_000, yaw=math.nan)
    vehicle.log(5_000_000, math.nan, 0.0)
    vehicle.measure(5_050)
    bench.until(lambda: bench.received["odom"] and node.health.refused["ODOMETRY"])
    assert len(bench.received["odom"]) == 1
    assert bench.received["velocity_through_water"] == []


def test_a_mission_is_flown_through_the_driver_with_signatures(
    short_mission: Path, tmp_path: Path, domain: int
) -> None:
    run, key, params = tmp_path / "run", tmp_path / "key", tmp_path / "signed.yaml"
    key.write_text(bytes(range(32)).hex())
    key.chmod(0o600)
    signed = {"/**/mavlink_driver": {"ros__parameters": {"signing_key": str(key)}}}
    params.write_text(config_files.find("params", "robust").read_text() + yaml.safe_dump(signed))
    asked = ["--mission", str(short_mission), "--vehicle-driver", "mavlink", "--speed", "20", "--quiet"]
    asked.append("--composed")
    assert main([*asked, "--params", str(params), "--out", str(run), "--domain", str(domain)]) == 0
    summary = json.loads((run / "summary.json").read_text())
    assert summary["outcome"] == "complete"
    assert summary["largest_distance"] < 0.5
    logs = {path.name: path.read_text() for path in (run / "log").glob("*.log")}
    assert {"composed.log", "vehicle_emulator.log"} <= set(logs)
    assert not any("Invalid signature" in text for text in logs.values())


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--vehicle-address", "udpin:127.0.0.1:14550"], "--vehicle-address: found no --vehicle-driver"),
        (["--vehicle-driver", "mavlink", "--no-sim"], "--vehicle-driver: found together with --no-sim"),
        (
            ["--vehicle-driver", "mavlink", "--vehicle-address", "serial:1"],
            "--vehicle-address: found 'serial:1'",
        ),
        (
            ["--vehicle-driver", "mavlink", "--vehicle-address", "udp:127.0.0.1:1", "--speed", "2"],
            "--speed: found together with --vehicle-address",
        ),
    ],
)
def test_options_that_do_not_fit_are_refused(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 2
    assert capsys.readouterr().err.startswith(complaint)
