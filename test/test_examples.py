"""Every program in examples/ runs, is short, and prints what a reader may expect."""

from __future__ import annotations

import math
import re
import runpy
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64

from conftest import SHORT_MISSION
from doc_pages import ROOT
from node_bench import Bench

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


def printed(name: str, capsys: pytest.CaptureFixture[str]) -> str:
    """Run an example in this process; return its output."""
    runpy.run_path(str(ROOT / "examples" / name), run_name="__main__")
    return capsys.readouterr().out


def numbers(pattern: str, text: str) -> list[float]:
    return [float(found) for found in re.findall(pattern, text)]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_an_example_is_short_and_listed(path: Path) -> None:
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
    assert len(lines) <= 40
    assert f"(../examples/{path.name})" in (ROOT / "docs" / "python.md").read_text(encoding="utf-8")


def test_there_are_ten() -> None:
    assert len(EXAMPLES) == 10


def test_the_closed_loop_flies_what_the_launcher_flies(capsys: pytest.CaptureFixture[str]) -> None:
    duration, distance = numbers(r"[\d.]+(?= s,| m off)", printed("fly_closed_loop.py", capsys))
    assert 600.0 < duration < 700.0 and distance < 1.0


def test_a_path_made_in_code_is_smooth(capsys: pytest.CaptureFixture[str]) -> None:
    out = printed("make_path.py", capsys)
    assert "6 subpaths" in out and "G0" not in out
    assert numbers(r"curvature ([\d.]+)", out) == [0.05]  # a radius of 20 m


def test_a_survey_is_flown(capsys: pytest.CaptureFixture[str]) -> None:
    out = printed("survey_polygon.py", capsys)
    assert "4 legs" in out and numbers(r"flown ([\d.]+)", out)[0] > 90.0


def test_a_law_of_ones_own_comes_to_the_line(capsys: pytest.CaptureFixture[str]) -> None:
    """In a current across the line it keeps Delta tan(asin(Vc / U)): 8 m, 0.1 m/s, some 1.9 m/s."""
    (left,) = numbers(r"ignores: ([\d.]+) m", printed("own_law.py", capsys))
    assert left == pytest.approx(8.0 * math.tan(math.asin(0.1 / 2.0)), abs=0.05)


def test_controllers_are_compared(capsys: pytest.CaptureFixture[str]) -> None:
    out = printed("compare_controllers.py", capsys)
    assert {row.split()[0] for row in out.splitlines()[1:]} == {"nism", "pid", "smc"}


def test_a_hundred_flights_complete(capsys: pytest.CaptureFixture[str]) -> None:
    assert "100 of 100 completed" in printed("many_flights.py", capsys)


def test_a_plan_is_refused_where_the_current_is_too_strong(capsys: pytest.CaptureFixture[str]) -> None:
    assert numbers(r"(\d+) refusals", printed("check_plan.py", capsys)) == [0, 0, 0, 1]


def test_a_look_ahead_distance_is_chosen(capsys: pytest.CaptureFixture[str]) -> None:
    (best,) = numbers(r"best: ([\d.]+) m", printed("tune_lookahead.py", capsys))
    assert 1.5 < best < 8.0


def test_a_bag_is_read(
    tmp_path: Path, domain: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    run = tmp_path / "run"
    words = ["--mission", str(SHORT_MISSION), "--composed", "--quiet", "--out", str(run)]
    subprocess.run([sys.executable, "-m", "auv_sim.cli.mission", *words], check=True, timeout=180)
    monkeypatch.setattr(sys, "argv", ["read_bag.py", str(run)])
    out = printed("read_bag.py", capsys)
    assert "/auv/odom" in out and numbers(r"flown ([\d.]+)", out) == [100.0]


def test_the_minimal_driver_turns_to_port_by_a_positive_rudder(
    spawn: Callable[..., subprocess.Popen[str]], bench: Bench
) -> None:
    path = ROOT / "examples" / "minimal_driver.py"
    driver = spawn([sys.executable, str(path), "--ros-args", "-r", "__ns:=/auv"])
    seen: list[Odometry] = []
    bench.node.create_subscription(Odometry, "odom", seen.append, 10)
    rudder, thrust = (
        bench.node.create_publisher(Float64, f"{name}_cmd", 10) for name in ("rudder", "thrust")
    )

    def turned() -> bool:
        rudder.publish(Float64(data=0.3))
        thrust.publish(Float64(data=6.0))
        if not seen or seen[-1].pose.pose.orientation.z < 0.1:
            return False
        # It moves unless this process has sent no command for 1 s.
        return seen[-1].pose.pose.position.x > 0.0 and seen[-1].twist.twist.linear.x > 0.0

    bench.until(turned)

    def stopped() -> bool:
        thrust.publish(Float64(data=6.0))
        return seen[-1].twist.twist.linear.x == 0.0

    bench.until(stopped)  # no rudder_cmd for 1 s, though thrust_cmd goes on
    driver.terminate()
    _, error = driver.communicate(timeout=180)
    assert (driver.returncode, error) == (0, "")
