"""Studies: what is drawn, what is flown, what is refused."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_sim.flight.scenario import start_of
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.distributions import Distribution
from auv_sim.vehicle.hulls.rigid_body import angles_of

WRONG = Path(__file__).parent / "wrong_studies"


def study(folder: Path, text: str) -> StudyPlan:
    file = folder / "trial.yaml"
    file.write_text("version: 1\nname: trial\n" + text, encoding="utf-8")
    return StudyPlan(file)


def test_distributions_are_what_they_say() -> None:
    generator = np.random.default_rng(3)

    def drawn(**told) -> np.ndarray:
        distribution = Distribution(**told)
        values = np.array([distribution.draw(generator) for _ in range(4000)])
        low, high = min(distribution.extremes), max(distribution.extremes)
        assert np.all((values >= low) & (values <= high))
        return values

    assert drawn(uniform=(-2.0, 4.0)).mean() == pytest.approx(1.0, abs=0.15)
    assert np.log(drawn(log_uniform=(0.01, 100.0))).mean() == pytest.approx(0.0, abs=0.25)
    normal = drawn(normal=(5.0, 2.0))
    assert (normal.mean(), normal.std()) == pytest.approx((5.0, 2.0), abs=0.15)
    assert drawn(normal=(0.0, 1.0), within=(0.0, 9.0)).mean() == pytest.approx(
        math.sqrt(2 / math.pi), abs=0.06
    )
    # Uniform on a disc: half of the points lie beyond 1/sqrt(2) of the radius.
    assert np.mean(drawn(disc=10.0) > 10.0 / math.sqrt(2.0)) == pytest.approx(0.5, abs=0.04)
    assert np.mean(drawn(choice=(1.0, 2.0, 2.5)) == 2.5) == pytest.approx(1 / 3, abs=0.04)


def test_a_run_is_its_own(tmp_path: Path) -> None:
    few = study(tmp_path, "seed: 4\nruns: 5\nvary: {current.speed: {disc: 0.4}}\n")
    drawn = [few.values(k)["current.speed"] for k in range(5)]
    assert len(set(drawn)) == 5
    text = "vary: {initial.surge: {uniform: [1, 2]}, current.speed: {disc: 0.4}}\n"
    more = study(tmp_path, f"seed: 4\nruns: 500\n{text}")
    # More runs and more parameters leave what was drawn as it was; another seed does not.
    assert [more.values(k)["current.speed"] for k in range(5)] == drawn
    other = study(tmp_path, f"seed: 5\nruns: 500\n{text}")
    assert [other.values(k)["current.speed"] for k in range(5)] != drawn


def test_points_of_a_grid_share_what_is_drawn(tmp_path: Path) -> None:
    plan = study(
        tmp_path,
        "runs: 3\nvary:\n  autopilot.nism.k1: {grid: [0.2, 0.4]}\n  guidance.law: {grid: [ailos, los]}\n"
        "  current.north: {uniform: [0, 1]}\n",
    )
    assert plan.runs == 12
    rows = [plan.values(k) for k in range(12)]
    assert [(row["autopilot.nism.k1"], row["guidance.law"]) for row in rows[:4]] == [
        (0.2, "ailos"), (0.2, "los"), (0.4, "ailos"), (0.4, "los")
    ]  # fmt: skip
    assert len({row["current.north"] for row in rows[:4]}) == 1
    assert len({row["current.north"] for row in rows}) == 3


def test_every_name_reaches_the_flight(tmp_path: Path) -> None:
    plan = study(
        tmp_path,
        "sea: rough\nvary:\n  initial.ahead: {choice: [3]}\n  initial.starboard: {choice: [4]}\n"
        "  initial.distance: {choice: [10]}\n  initial.bearing_deg: {choice: [90]}\n"
        "  initial.heading_deg: {choice: [30]}\n  initial.surge: {choice: [1.5]}\n"
        "  current.east: {choice: [0.1]}\n  current.speed: {choice: [0.2]}\n"
        "  current.course_deg: {choice: [90]}\n"
        "  vehicle.hull.Nuud: {choice: [0.5], factor: true}\n  vehicle.thrust_max: {choice: [7]}\n"
        "  guidance.ailos.lookahead: {choice: [7.5]}\n  guidance.compensate_current: {choice: [false]}\n"
        "  observer.k_ob1: {choice: [2]}\n  autopilot.controller: {choice: [pid]}\n"
        "  sea.sensors.heading.noise_deg.white: {choice: [2], factor: true}\n",
    )
    told, remus = plan.scenario(0), vehicle.load("remus100")
    assert told.vehicle.hull is not None and remus.hull is not None and told.sea is not None
    origin = start_of(told.path)
    away = (told.initial.x - origin.x, told.initial.y - origin.y)
    ahead = away[0] * math.cos(origin.psi) + away[1] * math.sin(origin.psi)
    starboard = -away[0] * math.sin(origin.psi) + away[1] * math.cos(origin.psi)
    assert (ahead, starboard) == pytest.approx((3.0, 14.0))
    assert (told.initial.psi - origin.psi, told.initial.ur) == pytest.approx((math.radians(30.0), 1.5))
    assert told.current == pytest.approx((0.0, 0.3))
    assert told.vehicle.hull.Nuud == 0.5 * remus.hull.Nuud and told.vehicle.thrust_max == 7.0
    assert told.controller_vehicle == remus
    assert told.guidance.ailos.lookahead == 7.5 and told.guidance.compensate_current is False
    assert told.observer.k_ob1 == 2.0 and told.autopilot.controller == "pid"
    assert told.sea.sensors.heading.noise_deg.white == pytest.approx(0.4)
    assert told.autopilot.reference.enabled  # what is not varied is the file's


def test_the_former_key_of_the_controller_model_still_serves(tmp_path: Path) -> None:
    text = "{}: remus100_table2\n"
    former = study(tmp_path, text.format("believed"))
    present = study(tmp_path, text.format("controller_model"))
    assert former.study == present.study
    assert former.scenario(0).controller_vehicle == present.scenario(0).controller_vehicle
    assert former.scenario(0).controller_vehicle != former.scenario(0).vehicle
    assert (former.notices, present.notices) == ((f"{former.where}: believed is now controller_model",), ())


def test_both_names_of_a_key_are_refused(tmp_path: Path) -> None:
    with pytest.raises(
        ConfigurationError, match="found believed and controller_model, expected controller_model"
    ):
        study(tmp_path, "believed: remus100\ncontroller_model: remus100\n")


def test_the_seed_of_the_sea_is_the_runs(tmp_path: Path) -> None:
    plan = study(tmp_path, "sea: rough\nruns: 4\n")
    seeds = [plan.scenario(k).seed for k in range(4)]
    assert len(set(seeds)) == 4
    assert plan.scenario(2).seed == seeds[2]


def test_a_start_is_relative_to_any_place_on_the_path_and_the_hull_may_vary(tmp_path: Path) -> None:
    """The paper's path: 200 sqrt(2) m to the north-east, then 200 m to the east, of 1276.5 m."""
    text = (
        "runs: 40\nvary:\n  initial.along: {choice: [0, 0.3, 1]}\n  initial.starboard: {choice: [4]}\n"
        "  vehicle: {choice: [remus100, remus100_table2]}\n"
    )
    plan = study(tmp_path, text)
    ends = {0.0: (-20.0, 20.0), 0.3: (180.0, 320.1), 1.0: (180.0, 20.0)}
    seen = set()
    for run in range(plan.runs):
        values, scenario = plan.values(run), plan.scenario(run)
        x, y, psi = scenario.initial[:3]  # type: ignore[index]
        there = x + 4.0 * math.sin(psi), y - 4.0 * math.cos(psi)
        along = float(values["initial.along"])
        assert there == pytest.approx(ends[along], abs=0.1)
        hull = vehicle.load(str(values["vehicle"]))
        assert scenario.vehicle == scenario.controller_vehicle == hull
        seen.add((along, values["vehicle"]))
    assert len(seen) == 6


