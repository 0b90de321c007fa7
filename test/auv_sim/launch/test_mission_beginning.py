"""A mission that begins in the middle of its path, and one that is flown against the check."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.cli import mission as mission_command
from auv_sim.launch import mission_plan
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import Options

TIGHT = Path(__file__).parents[1] / "cli" / "wrong_missions" / "20_turn_too_tight.yaml"


def made(tmp_path: Path, mission: Path, **options: object) -> Plan:
    return mission_plan.make(Options(mission=str(mission), **options), tmp_path)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("place", "s", "pose"),
    [
        (None, 0.0, (0.0, 0.0, 0.0)),
        ("subpath 3", 2.0, (35.0, 20.0, 90.0)),
        ("5 m", 1 / 3, (5.0, 0.0, 0.0)),
    ],
)
def test_the_simulated_vehicle_begins_where_the_mission_does(
    place: str | None, s: float, pose: tuple[float, ...], short_mission: Path, tmp_path: Path
) -> None:
    plan = made(tmp_path, short_mission, start_at=place)
    initial = plan.parameters[topics.PLANT].initial
    assert plan.begin == pytest.approx(s)
    assert (initial.x, initial.y, np.degrees(initial.psi)) == pytest.approx(pose, abs=1e-6)
    assert plan.parameters[topics.GUIDANCE].start_at == (place or "")


def test_initial_comes_before_the_place(short_mission: Path, tmp_path: Path) -> None:
    plan = made(tmp_path, short_mission, start_at="subpath 3", initial=(1.0, 2.0, 30.0))
    initial = plan.parameters[topics.PLANT].initial
    assert (initial.x, initial.y, plan.begin) == (1.0, 2.0, 2.0)


def test_a_diver_begins_at_the_depth_of_the_place(tmp_path: Path) -> None:
    (tmp_path / "down.yaml").write_text(
        "version: 1\nname: down\nframe: ned\nthrust: 6.48\n"
        "waypoints: {points: [[0, 0, 8], [100, 0, 28]], smoothing: {kind: linear}}\n"
    )
    plan = made(tmp_path, tmp_path / "down.yaml", vehicle="remus100_6dof", start_at="subpath 1")
    assert plan.parameters[topics.PLANT].initial.depth == pytest.approx(8.0)
    half = np.hypot(100.0, 20.0) / 2
    plan = made(tmp_path, tmp_path / "down.yaml", vehicle="remus100_6dof", start_at=f"{half:.6f} m")
    initial = plan.parameters[topics.PLANT].initial
    assert (initial.x, initial.depth) == pytest.approx((50.0, 18.0), abs=1e-3)
    assert initial.theta == pytest.approx(-np.arctan(0.2))


@pytest.mark.parametrize(
    ("place", "expected"),
    [
        ("subpath 4", "a subpath from 1 to 3"),
        ("61.5 m", "less than the path's 61.4 m"),
        ("half way", "'subpath 3', '120 m', or nothing"),
    ],
)
def test_a_wrong_place_is_one_line_before_anything_starts(
    place: str, expected: str, short_mission: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = ["--mission", str(short_mission), "--start-at", place, "--out", str(tmp_path / "run")]
    assert mission_command.main([*asked, "--wait"]) == 2
    assert capsys.readouterr().err == f"--start-at: found '{place}', expected {expected}\n"
    assert not (tmp_path / "run").exists()


def test_a_place_in_the_parameter_file_is_checked_too(short_mission: Path, tmp_path: Path) -> None:
    file = tmp_path / "own.yaml"
    file.write_text("/**/ailos_guidance: {ros__parameters: {start_at: subpath 9}}\n")
    with pytest.raises(ConfigurationError, match=r"own\.yaml: ailos_guidance: start_at: found 'subpath 9'"):
        made(tmp_path, short_mission, params=str(file))


def test_closed_loop_does_not_take_a_flight_from_elsewhere_for_the_whole(
    short_mission: Path, tmp_path: Path
) -> None:
    with pytest.raises(ConfigurationError, match="--start-at: found 'subpath 2', expected none"):
        made(tmp_path, short_mission, start_at="subpath 2").scenario()


def test_what_is_flown_by_force_can_be_set_in_flight_too(tmp_path: Path) -> None:
    assert not made(tmp_path, TIGHT, force=True).parameters[topics.GUIDANCE].check_mission
    assert made(tmp_path, Path("loiter")).parameters[topics.GUIDANCE].check_mission
