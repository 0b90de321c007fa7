"""The driver in docs/driver.md is a driver: it flies a vehicle, and check_vehicle finds nothing wrong."""

from __future__ import annotations

import importlib
import json
import math
import re
import socket
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.contract.spatial_conversions import spatial_navigation_from, spatial_water_from
from auv_msgs_py.values.types import STOP, Command, Current
from auv_path_following import vehicle
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle
from node_bench import Bench

PAGE = Path(__file__).resolve().parents[1] / "docs" / "driver.md"
KNOT = 1852.0 / 3600.0
CURRENT = Current(0.1, -0.15)
#: A loaded machine makes gaps and delays of its own; they are not the listing's mistakes. A datagram that
#: waits for more than a period is stamped after the next one.
TIMING = {"GAPS", "LATE", "JITTERY", "OUT_OF_ORDER", "STAMP_JUMPS"}
MACHINE = TIMING | {"DEAD_TIME", "RUDDER_SLOW", "TOO_SLOW"}
#: What the check must have measured and found right.
SHOWN = {"odom: yaw against course", "odom: velocity against position", "rudder: sign and scale"}


def listings() -> tuple[str, str]:
    """The two Python listings of the page: the driver, and what stern planes add."""
    plain, diving = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    return plain, diving


class JsonVehicle(threading.Thread):
    """The vehicle that the listing is for, in real time: what it sends is written out here once more."""

    def __init__(self, port: int) -> None:
        super().__init__(daemon=True)
        self.port = port
        self.plant = SimulatedVehicle(
            vehicle.load("remus100"), PlantState(5.0, -7.0, 0.5, 0.0, 0.0, 0.0), current=CURRENT
        )
        self.over = False

    def run(self) -> None:
        link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        link.connect(("127.0.0.1", self.port))
        command, heard_at, due = STOP, 0.0, time.monotonic()
        while not self.over:
            link.settimeout(max(due - time.monotonic(), 1e-3))
            try:
                order = json.loads(link.recv(65535))
                rudder = -math.radians(order["rudder_to_starboard_deg"])
                command, heard_at = Command(rudder, order["thrust_n"]), time.monotonic()
            except OSError:
                pass  # no message has come, or no reader is there yet
            if time.monotonic() < due:
                continue
            due += 0.05
            moving = time.monotonic() - heard_at < 1.0
            self.plant.advance(command if moving else STOP, 0.05)
            s = self.plant.motion
            u, v = self.plant.ground_velocity
            measured = {
                "age_s": max(time.monotonic() - due, 0.0), "north_m": s.x, "east_m": s.y,
                "heading_deg": math.degrees(s.psi) % 360.0, "turn_deg_s": math.degrees(s.r),
                "ahead_kn": u / KNOT, "starboard_kn": v / KNOT,
                "water_ahead_kn": s.ur / KNOT, "water_starboard_kn": s.vr / KNOT,
            }  # fmt: skip
            try:
                link.send(json.dumps(measured).encode())
            except OSError:
                continue
        link.close()


@pytest.fixture
def json_vehicle() -> Iterator[JsonVehicle]:
    thread = JsonVehicle(free_port())
    thread.start()
    yield thread
    thread.over = True
    thread.join(5.0)


def test_the_listing_is_a_driver(
    json_vehicle: JsonVehicle,
    spawn: Callable[..., Any],
    tmp_path: Path,
    command_line: Callable[..., list[str]],
) -> None:
    file = tmp_path / "my_driver.py"
    file.write_text(listings()[0], encoding="utf-8")
    python = command_line("x")[0]
    driver = spawn([python, str(file), "--ros-args", "-r", "__ns:=/auv", "-p", f"port:={json_vehicle.port}"])
    asked = ["--wiggle", "--yes-the-vehicle-may-move", "--wait", "180", "--json"]
    # A process that is paused meanwhile looks like a mistake; a mistake is there each time.
    for _ in range(5):
        checker = spawn(command_line("auv_sim.cli.vehicles.check_vehicle", *asked))
        out, err = checker.communicate(timeout=400)
        assert out, err
        items = {item["item"]: item for item in json.loads(out)["items"]}
        found = {item["mistake"] for item in items.values() if item["verdict"] == "fail"} - MACHINE
        shown = {name for name in SHOWN if items.get(name, {}).get("verdict") == "pass"}
        if not found and shown == SHOWN:
            break
    assert (found, shown) == (set(), SHOWN)
    driver.terminate()
    assert driver.wait(timeout=180) == 0
    assert "Traceback" not in driver.stderr.read()