@pytest.mark.parametrize("name", config_files.shipped("studies"))
def test_shipped_studies_can_be_flown(name: str) -> None:
    plan = StudyPlan(config_files.find("studies", name))
    assert plan.study.name == name
    for run in (0, plan.runs // 2, plan.runs - 1):
        assert dataclasses.is_dataclass(plan.scenario(run))


def expectation(file: Path) -> str:
    return file.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")


@pytest.mark.parametrize("file", sorted(WRONG.glob("*.yaml")), ids=lambda file: file.stem)
def test_a_wrong_study_gets_one_line(file: Path) -> None:
    with pytest.raises(ConfigurationError) as error:
        plan = StudyPlan(file)
        for run in range(plan.runs):
            plan.scenario(run)
    message = str(error.value)
    assert "\n" not in message and file.name in message
    assert expectation(file) in message, message


def test_a_vehicle_that_dives_starts_at_the_depth_of_its_path(tmp_path: Path) -> None:
    for mission, depth in (
        ("helix", 5.0),
        ("mss_course", vehicle.load("remus100_6dof").shallowest),
        ("loiter", 0.5),
    ):
        text = f"mission: {mission}\nvehicle: remus100_6dof\nruns: 2\n"
        scenario = study(tmp_path, text).scenario(0)
        assert scenario.initial.z == pytest.approx(depth)
        assert scenario.initial.x == pytest.approx(scenario.path.start_pose[0])
        assert angles_of(scenario.initial)[2] == pytest.approx(scenario.path.start_pose[2])


def test_a_planar_vehicle_does_not_fly_a_path_with_depths(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="sternplanes: found a path with depth"):
        study(tmp_path, "mission: helix\nvehicle: remus100\nruns: 2\n")


def test_starts_and_currents_have_a_vertical_part(tmp_path: Path) -> None:
    text = (
        "mission: helix\nvehicle: remus100_6dof\nsuccess: {steady_rms_depth_error: 0.02}\nvary:\n"
        "  initial.below: {choice: [4]}\n  initial.pitch_deg: {choice: [-15]}\n"
        "  current.down: {choice: [0.1]}\n  initial.starboard: {choice: [3]}\n"
        "  current.east: {choice: [0.2]}\n  pitch.nism.k1: {choice: [0.3]}\n"
    )
    plan = study(tmp_path, text)
    asked = plan.scenario(0)
    x, y, z, _, chi = asked.spatial.start_pose
    _, theta, psi = angles_of(asked.initial)
    assert (asked.initial.z, theta, psi) == pytest.approx((z + 4.0, math.radians(-15.0), chi))
    assert math.hypot(asked.initial.x - x, asked.initial.y - y) == pytest.approx(3.0)
    assert asked.current == pytest.approx((0.0, 0.2, 0.1))
    assert asked.pitch.nism.k1 == 0.3
    assert plan.dives


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("vary:\n  initial.below: {uniform: [-20, 5]}\n", "found a start at a depth of -15 m"),
        ("vehicle: remus100\nmission: loiter\nvary:\n  current.down: {choice: [0.1]}\n", "stern planes"),
        ("vehicle: remus100\nmission: loiter\njudge: largest_pitch\n", "a figure of flights with depth"),
    ],
)
def test_what_has_no_depth_is_refused(tmp_path: Path, text: str, message: str) -> None:
    base = "" if "vehicle" in text else "mission: helix\nvehicle: remus100_6dof\n"
    with pytest.raises(ConfigurationError, match=message):
        study(tmp_path, base + text)
