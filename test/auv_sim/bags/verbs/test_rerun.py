"""The chain on recorded data, with the same gains and with others; and the verbs that read a mission."""

from __future__ import annotations

import csv
import dataclasses
import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import flip_yaw, quaternion_of_yaw
from auv_msgs_py.settings import params_file, yaml_file
from auv_path_following import config_files, vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.missions import mission_file
from auv_sim.bags.content.rerun_phases import Phase
from auv_sim.bags.content.rerun_pilot import _RerunPilot, _Step
from auv_sim.bags.definitions import typestore
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.cli import bag as bag_command
from auv_sim.flight.closed_loop import fly
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import SUITE

TYPES = {topic.name: topic.type for topic in topics.CONTRACT}
COLUMNS = {
    "rudder_cmd": "rudder_cmd", "thrust_cmd": "thrust_cmd", "desired_thrust": "thrust_cmd",
    "path_parameter": "s", "rudder_state": "rudder",
}  # fmt: skip
MISSION = """\
version: 1
name: corner
frame: ned
thrust: 6.48
segments:
  - line: {start: [0, 0], length: 40, course_deg: 0}
  - line: {start: [40, 0], length: 30, course_deg: 40}
"""


def cdr(name: str, *values: Any) -> bytes:
    store = typestore()
    return bytes(store.serialize_cdr(store.types[TYPES[name]](*values), TYPES[name]))


def make(name: str, *values: Any) -> Any:
    return typestore().types[name](*values)


def stamped(stamp_ns: int, frame: str) -> Any:
    return make("std_msgs/msg/Header", make("builtin_interfaces/msg/Time", *divmod(stamp_ns, 10**9)), frame)


def vector(x: float, y: float, z: float = 0.0) -> Any:
    return make("geometry_msgs/msg/Vector3", x, y, z)


def twist(linear: Any, rate: float = 0.0) -> Any:
    inner = make("geometry_msgs/msg/Twist", linear, vector(0.0, 0.0, rate))
    return make("geometry_msgs/msg/TwistWithCovariance", inner, np.zeros(36))


