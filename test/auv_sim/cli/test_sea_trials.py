"""`scripts/sea_trials.py` as a process, and what stands behind it."""

from __future__ import annotations

import json
import shlex
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_sim.cli import mission as mission_command
from auv_sim.cli import sea_trials
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.studies import noise_study, sea_trials_session
from auv_sim.vehicle import sea
from auv_sim.views import doc_pages

CommandLine = Callable[..., list[str]]


def test_the_default_mission_in_the_rough_sea_keeps_within_its_bound() -> None:
    """One of the seeds of docs/sea.md, in full."""
    trial = sea_trials_session.fly(
        sea_trials_session.TrialJob("paper_composite", "remus100", "robust", "rough", 27)
    )
    assert trial.completed
    assert trial.largest_distance <= 2.5
    assert 0.5 < trial.navigation_error < 3.0


def test_the_command_flies_and_tells(short_mission: Path, tmp_path: Path, command_line: CommandLine) -> None:
    page = tmp_path / "page.md"
    begin, end = doc_pages.marks(sea_trials_session.PART)
    page.write_text(f"before\n{begin}\nold\n{end}\nbehind\n", encoding="utf-8")
    out = tmp_path / "out"
    asked = [
        "--mission",
        short_mission,
        "--seeds",
        2,
        "--first",
        3,
        "--limit",
        5,
        "--out",
        out,
        "--page",
        page,
    ]
    command = command_line("auv_sim.cli.sea_trials", *asked)
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "2 of 2" in done.stdout
    assert f"scripts/mission.py --mission {short_mission}" in done.stdout.replace("\n", "")
    record = json.loads((out / "rough.json").read_text())
    assert [(trial["params"], trial["seed"]) for trial in record["trials"]] == [
        ("robust", 3), ("rough", 3), ("robust", 4), ("rough", 4),
    ]  # fmt: skip
    text = page.read_text(encoding="utf-8")
    assert text.startswith("before\n") and text.endswith("behind\n")
    assert "| `rough.yaml` | 2 of 2 |" in text and "old" not in text


def test_a_limit_that_is_not_kept_fails(short_mission: Path, tmp_path: Path, capsys) -> None:
    asked = ["--mission", str(short_mission), "--seeds", "1", "--params", "robust", "--limit", "0.01"]
    assert sea_trials.main([*asked, "--workers", "1", "--out", str(tmp_path)]) == 1
    assert "1 of 1" in capsys.readouterr().out


def test_the_printed_command_flies_the_same_and_files_of_one_name_stay_apart(
    short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    monkeypatch.chdir(tmp_path)
    for folder in ("my gains", "others"):
        Path(folder).mkdir()
        shutil.copyfile(config_files.find("params", "robust"), Path(folder) / "gains.yaml")
    shutil.copyfile(short_mission, "a mission.yaml")
    asked = ["--mission", "a mission.yaml", "--vehicle", "remus100_mismatch", "--seeds", "1", "--limit", "9"]
    gains = ["my gains/gains.yaml", "others/gains.yaml"]
    assert sea_trials.main([*asked, "--params", *gains, "--workers", "1", "--out", "out"]) == 0
    out = capsys.readouterr().out
    assert out.count("1 of 1") == 2
    record = json.loads(Path("out/rough.json").read_text())
    assert [row["params"] for row in record["together"]] == gains
    (line,) = (line for line in out.splitlines() if line.startswith("The worst one over ROS:"))
    words = shlex.split(line.split(":", 1)[1])
    assert words[:2] == ["python3", "scripts/mission.py"]
    told = mission_command.parser().parse_args(words[2:])
    assert (told.mission, told.vehicle, told.sea, told.seed) == (
        "a mission.yaml", "remus100_mismatch", "rough", 0
    )  # fmt: skip
    assert told.params in gains


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (["--sea", "wild"], "wild: found no such sea file"),
        (["--params", "robust", "nowhere"], "nowhere: found no such parameter file"),
        (["--page", "README.md"], "a page with"),
    ],
)
def test_a_mistake_is_told_before_anything_is_flown(
    asked: list[str], told: str, tmp_path: Path, capsys
) -> None:
    assert sea_trials.main([*asked, "--seeds", "1", "--workers", "1", "--out", str(tmp_path)]) == 2
    err = capsys.readouterr().err
    assert told in err
    assert err.count("\n") == 1


def test_noise_is_multiplied_and_nothing_else() -> None:
    rough = sea.load("rough")
    twice = noise_study.with_noise(rough, 2.0)
    assert twice.sensors.yaw_rate.noise_deg.white == 2.0 * rough.sensors.yaw_rate.noise_deg.white
    assert twice.sensors.yaw_rate.noise_deg.bias == rough.sensors.yaw_rate.noise_deg.bias
    assert twice.sensors.position == rough.sensors.position
    assert noise_study.with_noise(rough, 1.0) == rough


def test_the_study_is_drawn(short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(noise_study, "LEVELS", (0.0, 2.0))
    study = noise_study.fly(
        str(short_mission), "remus100", "rough", lambda _, work, items: [work(item) for item in items]
    )
    plain = noise_study.GAINS[0].label
    assert study[plain, "ideal", 2.0].rudder_rate > 1.2 * study[plain, "ideal", 0.0].rudder_rate
    noise_study.draw(study, tmp_path / "picture.png")
    assert (tmp_path / "picture.png").stat().st_size > 10_000
    assert noise_study.markdown(study).count("\n") == 7


def test_the_study_renews_the_page_and_the_picture_that_it_shows(
    short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    monkeypatch.setattr(noise_study, "LEVELS", (0.0,))
    monkeypatch.setattr(noise_study, "GAINS", noise_study.GAINS[:1])
    page = tmp_path / "docs" / "sea.md"
    page.parent.mkdir()
    begin, end = doc_pages.marks(noise_study.PART)
    page.write_text(f"before\n{begin}\nold\n{end}\n", encoding="utf-8")
    asked = ["--study", "noise", "--mission", str(short_mission), "--workers", "1", "--out", tmp_path / "out"]
    assert sea_trials.main([*map(str, asked), "--page", str(page)]) == 0
    picture = page.parent / "images" / "rudder_activity.png"
    assert picture.stat().st_size > 10_000
    assert str(picture) in capsys.readouterr().out.replace("\n", "")
    assert (tmp_path / "out" / "rudder_activity.json").is_file()
    assert "old" not in page.read_text(encoding="utf-8")


def test_a_seed_without_a_sea_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="--seed: found no sea"):
        mission_plan.make(Options(seed=3), tmp_path)


def test_the_seas_own_current_counts_in_the_check(tmp_path: Path) -> None:
    strong = tmp_path / "strong.yaml"
    strong.write_text("name: strong\ncurrent: {mean: [2.0, 0.0]}\n", encoding="utf-8")
    with pytest.raises(ConfigurationError, match=r"a current of 2\.50 m/s"):
        mission_plan.make(Options(sea=str(strong), current=(0.5, 0.0)), tmp_path)


def test_a_vehicle_that_dives_keeps_its_depth_in_the_rough_sea() -> None:
    """One of the seeds of docs/sea.md, in full."""
    trial = sea_trials_session.fly(
        sea_trials_session.TrialJob("paper_ramps", "remus100_6dof", "rough", "rough", 3)
    )
    assert trial.completed
    assert trial.largest_depth_error <= 0.5
    assert trial.largest_distance <= 2.5
    assert 0.5 < trial.planes_travel < 2.0
