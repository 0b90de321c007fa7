"""mavlink_driver for a vehicle that dives: signs by up and down, over real DDS and real UDP."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink
from std_msgs.msg import Float64, String

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.contract.spatial_conversions import spatial_navigation_from
from auv_msgs_py.node.runtime import SuiteNode
from auv_sim.bags.reading.load import load
from auv_sim.cli.mission import main
from auv_sim.flight.run_record import SpatialRun
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.nodes.mavlink.driver import MavlinkDriverNode
from auv_sim.nodes.mavlink.mapping import WATER_LOG, water_track
from auv_sim.nodes.mavlink.soundings import distance_sensor
from auv_sim.nodes.mavlink.transport.link import MavlinkLink
from node_bench import Bench

DIVE = Path(__file__).parents[3] / "data" / "short_dive.yaml"
HALF_PLANES = math.radians(10.0)


@pytest.fixture
def link_and_driver(bench: Bench) -> Iterator[tuple[MavlinkLink, SuiteNode]]:
    port = free_port()
    node = bench.start(
        MavlinkDriverNode,
        topics.PLANT,
        address=f"udpin:127.0.0.1:{port}",
        vehicle="remus100_6dof",
        command_timeout=0.4,
        settling=0.0,
    )
    link = MavlinkLink(f"udpout:127.0.0.1:{port}", 1, 1)
    yield link, node
    link.close()


def measure(link: MavlinkLink, boot_ms: int) -> None:
    """Heading north at 2 m/s, bow down by 0.2 rad and more, sinking at 0.3 m/s through 12 m, level rolled."""
    link.send(mavlink.MAVLink_attitude_message(boot_ms, 0.1, -0.2, 0.0, 0.01, -0.02, 0.03))
    link.send(mavlink.MAVLink_local_position_ned_message(boot_ms, 100.0, 20.0, 12.0, 2.0, 0.0, 0.3))


def test_depth_pitch_planes_and_altitude_arrive_in_the_contracts_signs(
    bench: Bench, link_and_driver: tuple[MavlinkLink, SuiteNode]
) -> None:
    link, _ = link_and_driver
    measure(link, 5_000)
    link.send_bytes(link.pack(water_track(5_000_000, 1.9, 0.1, -0.05), WATER_LOG))
    link.send(mavlink.MAVLink_servo_output_raw_message(5_000_000, 0, 1500, 1300, *[1500] * 6))
    link.send(distance_sensor(5_000, 8.25))
    names = ("odom", "velocity_through_water", "sternplane_state", "altitude")
    bench.until(lambda: all(bench.received[name] for name in names))
    odometry = bench.received["odom"][0]
    twist = odometry.twist.twist
    assert odometry.pose.pose.position.z == pytest.approx(-12.0)
    # FLU: a pitch rate is positive bow down, a yaw rate to port, a heave velocity up.
    assert (twist.angular.x, twist.angular.y, twist.angular.z) == pytest.approx((0.01, 0.02, -0.03))
    assert twist.linear.x > 2.0
    frames = FrameTable(FrameIds())
    navigation = spatial_navigation_from(odometry, frames, "odom")
    assert navigation == pytest.approx((100.0, 20.0, 12.0, 0.1, -0.2, 0.0, -0.02, 0.03), abs=1e-6)
    water = bench.received["velocity_through_water"][0].twist.twist.linear
    assert (water.x, water.y, water.z) == pytest.approx((1.9, -0.1, 0.05))
    assert bench.received["sternplane_state"][0].data == pytest.approx(HALF_PLANES)  # bow down
    assert bench.received["altitude"][0].range == pytest.approx(8.25)
    assert bench.received["altitude"][0].max_range == pytest.approx(50.0)


def test_covariances_of_odometry_are_passed_on_in_the_contracts_frames(
    bench: Bench, link_and_driver: tuple[MavlinkLink, SuiteNode]
) -> None:
    link, _ = link_and_driver
    pose, twist = [0.0] * 21, [0.0] * 21
    pose[0], pose[1], pose[6], pose[20] = 4.0, 0.5, 9.0, 0.01  # north, north with east, east, yaw
    pose[5] = 0.1  # north with yaw
    twist[0], twist[1], twist[6] = 0.25, 0.02, 0.04  # ahead, ahead with starboard, starboard
    frames = mavlink.MAV_FRAME_LOCAL_NED, mavlink.MAV_FRAME_BODY_FRD
    numbers: list[Any] = [0.0, 0.0, 0.0, [1.0, 0.0, 0.0, 0.0], *[0.0] * 6]
    measure(link, 5_000)
    bench.until(lambda: bench.received["odom"])
    (before,) = bench.received["odom"]
    boot_ms = itertools.count(5_050, 50)

    def has_covariance() -> bool:
        """Send both once more: the covariances count for 1 s, and a pause may be longer."""
        now = next(boot_ms)
        link.send(mavlink.MAVLink_odometry_message(1000 * now, *frames, *numbers, pose, twist))
        measure(link, now)
        bench.spin(0.05)
        return bool(bench.received["odom"][-1].pose.covariance.any())

    bench.until(has_covariance)
    after = bench.received["odom"][-1]
    assert not before.pose.covariance.any() and not before.twist.covariance.any()
    found, of_twist = after.pose.covariance.reshape(6, 6), after.twist.covariance.reshape(6, 6)
    # ENU: east first; yaw counts the other way.
    assert (found[0, 0], found[1, 1], found[5, 5]) == pytest.approx((9.0, 4.0, 0.01))
    assert (found[0, 1], found[1, 5], found[5, 1]) == pytest.approx((0.5, -0.1, -0.1))
    # FLU: to port.
    assert (of_twist[0, 0], of_twist[1, 1], of_twist[0, 1]) == pytest.approx((0.25, 0.04, -0.02))
    numbers[4:6] = [1.8, 0.3]
    message = mavlink.MAVLink_odometry_message(1000 * next(boot_ms), *frames, *numbers, pose, twist)
    link.send_bytes(link.pack(message, WATER_LOG))
    bench.until(lambda: bench.received["velocity_through_water"])
    water = bench.received["velocity_through_water"][0]
    assert water.twist.covariance[0] == pytest.approx(0.25)


def test_planes_are_commanded_bow_down_and_silence_stops_them(
    bench: Bench, link_and_driver: tuple[MavlinkLink, SuiteNode]
) -> None:
    link, node = link_and_driver
    measure(link, 5_000)
    bench.until(lambda: bench.received["odom"])
    heard: list[Any] = []

    def commanded(r: int, s: int, x: int) -> bool:
        while (datagram := link.receive(0.0)) is not None:
            heard.extend(m for m in link.messages(datagram) if m.get_type() == "MANUAL_CONTROL")
        return any((m.r, m.s, m.x, m.enabled_extensions) == (r, s, x, 1) for m in heard)

    def order(planes: float) -> None:
        """Command; forget the answers to earlier commands."""
        commanded(0, 0, 0)
        heard.clear()
        bench.send(topics.RUDDER_CMD, Float64(data=0.0))
        bench.send(topics.STERNPLANE_CMD, Float64(data=planes))
        bench.spin(0.05)
        bench.send(topics.THRUST_CMD, Float64(data=6.48 / 4.0))
        bench.spin(0.05)

    def obeyed(planes: float, s: int) -> bool:
        order(planes)  # once more: a pause in between is longer than commands count
        return commanded(0, s, 250)

    bench.until(lambda: obeyed(HALF_PLANES, 500))
    bench.until(lambda: commanded(0, 0, 0))  # silence
    bench.until(lambda: obeyed(-HALF_PLANES, -500))
    order(0.4)  # beyond the stops
    bench.until(lambda: node.health.refused)
    bench.send(topics.MISSION_STATE, String(data="holding"))

    def stopped() -> bool:
        order(HALF_PLANES)
        return commanded(0, 0, 0) and {(m.s, m.x) for m in heard} == {(0, 0)}

    bench.until(stopped)


def test_a_dive_is_flown_through_the_driver(tmp_path: Path, domain: int) -> None:
    run = tmp_path / "run"
    asked = [
        "--mission",
        str(DIVE),
        "--vehicle",
        "remus100_6dof",
        "--vehicle-driver",
        "mavlink",
        "--composed",
    ]
    asked += ["--current", "0.1", "0.2", "--upwelling", "-0.05", "--speed", "20", "--quiet"]
    assert main([*asked, "--out", str(run), "--domain", str(domain)]) == 0
    flown = load(run / "bag")
    assert isinstance(flown, SpatialRun)
    under_way = (flown.s > 0.0) & (flown.s < 5.0)
    assert flown.z[under_way].max() > 4.9
    assert abs(flown.ze[under_way]).max() < 0.2
    assert abs(flown.ye[under_way]).max() < 0.6
    settled = flown.Vz_est[under_way][-50:]
    assert settled == pytest.approx(0.05, abs=0.02)
    # The feedback follows the commands, in their sign, after the delays of the line.
    trim = flown.sternplanes[under_way].mean(), flown.sternplanes_cmd[under_way].mean()
    assert trim[0] == pytest.approx(trim[1], abs=2e-3)
    assert trim[1] < -0.02  # bow up against the buoyancy: the trim of a hull that is lighter than water
