"""A fleet's file: the missions of its vehicles, and the one line that refuses it."""

from __future__ import annotations

from pathlib import Path

import pytest

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_sim.cli.mission import main
from auv_sim.launch.fleet import fleet_file, fleet_plan
from auv_sim.launch.options import Options

TWO = """
version: 1
name: pair
vehicles:
  - {namespace: auv1, mission: loiter, initial: [1, 2, 90]}
  - {namespace: /auv2, mission: helix, vehicle: remus100_6dof, depth: 3}
"""


def written(tmp_path: Path, text: str) -> Path:
    file = tmp_path / "fleet.yaml"
    file.write_text(text, encoding="utf-8")
    return file


def plan_of(tmp_path: Path, text: str, **options: object) -> fleet_plan.FleetPlan:
    return fleet_plan.make(str(written(tmp_path, text)), Options(**options), tmp_path / "run")  # type: ignore[arg-type]


@pytest.mark.parametrize("name", config_files.shipped("fleets"))
def test_shipped_fleets_can_be_flown(name: str, tmp_path: Path) -> None:
    plan = fleet_plan.make(name, Options(), tmp_path)
    assert plan.lockstep
    assert len(plan.members) == len(plan.fleet.vehicles)


def test_each_vehicle_has_a_mission_of_its_own_and_one_has_the_clock(tmp_path: Path) -> None:
    plan = plan_of(tmp_path, TWO)
    first, second = plan.members.values()
    assert list(plan.members) == ["auv1", "auv2"]
    assert (first.options.namespace, second.options.namespace) == ("/auv1", "/auv2")
    assert first.parameters[topics.PLANT].initial.x == 1.0
    assert second.parameters[topics.PLANT].initial.depth == 3.0
    assert plan.clock.vehicles == "/auv1 /auv2"
    assert all(member.parameters[topics.PLANT].shared_clock for member in plan.members.values())
    assert [claim.clock for claim in plan.claims().values()] == [True, False]
    assert second.parameters[topics.RECORDER].directory == str(tmp_path / "run" / "auv2" / "bag")


def test_vehicles_that_share_a_bag_share_the_lead_over_its_recorder(tmp_path: Path) -> None:
    each, one = plan_of(tmp_path, TWO), plan_of(tmp_path, f"{TWO}bags: one\n")
    assert each.one_bag is None
    assert one.one_bag == tmp_path / "run" / "bag"
    for plan, number in ((each, 1), (one, 2)):
        for member in plan.members.values():
            assert member.parameters[topics.PLANT].recorded_vehicles == number
            assert member.parameters[topics.RECORDER].vehicles == "/auv1 /auv2"
    assert {member.parameters[topics.RECORDER].directory for member in one.members.values()} == {
        str(one.one_bag)
    }


@pytest.mark.parametrize("vehicles", range(1, topics.MOST_RECORDED + 1))
def test_a_request_and_its_report_fit_into_the_lead(vehicles: int) -> None:
    """Else a step would wait for the recorder's timer; and the messages of all fit into one queue of 512."""
    asked = topics.shared(topics.RECORDING_REQUEST, vehicles)
    reported = topics.shared(topics.RECORDING_REPORT, vehicles)
    for lead, messages in ((topics.RECORDING_LEAD, 16), (topics.SPATIAL_RECORDING_LEAD, 23)):
        assert asked + reported <= topics.shared(lead, vehicles)
        assert topics.shared(lead, vehicles) * messages * vehicles < 512
        # What the recorder has missed, paused or not yet matched, is still there to be sent again.
        assert topics.shared(lead, vehicles) <= qos.offered(topics.ODOM, lockstep=True).depth


def test_more_vehicles_than_one_recorder_can_record_are_refused(tmp_path: Path) -> None:
    vehicles = "".join(f"  - {{namespace: auv{k}, mission: loiter}}\n" for k in range(11))
    file = written(tmp_path, f"version: 1\nname: many\nbags: one\nvehicles:\n{vehicles}")
    with pytest.raises(ConfigurationError) as refused:
        fleet_file.load(str(file))
    assert str(refused.value) == (
        f"{file}: bags: found one, with 11 vehicles, expected each: one bag has at most 10 vehicles"
    )


def test_the_water_is_the_same_for_all_and_the_noise_is_not(tmp_path: Path) -> None:
    plan = plan_of(tmp_path, f"{TWO}current: [0.1, 0.2]\nupwelling: 0.05\nsea: calm\nseed: 7\n")
    plants = [member.parameters[topics.PLANT] for member in plan.members.values()]
    assert [(plant.current.Vx, plant.current.Vy) for plant in plants] == [(0.1, 0.2)] * 2
    assert [plant.current.Vz for plant in plants] == [0.0, -0.05]  # the first has no stern planes
    assert [plant.seed for plant in plants] == [7, 8]


def test_files_beside_the_fleets_file_are_found(tmp_path: Path) -> None:
    mission = config_files.find("missions", "loiter").read_text(encoding="utf-8")
    (tmp_path / "mine.yaml").write_text(mission, encoding="utf-8")
    plan = plan_of(tmp_path, TWO.replace("mission: loiter", "mission: mine.yaml"))
    assert plan.members["auv1"].sources["mission"] == tmp_path / "mine.yaml"


@pytest.mark.parametrize(
    ("old", "new", "place", "found"),
    [
        ("mission: loiter", "mission: nowhere", "vehicles[0].mission", "'nowhere', no such mission file"),
        ("/auv2", "/auv1", "vehicles[1].namespace", "/auv1 a second time"),
        ("/auv2", "auv1/", "vehicles[1].namespace", "/auv1 a second time"),
        ("/auv2", "2", "vehicles[1].namespace", ""),
        ("/auv2", "/", "vehicles[1].namespace", "'/'"),
        ("depth: 3", "depth: -3", "vehicles[1].depth", "-3"),
        ("depth: 3", "depth: 3000", "vehicles[1]: depth", "3000 m"),
        ("initial: [1, 2, 90]", "depth: 3", "vehicles[0]: depth", ""),
        ("vehicle: remus100_6dof, depth: 3", "seed: 1", "vehicles[1]: ", ""),
        ("initial: [1, 2, 90]", "seed: 3", "vehicles[0]: seed", "no sea"),
        ("name: pair", "name: pair\nsea: nowhere", "sea", "'nowhere', no such sea file"),
        ("name: pair", "name: pair\nseed: -1", "seed", "-1"),
    ],
)
def test_a_mistake_is_refused_with_file_and_key(
    old: str, new: str, place: str, found: str, tmp_path: Path
) -> None:
    assert old in TWO
    with pytest.raises(ConfigurationError) as refused:
        plan_of(tmp_path, TWO.replace(old, new))
    assert refused.value.where.startswith(f"{tmp_path / 'fleet.yaml'}: {place}"), refused.value.where
    assert found in refused.value.found
    assert "\n" not in str(refused.value)


def test_one_vehicle_is_no_fleet(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match=r"vehicles: found 1 of them, expected two or more"):
        fleet_file.load(str(written(tmp_path, TWO[: TWO.index("  - {namespace: /auv2")])))


@pytest.mark.parametrize(
    "option", [["--vehicle", "remus100_6dof"], ["loiter"], ["--no-sim"], ["--sea", "calm"]]
)
def test_what_the_file_holds_is_no_option_beside_it(
    option: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--fleet", "two", *option]) == 2
    assert "together with --fleet" in capsys.readouterr().err
