"""Two vehicles in one graph: each flies as it does alone."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
from rosbags.highlevel import AnyReader

from auv_sim.bags.reading.load import load
from auv_sim.cli.mission import main
from auv_sim.flight import closed_loop
from auv_sim.flight.run_record import SpatialRun
from auv_sim.launch.fleet import fleet_plan
from auv_sim.launch.options import Options

DATA = Path(__file__).parent / "data"
#: The first one flies as the fixture `dive` does.
FLEET = f"""
version: 1
name: pair
current: [0.1, 0.2]
upwelling: -0.05
vehicles:
  - {{namespace: /auv1, mission: {DATA / "short_dive.yaml"}, vehicle: remus100_6dof}}
  - {{namespace: /auv2, mission: {DATA / "short.yaml"}}}
"""


def test_each_vehicle_of_a_fleet_flies_as_it_does_alone(dive: Path, tmp_path: Path, domain: int) -> None:
    file, run = tmp_path / "pair.yaml", tmp_path / "run"
    file.write_text(FLEET, encoding="utf-8")
    words = ["--fleet", str(file), "--composed", "--quiet", "--domain", str(domain)]
    assert main([*words, "--out", str(run)]) == 0

    alone, first = load(dive / "bag"), load(run / "auv1" / "bag")
    assert isinstance(first, SpatialRun)
    for field in dataclasses.fields(SpatialRun):
        np.testing.assert_array_equal(getattr(alone, field.name), getattr(first, field.name), field.name)

    plan = fleet_plan.make(str(file), Options(), tmp_path / "planned")
    second, loop = load(run / "auv2" / "bag"), closed_loop.fly(plan.members["auv2"].scenario())
    assert second.steps == loop.steps
    for name in ("x", "y", "psi", "rudder_cmd", "s", "Vx_est"):
        assert np.abs(getattr(second, name) - getattr(loop, name)).max() < 1e-9, name

    summary = json.loads((run / "summary.json").read_text())
    assert summary["outcomes"] == {"auv1": "complete", "auv2": "complete"}
    (closest,) = summary["closest"]
    together = min(first.steps, second.steps)
    apart = np.sqrt(
        (first.x[:together] - second.x[:together]) ** 2
        + (first.y[:together] - second.y[:together]) ** 2
        + first.z[:together] ** 2
    )
    assert abs(closest["distance_m"] - apart.min()) < 1e-3
    assert (run / "fleet.png").stat().st_size > 10_000
    _check_clock(run, first)


def _check_clock(run: Path, first: SpatialRun) -> None:
    """Check that each vehicle keeps within a second of the one /clock, which never goes back."""
    with AnyReader([run / "auv1" / "bag"]) as reader:
        kept = [c for c in reader.connections if c.topic in ("/clock", "/auv1/odom")]
        stamps: dict[str, list[float]] = {"/clock": [], "/auv1/odom": []}
        ahead = []
        for connection, _, data in reader.messages(connections=kept):
            message = reader.deserialize(data, connection.msgtype)
            time = message.clock if connection.topic == "/clock" else message.header.stamp
            stamps[connection.topic].append(time.sec + time.nanosec * 1e-9)
            if connection.topic == "/auv1/odom" and stamps["/clock"]:
                ahead.append(stamps["/auv1/odom"][-1] - stamps["/clock"][-1])
    assert stamps["/clock"] == sorted(stamps["/clock"])
    assert stamps["/clock"][-1] > first.t[-1] - 1.0
    assert max(ahead) < 2.0  # the recorder receives /clock and the odometry in either order