@pytest.fixture(scope="module")
def run_directory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A mission flown by the closed loop and put on the wire as the nodes do, in lockstep."""
    root = tmp_path_factory.mktemp("flown") / "run"
    config = root / "config"
    config.mkdir(parents=True)
    (config / "mission.yaml").write_text(MISSION)
    (config / "vehicle.yaml").write_bytes(config_files.find("vehicles", "remus100").read_bytes())
    parameters = params_file.load(config_files.find("params", "paper"), SUITE)
    plain = params_file.as_ros(parameters)
    for body in plain.values():
        if "lockstep" in body["ros__parameters"]:
            body["ros__parameters"]["lockstep"] = True
    yaml_file.dump(plain, config / "params.yaml")
    hull = vehicle.load(str(config / "vehicle.yaml"))
    mission = mission_file.load(str(config / "mission.yaml"), hull)
    guidance = parameters[topics.GUIDANCE].with_mission_overrides(mission)
    flown = fly(
        Scenario(
            path=mission.path, vehicle=hull, thrust=mission.thrust, guidance=guidance.guidance,
            observer=parameters[topics.OBSERVER].observer, autopilot=parameters[topics.AUTOPILOT].autopilot,
        )
    )  # fmt: skip
    with BagWriter(root / "bag", "zstd") as writer:
        channels = {name: writer.add_topic(f"/auv/{name}", TYPES[name], []) for name in (
            "odom", "velocity_through_water", "rudder_cmd", "thrust_cmd", "desired_thrust", "path_parameter",
            "mission_state", "rudder_state", "path_error",
        )}  # fmt: skip

        def put(name: str, at: int, *values: Any) -> None:
            writer.write(channels[name], at, at, cdr(name, *values))

        put("mission_state", 10**9, "running")
        for k in range(flown.steps):
            at = round(flown.t[k] * 1e9)
            z, w = quaternion_of_yaw(flip_yaw(float(flown.psi[k])))
            pose = make(
                "geometry_msgs/msg/Pose",
                make("geometry_msgs/msg/Point", float(flown.y[k]), float(flown.x[k]), 0.0),
                make("geometry_msgs/msg/Quaternion", 0.0, 0.0, z, w),
            )
            covered = make("geometry_msgs/msg/PoseWithCovariance", pose, np.zeros(36))
            rate = -float(flown.r[k])
            put("odom", at, stamped(at, "map"), "base_link", covered, twist(vector(1.5, 0.0), rate))
            through = twist(vector(float(flown.ur[k]), -float(flown.vr[k])))
            put("velocity_through_water", at, stamped(at, "base_link"), through)
            for name, column in COLUMNS.items():
                put(name, at, float(getattr(flown, column)[k]))
            errors = vector(float(flown.xe[k]), float(flown.ye[k]), float(flown.psi_e[k]))
            put("path_error", at, stamped(at, "path_frd"), errors)
        put("mission_state", at, "complete")
    return root


def test_the_chain_flies_as_the_closed_loop_did(
    run_directory: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag_command.main(["rerun", str(run_directory), "--json"])
    found = json.loads(capsys.readouterr().out)["topics"]
    assert found["rudder_cmd"]["compared"] > 500
    assert found["rudder_cmd"]["largest"] < 1e-6
    assert found["thrust_cmd"]["identical"] == found["thrust_cmd"]["compared"]


@pytest.mark.parametrize("name", ["controller_model.yaml", "believed.yaml"], ids=["present", "former name"])
def test_the_nodes_model_of_the_hull_counts_and_not_the_vehicle_that_flew(
    run_directory: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    """A vehicle with half of the rudder and half of the thrust that the nodes are configured with."""
    run = tmp_path / "run"
    shutil.copytree(run_directory, run)
    config = run / "config"
    (config / "vehicle.yaml").rename(config / name)
    content = yaml_file.parse(config / name)
    content["rudder"]["max_angle_deg"] /= 2
    content["thrust_max"] /= 2
    yaml_file.dump(content, config / "vehicle.yaml")
    bag_command.main(["rerun", str(run), "--json"])
    found = json.loads(capsys.readouterr().out)["topics"]
    assert found["rudder_cmd"]["largest"] < 1e-6
    assert found["thrust_cmd"]["identical"] == found["thrust_cmd"]["compared"]
    assert bag_command.main(["inspect", str(run), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["mission"]["completed"] is True


@pytest.mark.parametrize("resumes", [False, True], ids=["gap of stamps", "recorded hold"])
def test_after_a_gap_the_chain_rejoins_as_the_nodes_did(resumes: bool) -> None:
    """16 s without odometry, the vehicle carried to 12 m: at its last speed P would be at 36 m."""
    parameters = params_file.load(config_files.find("params", "paper"), SUITE)
    mission, hull = mission_file.load("paper_composite"), vehicle.load("remus100")
    rerun_pilot = _RerunPilot(
        parameters, dataclasses.replace(mission, path=CompositePath([Line(0, 0, 100.0, 0)])), hull
    )

    def step(seconds: float, north: float, phase: Phase) -> float:
        stamp = round(seconds * 1e9)
        pose = make(
            "geometry_msgs/msg/Pose",
            make("geometry_msgs/msg/Point", 1.0 if north > 5 else 0.0, north, 0.0),
            make("geometry_msgs/msg/Quaternion", 0.0, 0.0, *quaternion_of_yaw(flip_yaw(0.0))),
        )
        covered = make("geometry_msgs/msg/PoseWithCovariance", pose, np.zeros(36))
        odometry = make(
            "nav_msgs/msg/Odometry", stamped(stamp, "map"), "base_link", covered, twist(vector(1.9, 0.0))
        )
        through = make(TYPES["velocity_through_water"], stamped(stamp, "base_link"), twist(vector(1.9, 0.0)))
        answer = rerun_pilot.step(_Step(odometry, stamp, stamp, through), phase)
        assert answer is not None
        return answer[rerun_pilot.answered.index("path_parameter")]

    for k in range(26):
        step(1.0 + 0.1 * k, 0.19 * k, Phase(True, k == 0, False))
    s = step(4.2, 12.0, Phase(True, False, True)) if resumes else step(20.0, 12.0, Phase(True, False, False))
    assert s == pytest.approx(0.12, abs=1e-4)


def test_other_gains_command_otherwise(
    run_directory: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "new.yaml").write_text(
        "/**/heading_autopilot:\n  ros__parameters: {autopilot: {nism: {k1: 1.2}}}\n"
    )
    files = ["--png", str(tmp_path / "rerun.png"), "--csv", str(tmp_path / "rerun.csv")]
    assert (
        bag_command.main(
            ["rerun", str(run_directory), "--params", str(tmp_path / "new.yaml"), "--json", *files]
        )
        == 0
    )
    found = json.loads(capsys.readouterr().out)
    assert found["topics"]["rudder_cmd"]["largest"] > 0.1
    with (tmp_path / "rerun.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == found["steps"]
    difference = [abs(float(row["rudder_cmd_new"]) - float(row["rudder_cmd_recorded"])) for row in rows]
    assert np.degrees(max(difference)) == pytest.approx(found["topics"]["rudder_cmd"]["largest"])
    assert (tmp_path / "rerun.png").read_bytes().startswith(b"\x89PNG")


def test_inspect_knows_the_mission(run_directory: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert bag_command.main(["inspect", str(run_directory), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["mission"]["completed"] is True
    assert (found["mission"]["flown_share"], found["mission"]["missed"]) == (1.0, [])
    assert [part["kind"] for part in found["mission"]["subpaths"]] == ["line", "line"]
    odom = next(topic for topic in found["topics"] if topic["name"] == "/auv/odom")
    assert odom["rate"] == pytest.approx(20.0)
    assert (odom["gaps"], odom["out_of_order"]) == (0, 0)
    kinds = [event["kind"] for event in found["events"]]
    assert kinds.count("state") == 2
    assert kinds.count("switch") == 1


def test_the_report_stands_alone(
    run_directory: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert bag_command.main(["report", str(run_directory), "--out", str(tmp_path)]) == 0
    page = (tmp_path / "report.html").read_text()
    assert str(tmp_path / "report.html") in capsys.readouterr().out
    assert "src=" not in page
    assert "@import" not in page
    assert "http" not in page.split('<script id="data"')[0]
    data = json.loads(page.split('type="application/json">')[1].split("</script>")[0])
    assert data["panels"][0]["series"][0]["name"] == "distance"
    assert len(data["switches"]) == 1
    assert data["space"] is None
    assert not {"way", "depth"} & set(data["columns"])
    assert 'id="space"' not in page
    assert ["mission", "complete"] in data["facts"] and ["flown", "100.00 %"] in data["facts"]
    assert set(data["config"]) == {"mission.yaml", "params.yaml", "vehicle.yaml"}
    assert {file.name for file in tmp_path.glob("*.png")} == {"overview.png", "track.png", "signals.png"}


def test_export_keeps_every_digit(run_directory: Path, tmp_path: Path) -> None:
    assert bag_command.main(["export", str(run_directory), "--out", str(tmp_path / "run.csv")]) == 0
    with (tmp_path / "run.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert float(rows[1]["t [s]"]) == 1.05
    assert rows[0]["Vx_true [m/s]"] == ""
    parquet = pytest.importorskip("pyarrow.parquet")
    assert bag_command.main(["export", str(run_directory), "--out", str(tmp_path / "run.parquet")]) == 0
    table = parquet.read_table(tmp_path / "run.parquet")
    assert table.num_rows == len(rows)
    assert table["rudder_cmd [rad]"].to_pylist() == [float(row["rudder_cmd [rad]"]) for row in rows]


def test_compare_tells_runs_apart(
    run_directory: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["compare", str(run_directory), str(run_directory / "bag"), "--json"]
    assert bag_command.main([*command, "--png", str(tmp_path / "compare.png")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [run["flown_share"] for run in found["runs"].values()] == [1.0, 1.0]
    figures = [run["rms_distance"] for run in found["runs"].values()]
    assert len(figures) == 2
    assert figures[0] == figures[1]
    assert found["settings"] == {}
    assert (tmp_path / "compare.png").read_bytes().startswith(b"\x89PNG")
    assert bag_command.main(["compare", str(run_directory)]) == 2
