"""The driver in docs/driver.md is a driver: it flies a vehicle, and check_vehicle finds nothing wrong."""

from __future__ import annotations

import json
import math
import re
import socket
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from auv_msgs_py.values.types import STOP, Command, Current
from auv_path_following import vehicle
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

PAGE = Path(__file__).resolve().parents[1] / "docs" / "driver.md"
KNOT = 1852.0 / 3600.0
CURRENT = Current(0.1, -0.15)


def listing() -> str:
    """The one Python listing of the page."""
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    return str(code)


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
    spawn: Callable[..., object],
    tmp_path: Path,
    command_line: Callable[..., list[str]],
) -> None:
    file = tmp_path / "my_driver.py"
    file.write_text(listing(), encoding="utf-8")
    python = command_line("x")[0]
    spawn([python, str(file), "--ros-args", "-r", "__ns:=/auv", "-p", f"port:={json_vehicle.port}"])
    asked = ["--wiggle", "--yes-the-vehicle-may-move", "--wait", "90", "--json"]
    checker = spawn(command_line("auv_sim.cli.check_vehicle", *asked))
    out, err = checker.communicate(timeout=240)  # type: ignore[attr-defined]
    assert out, err
    items = {item["item"]: item for item in json.loads(out)["items"]}
    # A loaded machine makes gaps and delays of its own; they are not the listing's mistakes.
    machine = {"GAPS", "LATE", "JITTERY", "DEAD_TIME", "STAMP_JUMPS", "RUDDER_SLOW", "TOO_SLOW"}
    found = {item["mistake"] for item in items.values() if item["verdict"] == "fail"} - machine
    assert found == set()
    for item in ("odom: yaw against course", "odom: velocity against position", "rudder: sign and scale"):
        assert items[item]["verdict"] == "pass", items[item]


def test_the_listing_fits_on_a_page() -> None:
    assert len(listing().splitlines()) < 100
