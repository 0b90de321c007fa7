"""Every command and every listing of README, docs/ and CONTRIBUTING.md is one that works.

A command is parsed by its own parser, with placeholders filled in. What takes seconds is then run, shortened;
what takes longer names the test that runs it.
"""

from __future__ import annotations

import importlib
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.settings.schema import flattened, nested, validated
from auv_path_following import config_files, vehicle
from auv_path_following.missions import mission_file
from auv_sim.cli import bag as bag_cli
from auv_sim.cli import mission as mission_cli
from auv_sim.cli import plan as plan_cli
from auv_sim.driver_parameters import MavlinkDriverParameters
from auv_sim.flight import closed_loop
from auv_sim.flight.batch.judge import judged
from auv_sim.launch import mission_plan
from auv_sim.launch.fleet import fleet_plan
from auv_sim.launch.options import checked_options, common_options
from auv_sim.own_vehicle.manoeuvres.manoeuvre_parameters import ManoeuvresParameters
from auv_sim.sim_parameters import SUITE, FaultRelayParameters
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.vehicle import sea
from conftest import SHORT_MISSION
from doc_commands import FILES, LINES, Line, chosen, script_of, words_of
from doc_pages import ROOT, listings

#: Script -> the module with its parser.
PARSERS = {
    "bag": "auv_sim.cli.bag",
    "benchmark": "auv_sim.cli.benchmark",
    "campaign": "auv_sim.cli.campaign",
    "check_vehicle": "auv_sim.cli.vehicles.check_vehicle",
    "fault_matrix": "auv_sim.cli.fault_matrix",
    "gallery": "auv_sim.cli.gallery",
    "live_view": "auv_sim.cli.live_view",
    "console": "auv_sim.cli.console",
    "mission": "auv_sim.cli.mission",
    "plan": "auv_sim.cli.plan",
    "reproduce_paper": "auv_sim.cli.reproduce_paper",
    "sea_trials": "auv_sim.cli.sea_trials",
    "soak": "auv_sim.cli.soak",
    "vehicle": "auv_sim.cli.vehicles.vehicle_command",
}
#: What the shell and other programs' commands begin with: they are no commands of this suite.
FOREIGN = (
    "cd",
    "mkdir",
    "source",
    "pip",
    "rosdep",
    "sudo",
    "python3 -m",
    "ros2 service",
    "ros2 param",
)
#: Where colcon puts what config/ ships.
SHARE = "install/auv_path_following/share/auv_path_following/"
NODES = SUITE | {"fault_relay": FaultRelayParameters, "manoeuvres": ManoeuvresParameters}


@pytest.fixture(autouse=True)
def _where_pages_begin(monkeypatch: pytest.MonkeyPatch) -> None:
    """The commands of the pages are typed in the repository."""
    monkeypatch.chdir(ROOT)


def test_there_is_nothing_that_no_test_looks_at() -> None:
    rest = [line for line in LINES if not line.text.startswith(FOREIGN)]
    others = [
        line
        for line in rest
        if script_of(line) not in PARSERS and not line.text.startswith(("ros2 run", "ros2 launch"))
    ]
    assert {line.text for line in others} == {
        "python3 examples/fly_closed_loop.py",  # test_examples.py
        "python3 scripts/api_docs.py",  # test_api_docs.py
        "python3 scripts/test.py",
        "python3 examples/own_law.py",  # test_examples.py
        "python3 scripts/test.py -k fermat -x",
        "python3 scripts/test.py -q test/auv_path_following/guidance",
        "python3 my_driver.py --ros-args -r __ns:=/auv",  # test_driver_doc.py
    }


@pytest.mark.parametrize("line", [line for line in LINES if script_of(line) in PARSERS], ids=str)
def test_a_command_of_scripts_is_understood(line: Line) -> None:
    module = importlib.import_module(PARSERS[script_of(line)])
    words = words_of(line)
    if "--help" in words:
        with pytest.raises(SystemExit) as ended:
            module.parser().parse_args(words)
        assert ended.value.code == 0
        return
    parsed = vars(module.parser().parse_args(words))
    for option, kind in FILES.items():
        if isinstance(parsed.get(option), str):
            assert config_files.find(kind, parsed[option]).is_file()