def test_the_listings_fit_on_a_page() -> None:
    plain, diving = listings()
    assert len(plain.splitlines()) < 100
    assert len(diving.splitlines()) < 50


@pytest.fixture
def diving_driver(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[tuple[Any, list[Any]]]:
    """The driver for a vehicle with stern planes in this process, and the messages that it publishes."""
    for name, code in zip(("my_driver", "my_diving_driver"), listings(), strict=True):
        (tmp_path / f"{name}.py").write_text(code, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(socket.socket, "bind", lambda link, _: None)
    driver = importlib.import_module("my_diving_driver").MyDivingDriver()
    sent: list[Any] = []
    for publisher in ("odom", "water"):
        monkeypatch.setattr(driver, publisher, SimpleNamespace(publish=sent.append))
    yield driver, sent
    driver.socket.close()
    driver.destroy_node()
    for name in ("my_driver", "my_diving_driver"):
        del sys.modules[name]


def test_the_driver_with_stern_planes_says_where_up_is(diving_driver: tuple[Any, list[Any]]) -> None:
    driver, sent = diving_driver
    driver.publish({
        "age_s": 0.0, "north_m": 100.0, "east_m": 20.0, "depth_m": 12.0,
        "heading_deg": 200.0, "bow_up_deg": -15.0, "roll_deg": 8.0,
        "turn_deg_s": 3.0, "bow_up_deg_s": -2.0, "roll_deg_s": 1.0,
        "ahead_kn": 3.0, "starboard_kn": 0.2, "down_kn": 0.1,
        "water_ahead_kn": 2.8, "water_starboard_kn": 0.1, "water_down_kn": math.nan,
    })  # fmt: skip
    water, odometry = sent
    frames = FrameTable(FrameIds())
    angles = [math.radians(angle) for angle in (8.0, -15.0, 200.0 - 360.0, -2.0, 3.0)]
    navigation = spatial_navigation_from(odometry, frames, "odom")
    assert navigation == pytest.approx((100.0, 20.0, 12.0, *angles))
    assert spatial_water_from(water, frames, "water") == pytest.approx(
        (2.8 * KNOT, 0.1 * KNOT, 0.0), rel=1e-5
    )
    twist = odometry.twist.twist
    assert twist.linear.z == pytest.approx(-0.1 * KNOT, rel=1e-5)
    assert twist.angular.x == pytest.approx(math.radians(1.0))


def test_the_driver_with_stern_planes_takes_them_and_stops_them(
    diving_driver: tuple[Any, list[Any]], monkeypatch: pytest.MonkeyPatch
) -> None:
    driver, _ = diving_driver
    orders: list[dict[str, float]] = []
    monkeypatch.setattr(driver, "vehicle", ("127.0.0.1", 1))
    link = SimpleNamespace(sendto=lambda data, _: orders.append(json.loads(data)), close=driver.socket.close)
    monkeypatch.setattr(driver, "socket", link)
    commands = {"rudder": math.radians(5.0), "sternplane": math.radians(10.0), "thrust": 4.0}
    for name, value in list(commands.items())[:2]:
        driver.on_command(name, value)
    driver.send()
    driver.on_command("thrust", commands["thrust"])
    driver.send()
    driver.send(stop=True)
    neutral = {"rudder_to_starboard_deg": 0.0, "planes_bow_up_deg": 0.0, "thrust_n": 0.0}
    under_way = {"rudder_to_starboard_deg": -5.0, "planes_bow_up_deg": -10.0, "thrust_n": 4.0}
    for found, expected in zip(orders, (neutral, under_way, neutral), strict=True):
        assert found == pytest.approx(expected)
