"""scripts/plan.py: what it says, what it refuses, and with which exit code."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from auv_path_following import config_files
from auv_path_following.missions import mission_file
from auv_sim.cli import mission as mission_cli
from auv_sim.cli import plan as plan_command

ROOT = Path(__file__).resolve().parents[3]
#: Each begins with a line `# says: ...`: part of the one line that has to come.
WRONG = sorted((Path(__file__).parent / "wrong_missions").glob("*.yaml"))


def _says(path: Path) -> str:
    return path.read_text(encoding="utf-8").splitlines()[0].removeprefix("# says: ")


def test_there_are_thirty_different_mistakes():
    assert len(WRONG) >= 30
    assert len({_says(path) for path in WRONG}) == len(WRONG)


@pytest.mark.parametrize("path", WRONG, ids=lambda path: path.stem)
def test_a_wrong_mission_gets_one_helpful_line_and_exit_code_2(path, capsys):
    assert plan_command.main([str(path), "--quiet"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1 and err.endswith("\n")
    assert path.stem.split("_")[0] in err or "nowhere.kml" in err
    assert _says(path) in err


@pytest.mark.parametrize("path", [WRONG[4], WRONG[19]], ids=lambda path: path.stem)
def test_so_does_the_command(path, tmp_path):
    places = os.pathsep.join(
        str(ROOT / "src" / name) for name in ("auv_msgs_py", "auv_path_following", "auv_sim")
    )
    command = "from auv_sim.cli.plan import main; raise SystemExit(main())"
    done = subprocess.run(
        [sys.executable, "-c", command, path],
        capture_output=True, text=True, check=False, cwd=tmp_path, env={**os.environ, "PYTHONPATH": places},
    )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert _says(path) in done.stderr


def test_the_joints_of_a_long_survey_are_counted_and_leave_the_verdict_in_sight(
    tmp_path, capsys, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    assert plan_command.main(["survey_wgs84"]) == 0
    out = capsys.readouterr().out
    assert "  joints    36 G1, largest gap 0.000 mm" in out and "no fault found" in out
    assert out.count("\n") < 15


@pytest.mark.parametrize("name", config_files.shipped("missions"))
def test_every_shipped_mission_is_flyable(name):
    vehicle = "remus100" if mission_file.load(name).spatial is None else "remus100_6dof"
    assert plan_command.main([name, "--quiet", "--vehicle", vehicle]) == 0


def test_a_mission_is_a_word_or_an_option_of_both_commands(capsys):
    assert plan_command.main(["--mission", "loiter", "--quiet"]) == 0
    for words in (["loiter"], ["--mission", "loiter"], ["loiter", "--mission", "loiter"]):
        assert mission_cli.parser().parse_args(words).mission == "loiter"
    assert mission_cli.parser().parse_args([]).mission == "paper_composite"
    for words in (["loiter", "--mission", "helix"], ["--mission", "helix", "loiter"], []):
        with pytest.raises(SystemExit):
            plan_command.main([*words, "--quiet"])
    assert "found two missions, loiter and helix" in capsys.readouterr().err


def test_each_refusal_is_printed_once(tmp_path, capsys):
    mission = tmp_path / "steep.yaml"
    profile = "depth_profile: {knots: [[0, 60], [80, 102], [400, 60]]}"
    line = "segments: [{line: {start: [0, 0], length: 400, course_deg: 0}}]"
    mission.write_text(f"version: 1\nname: steep\nframe: ned\nthrust: 6.48\n{profile}\n{line}\n")
    asked = [str(mission), "--vehicle", "remus100_6dof", "--out", str(tmp_path / "plan.png")]
    assert plan_command.main(asked) == 2
    out, err = capsys.readouterr()
    assert "steepest slope 44.5 deg" in out and "refused" not in out and "no fault" not in out
    assert err.count("\n") == 2
    assert err.count("a depth of 102.00 m") == err.count("a slope of 44.5 deg") == 1
    assert plan_command.main([*asked[:3], "--quiet"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_it_tells_draws_and_exports(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert plan_command.main(["survey_wgs84", "--export", "path.kml", "--current", "0.1", "0.2"]) == 0
    out = capsys.readouterr().out
    assert "duration" in out and "tightest turn 4.21 m" in out
    assert Path("plan-survey_wgs84.png").read_bytes().startswith(b"\x89PNG")
    assert "<kml" in Path("path.kml").read_text(encoding="utf-8")


def test_a_name_is_no_markup(tmp_path, capsys):
    mission = tmp_path / "a [b] c.yaml"
    text = (ROOT / "test" / "data" / "short.yaml").read_text(encoding="utf-8")
    text = text.replace("name: short", "name: leg [/m]").replace("15 m north", "at 2 [m/s]")
    mission.write_text(text, encoding="utf-8")
    assert plan_command.main([str(mission), "--out", str(tmp_path / "[bold].png")]) == 0
    out = capsys.readouterr().out
    assert "leg [/m]: at 2 [m/s]" in out
    assert "[bold].png" in out and "a [b] c.yaml" in out


def test_what_a_waypoint_file_holds_beyond_the_path_gets_a_line_each(tmp_path, capsys):
    rows = ("0\t1\t0\t16\t0\t0\t0\t0\t59.9\t10.6\t0\t1", "1\t0\t3\t16\t60\t0\t0\t0\t59.9\t10.6\t5\t1",
            "2\t0\t3\t16\t0\t0\t0\t0\t59.901\t10.6\t5\t1",
            "3\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1")  # fmt: skip
    (tmp_path / "a.waypoints").write_text("\n".join(["QGC WPL 110", *rows]))
    route = "waypoints: {file: a.waypoints, smoothing: {kind: linear}}\n"
    origin = "origin: {latitude_deg: 59.9, longitude_deg: 10.6}\n"
    (tmp_path / "m.yaml").write_text(f"version: 1\nname: a\nframe: wgs84\nspeed: 1\n{origin}{route}")
    assert plan_command.main([str(tmp_path / "m.yaml"), "--out", str(tmp_path / "plan.png")]) == 0
    lines = [line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines()]
    assert [line[1] for line in lines if line and line[0] == "notice"] == [
        "a.waypoints: hold of 60 s (item 1) not taken",
        "a.waypoints: return to launch (item 3) not taken",
        "a.waypoints: altitudes (5 m) not taken: only those below 0 are depths",
        "a.waypoints: home position (item 0) not taken",
    ]


def _to_fly(capsys):
    (line,) = (line for line in capsys.readouterr().out.splitlines() if line.startswith("Fly it:"))
    words = shlex.split(line.split(":", 1)[1])
    assert words[:2] == ["python3", "scripts/mission.py"]
    return words[2:]


def test_the_printed_command_flies_what_was_checked(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    shutil.copyfile(config_files.find("missions", "loiter"), "my [first] loiter.yaml")
    wanted = {"--vehicle": ["remus100_mismatch"], "--params": ["paper"], "--switching": ["all"]}
    wanted |= {"--current": ["-0.1", "0.2"]}
    asked = [word for option, words in wanted.items() for word in (option, *words)]
    assert plan_command.main(["my [first] loiter.yaml", *asked]) == 0
    told = mission_cli.parser().parse_args(_to_fly(capsys))
    assert (told.mission, told.vehicle, told.params) == (
        "my [first] loiter.yaml", "remus100_mismatch", "paper"
    )  # fmt: skip
    assert (told.switching, told.current) == ("all", [-0.1, 0.2])


def test_the_printed_command_does_not_repeat_defaults(tmp_path, capsys):
    assert plan_command.main(["loiter", "--out", str(tmp_path / "plan.png")]) == 0
    assert _to_fly(capsys) == ["--mission", "loiter"]


def test_the_papers_path_is_flyable_with_its_corner_and_its_crossing(tmp_path, capsys):
    assert plan_command.main(["paper_composite", "--out", str(tmp_path / "plan.png")]) == 0
    out = capsys.readouterr().out
    assert "a corner of 45 deg (G0)" in out and "crosses itself once" in out
    assert [line.split()[-2] for line in out.splitlines() if line[:2].strip().isdigit() and "," in line] == [
        "G0", "G1", "G1", "G2", "G2", "G2",
    ]  # fmt: skip


def test_a_current_too_strong_is_refused(capsys):
    assert plan_command.main(["loiter", "--quiet", "--current", "2.1", "0"]) == 2
    err = capsys.readouterr().err
    assert "a current of 2.10 m/s against a speed of 2.00 m/s" in err and err.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nowhere"], "no such mission file"),
        (["loiter", "--vehicle", "nowhere"], "no such vehicle file"),
        (["loiter", "--export", "path.gpx", "--quiet"], "ends with .geojson or .kml"),
        (["loiter", "--export", "path.kml", "--quiet"], "to place the path on a chart"),
        (["loiter", "--out", "nowhere/plan.png", "--quiet"], "a picture that can be written"),
        (["loiter", "--out", "plan.xyz", "--quiet"], "a picture that can be written"),
    ],
)
def test_wrong_options_get_one_line(arguments, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert plan_command.main(arguments) == 2
    err = capsys.readouterr().err
    assert said in err and err.count("\n") == 1


def test_a_number_that_is_none_ends_with_code_2(capsys):
    with pytest.raises(SystemExit) as caught:
        plan_command.main(["loiter", "--current", "nan", "0"])
    assert caught.value.code == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_upwelling_is_for_a_vehicle_with_stern_planes_and_flown_as_planned(tmp_path, capsys):
    asked = ["--upwelling", "-0.05", "--out", str(tmp_path / "plan.png")]
    assert plan_command.main(["paper_composite", *asked]) == 2
    assert "--upwelling: found vehicle REMUS 100 without stern planes" in capsys.readouterr().err
    assert plan_command.main(["helix", "--vehicle", "remus100_6dof", *asked]) == 0
    (line,) = (line for line in capsys.readouterr().out.splitlines() if line.startswith("Fly it:"))
    same = mission_cli.parser().parse_args(shlex.split(line)[4:])
    assert (same.mission, same.vehicle, same.upwelling) == ("helix", "remus100_6dof", -0.05)
    assert plan_command.main(["helix", "--vehicle", "remus100_6dof", "--quiet", "--upwelling", "1"]) == 2
    assert "deg in 1 m/s of water up" in capsys.readouterr().err
