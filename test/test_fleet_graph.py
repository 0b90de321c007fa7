"""Two vehicles in one graph: each flies as it does alone."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from auv_sim.bags import line_owner
from auv_sim.bags.content.recorded_mission import mission_in
from auv_sim.bags.content.vehicle_parts import read_vehicles
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.load import load
from auv_sim.bags.reading.recording import Bag
from auv_sim.cli.bag import main as bag_command
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
    _check_lines(run)


def test_one_bag_has_all_vehicles_and_the_verbs_take_them_apart(
    dive: Path, tmp_path: Path, domain: int, capsys: pytest.CaptureFixture[str]
) -> None:
    file, run = tmp_path / "pair.yaml", tmp_path / "run"
    file.write_text(f"{FLEET}bags: one\n", encoding="utf-8")
    words = ["--fleet", str(file), "--composed", "--quiet", "--domain", str(domain)]
    assert main([*words, "--out", str(run)]) == 0
    assert sorted(path.name for path in run.glob("**/*.mcap")) == ["bag_0.mcap"]

    alone, first = load(dive / "bag"), load(run / "bag", "/auv1")
    for field in dataclasses.fields(SpatialRun):
        np.testing.assert_array_equal(getattr(alone, field.name), getattr(first, field.name), field.name)

    assert bag_command(["rerun", str(run)]) == 0  # both vehicles', each with its own configuration
    assert capsys.readouterr().out.count("bit for bit") == 2
    assert bag_command(["export", str(run)]) == 2
    assert "2 vehicles, expected --namespace with one of auv1, auv2" in capsys.readouterr().err

    assert bag_command(["report", str(run)]) == 0
    page = (run / "report" / "report.html").read_text(encoding="utf-8")
    assert json.loads(page.split('type="application/json">')[1].split("</script>")[0])["closest"] == (
        "Closest: auv1 and auv2, 3.00 m at 0.0 s."
    )
    assert (run / "report" / "auv1" / "dive.png").exists()

    bags = read_vehicles(run)
    assert list(bags) == ["auv1", "auv2"]
    for label, bag in bags.items():
        assert mission_in(bag).summary.completed  # type: ignore[union-attr]
        assert owners(bag, "/diagnostics") == {f"/{label}", "/"}
        assert f"/{label}" in owners(bag, "/rosout")
    assert "/auv2/odom" not in bags["auv1"].topics
    assert bags["auv2"].texts["mission.yaml"] == (run / "auv2" / "config" / "mission.yaml").read_text()
    whole = read_bag(run)
    assert owners(whole, "/diagnostics") == {"/auv1", "/auv2", "/"}
    clock = whole.topics["/clock"]
    assert len(set(clock.sequence)) == clock.count  # one of the two recorders recorded it


def owners(bag: Bag, topic: str) -> set[str]:
    """Return the namespaces of the nodes whose lines a topic has."""
    found = [line_owner.node_of(topic, data or b"") for data in bag.topics[topic].messages]
    return {name.rpartition("/")[0] or "/" for name in found}


def _check_lines(run: Path) -> None:
    """Check that each vehicle's bag has its own lines, and those of nodes that are of no vehicle."""
    for label, bag in read_vehicles(run).items():
        for topic in line_owner.SHARED:
            assert owners(bag, topic) - {"/"} == {f"/{label}"}, topic


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
