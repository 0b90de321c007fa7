"""The graph in three dimensions against `closed_loop`, against itself, and in other frames."""

from __future__ import annotations

import base64
import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from auv_msgs_py.contract import topics
from auv_path_following import config_files
from auv_sim.bags.content.recorded_mission import mission_in
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.load import load, load_messages
from auv_sim.bags.showing.report_data import page_data
from auv_sim.cli.mission import main
from auv_sim.flight import closed_loop
from auv_sim.flight.run_record import SpatialRun
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options

DATA = Path(__file__).parent / "data"
DIVE = {"mission": str(DATA / "short_dive.yaml"), "vehicle": "remus100_6dof"}
#: Signals that a recording and a closed loop have alike.
SIGNALS = (
    "x", "y", "z", "phi", "theta", "psi", "q", "r", "ur", "vr", "wr", "rudder", "rudder_cmd", "sternplanes",
    "sternplanes_cmd", "theta_d", "q_d", "depth_d", "xe", "ye", "ze", "s", "Vx_est", "Vz_est", "Vz_true",
)  # fmt: skip
NED = """
/**/remus_plant:
  ros__parameters: {world_frame: odom_ned, body_frame: base_link_fsd}
"""


def flown(run: Path, *asked: str) -> SpatialRun:
    """Fly over the graph; return the recording."""
    words = [f"--{name}={value}" for name, value in DIVE.items() if f"--{name}" not in asked]
    assert main([*words, *asked, "--quiet", "--out", str(run)]) == 0
    found = load(run / "bag")
    assert isinstance(found, SpatialRun)
    return found


def difference(one: SpatialRun, other: SpatialRun, name: str) -> float:
    return float(np.abs(getattr(one, name) - getattr(other, name)).max())


@pytest.fixture(scope="module")
def separate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The dive of the fixture `dive` over separate processes."""
    run = tmp_path_factory.mktemp("separate") / "run"
    flown(run, "--current", "0.1", "0.2", "--upwelling", "-0.05")
    return run


def test_a_dive_over_the_graph_equals_closed_loop(separate: Path, tmp_path: Path) -> None:
    options = Options(**DIVE, current=(0.1, 0.2), upwelling=-0.05)
    reference, run = closed_loop.fly(mission_plan.make(options, tmp_path).scenario()), load(separate / "bag")
    assert isinstance(reference, SpatialRun)
    assert isinstance(run, SpatialRun)
    assert run.steps == reference.steps
    for name in SIGNALS:
        assert difference(run, reference, name) < 1e-9, name
    assert run.z.max() > 4.9
    assert run.Vz_est[-1] == pytest.approx(0.05, abs=0.005)


def test_every_topic_of_a_step_is_recorded_once_a_step(separate: Path) -> None:
    steps = json.loads((separate / "summary.json").read_text())["steps"]
    wanted = {f"/auv/{topic.name}" for topic in (*topics.PER_STEP, *topics.SPATIAL_PER_STEP)}
    with AnyReader([separate / "bag"]) as reader:
        counts = {c.topic: c.msgcount for c in reader.connections if c.topic in wanted}
    assert counts == dict.fromkeys(wanted, steps)


def test_in_one_process_and_in_ned_the_track_is_the_same(
    dive: Path, separate: Path, tmp_path: Path, domain: int
) -> None:
    params = tmp_path / "ned.yaml"
    robust = config_files.find("params", "robust").read_text(encoding="utf-8")
    params.write_text(robust + NED, encoding="utf-8")
    asked = ["--current", "0.1", "0.2", "--upwelling", "-0.05", "--composed", "--domain", str(domain)]
    ned = flown(tmp_path / "ned", *asked, "--params", str(params))
    one, five = load(dive / "bag"), load(separate / "bag")
    assert isinstance(five, SpatialRun)
    for field in dataclasses.fields(SpatialRun):
        name = field.name
        np.testing.assert_array_equal(getattr(one, name), getattr(five, name), name)
    assert ned.steps == five.steps
    for name in SIGNALS:
        assert difference(ned, five, name) < 1e-9, name


def test_a_dive_in_a_rough_sea_equals_closed_loop(tmp_path: Path, domain: int) -> None:
    """With an altimeter that the mission does not need, and with every error of instruments and servos."""
    asked = ["--sea", "rough", "--seed", "3", "--flown", "0", "--composed", "--domain", str(domain)]
    run = flown(tmp_path / "run", *asked)
    options = Options(**DIVE, sea="rough", seed=3, flown=0.0)
    reference = closed_loop.fly(mission_plan.make(options, tmp_path).scenario())
    assert isinstance(reference, SpatialRun)
    assert run.steps == reference.steps
    for name in (*SIGNALS, "x_true", "y_true", "z_true", "theta_true"):
        assert difference(run, reference, name) < 1e-9, name
    # To the last bit: over minutes the dead bands of the servos would make decimetres of less.
    for name in ("x_true", "z_true", "rudder_cmd", "sternplanes_cmd", "q", "ur"):
        np.testing.assert_array_equal(getattr(run, name), getattr(reference, name), name)
    assert np.abs(run.z - run.z_true).max() > 0.01
    (_, odometry), *_ = load_messages(tmp_path / "run" / "bag", topics.ODOM.name)
    assert odometry.pose.covariance[14] > 0.0  # of the depth


def test_an_altitude_is_held_over_the_graph_as_in_closed_loop(tmp_path: Path, domain: int) -> None:
    mission, sea = str(DATA / "short_altitude.yaml"), str(DATA / "bottom.yaml")
    asked = ["--mission", mission, "--sea", sea, "--composed", "--domain", str(domain)]
    run = flown(tmp_path / "run", *asked)
    options = Options(mission=mission, vehicle="remus100_6dof", sea=sea)
    reference = closed_loop.fly(mission_plan.make(options, tmp_path).scenario())
    assert isinstance(reference, SpatialRun)
    assert run.steps == reference.steps
    for name in ("x", "z", "theta", "depth_d", "sternplanes_cmd"):
        assert difference(run, reference, name) < 1e-6, name  # the range is a float32 on the wire
    heard = np.isfinite(run.altitude)
    assert heard.any()
    assert np.abs(run.altitude[heard] - reference.altitude[heard]).max() < 1e-5
    space = page_data(mission_in(read_bag(tmp_path / "run")), [], "at an altitude")["space"]
    assert [colour["label"] for colour in space["colours"]][1:] == ["depth error, below is positive"]
    north, bottom = (np.frombuffer(base64.b64decode(space["bottom"][axis]), "<f4") for axis in "xz")
    mesh = np.frombuffer(base64.b64decode(space["mesh"]["z"]), "<f4").reshape(len(space["mesh"]["n"]), -1)
    assert np.abs(bottom - (12.0 + 0.05 * north)).max() < 0.5  # of the sea file, with 0.05 m of noise
    np.testing.assert_allclose(mesh[:, 0], 12.0 + 0.05 * np.array(space["mesh"]["n"]), atol=1e-5)