@pytest.mark.parametrize("line", [line for line in LINES if line.text.startswith("ros2 run")], ids=str)
def test_a_node_that_ros2_runs_has_these_parameters(line: Line) -> None:
    _, _, package, node, *rest = shlex.split(line.text)
    if package == "my_driver":
        return
    source = (ROOT / "src" / package / "setup.py").read_text(encoding="utf-8")
    assert f'"{node} = ' in source
    given = dict(word.split(":=") for word in rest if ":=" in word and not word.startswith("__"))
    given.pop("use_sim_time", None)
    if node not in NODES:
        assert not given
        return
    known = flattened(NODES[node]())
    typed = {name: type(known[name])(value) for name, value in given.items()}
    validated(NODES[node], nested(typed), str(line))
    for word in rest:
        if word.startswith(SHARE):
            assert (ROOT / word.removeprefix(SHARE)).is_file()


def test_the_nodes_that_are_started_by_hand_follow_the_simulator() -> None:
    """Their timeouts and their check for late messages run on the simulator's clock."""
    page = "docs/ros2_workspace.md"
    started = [line.text for line in LINES if line.page == page and line.text.startswith("ros2 run")]
    assert len(started) == 5
    assert all("use_sim_time:=true" in text or "remus_plant" in text for text in started)


def shortened(line: Line, directory: Path) -> list[str]:
    """A flight of half a minute, in one process, of what a page flies for longer."""
    words = words_of(line)
    if "--mission" not in words:
        words += ["--mission", str(SHORT_MISSION)]
    if "--speed" in words:
        words[words.index("--speed") + 1] = "20"
    return [*words, "--composed", "--quiet", "--out", str(directory)]


def planned_here() -> list[Line]:
    """`vehicle.py new` writes selkie_survey.yaml; its stand-in has turns too tight for that vehicle."""
    elsewhere = {"--help", "selkie_survey.yaml"}
    return [line for line in chosen("mission") if not elsewhere & set(shlex.split(line.text))]


@pytest.mark.parametrize("line", planned_here(), ids=str)
def test_a_mission_can_be_planned(line: Line, tmp_path: Path) -> None:
    """Its files are read and checked, and its path is one that the vehicle can fly."""
    given = vars(mission_cli.parser().parse_args(words_of(line)))
    if (name := given.pop("fleet")) is not None:
        assert len(fleet_plan.make(name, common_options(given), tmp_path).members) > 1
        return
    plan = mission_plan.make(checked_options(given), tmp_path)
    assert plan.options.no_sim == ("--no-sim" in line.text)
    assert {"mission", "vehicle", "params"} <= set(plan.sources)


#: Commands that are flown: the first ones of a newcomer, one that runs free, and one that begins on the path.
FLOWN = (
    "README.md: python3 scripts/mission.py --current 0.1 0.2",
    "README.md: python3 scripts/mission.py --mission helix --vehicle remus100_6dof",
    "README.md: python3 scripts/mission.py --sea rough --params rough",
    "docs/flying.md: python3 scripts/mission.py --speed 4",
    "docs/flying.md: python3 scripts/mission.py --start-at 'subpath 3'",
)


def test_what_is_flown_stands_on_its_page() -> None:
    assert set(FLOWN) <= {str(line) for line in LINES}


@pytest.mark.parametrize("line", [line for line in LINES if str(line) in FLOWN], ids=str)
def test_a_mission_flies(line: Line, tmp_path: Path, domain: int) -> None:
    program = [
        sys.executable,
        "-m",
        mission_cli.__name__.removesuffix(".cli"),
        *shortened(line, tmp_path / "run"),
    ]
    done = subprocess.run(program, capture_output=True, text=True, check=False, timeout=180)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("line", chosen("plan"), ids=str)
def test_a_plan_is_drawn(line: Line, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    words = ["path.kml" if word == "/dev/null" else word for word in words_of(line)]
    assert plan_cli.main(words) == 0
    assert list(tmp_path.glob("*.png"))


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run directory."""
    run = tmp_path_factory.mktemp("docs") / "run"
    words = ["--mission", str(SHORT_MISSION), "--composed", "--quiet", "--out", str(run)]
    subprocess.run([sys.executable, "-m", "auv_sim.cli.mission", *words], check=True, timeout=180)
    return run


@pytest.mark.parametrize("line", [line for line in chosen("bag") if "replay" not in line.text], ids=str)
def test_a_bag_is_looked_into(
    line: Line, recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """replay takes as long as the flight: test_recorder_process.py runs it."""
    monkeypatch.chdir(tmp_path)  # some of them write a picture there
    assert bag_cli.main(words_of(line, recorded)) == 0


def test_the_python_of_the_page_flies_what_the_launcher_flies() -> None:
    (code,) = listings("docs/python.md", "python")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    duration, distance = map(float, re.findall(r"[\d.]+", done.stdout))
    assert 600.0 < duration < 700.0
    assert distance < 1.0


def test_the_study_of_the_page_flies(tmp_path: Path) -> None:
    (text,) = listings("docs/campaigns.md", "yaml")
    (tmp_path / "my_study.yaml").write_text(text, encoding="utf-8")
    plan = StudyPlan(tmp_path / "my_study.yaml")
    scenarios = [plan.scenario(run) for run in range(12)]
    x0, y0, chi0 = scenarios[0].path.start_pose
    beside = [-np.sin(chi0) * (s.initial.x - x0) + np.cos(chi0) * (s.initial.y - y0) for s in scenarios]  # type: ignore[union-attr]
    assert max(np.abs(beside)) > 1.0, "every start lies on the path's course"
    assert {one.guidance.law for one in scenarios} == {"ailos", "ilos"}
    for one in scenarios:  # compiling both laws would take longer than the flights
        assert judged(closed_loop.fly(one), one)["finite"]


def test_the_seas_of_the_page_are_seas(tmp_path: Path) -> None:
    seas = []
    for text in listings("docs/sea.md", "yaml"):
        (tmp_path / "mine.yaml").write_text(text, encoding="utf-8")
        seas.append(sea.load(str(tmp_path / "mine.yaml")))
    late, turning = seas
    assert late.rudder.dead_time == 0.2
    assert turning.current.schedule[1] == (500.0, -0.43, 0.25, 0.1)


def test_the_first_mission_of_the_page_is_one(tmp_path: Path) -> None:
    page = (ROOT / "docs/missions.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"## A first mission\n\n((?:    .*\n)+)", page)
    file = tmp_path / "first.yaml"
    file.write_text(re.sub(r"(?m)^    ", "", block), encoding="utf-8")
    assert mission_file.load(str(file)).path.length > 250.0
    assert yaml_file.parse(file)["name"] == "harbour round"


def test_the_vehicle_in_per_cent_of_the_page_is_one(tmp_path: Path) -> None:
    (text,) = listings("docs/missions.md", "yaml")
    (tmp_path / "own.yaml").write_text(text, encoding="utf-8")
    assert vehicle.load(str(tmp_path / "own.yaml")).thrust_symbol == "%"


def test_the_signing_key_of_the_page_is_a_parameter(tmp_path: Path) -> None:
    (text,) = listings("docs/mavlink.md", "yaml")
    (tmp_path / "signed.yaml").write_text(text, encoding="utf-8")
    node = topics.MAVLINK_DRIVER
    read = params_file.load(tmp_path / "signed.yaml", {node: MavlinkDriverParameters})
    assert read[node].signing_key == "mavlink.key"
