"""The benchmark as a command, small; nothing asserts how long anything takes."""

from __future__ import annotations

import dataclasses
import json
import math
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_sim.checks.benchmark import against, console_cost, contender, figures_page, sheets
from auv_sim.checks.benchmark.measures import dimensions, graph_speed, law_speed, operation, start_up
from auv_sim.checks.benchmark.measures.children import BenchmarkFailed
from auv_sim.checks.benchmark.measures.rig import LockstepTiming, Setup, free_running, lockstep
from auv_sim.checks.benchmark.measures.stopwatch import BLOCK
from auv_sim.checks.benchmark.scale import QUICK
from auv_sim.checks.benchmark.usage import MemoryUse, Usage
from auv_sim.cli.benchmark import main
from auv_sim.views import doc_pages
from conftest import children_of

NODES = {topics.PLANT, topics.OBSERVER, topics.GUIDANCE, topics.AUTOPILOT}


@pytest.mark.parametrize(
    "setup", [Setup(floor=True, recorded=True, steps=300), Setup(composed=True, steps=300)]
)
def test_a_lockstep_run_is_timed_step_by_step(setup: Setup) -> None:
    timing = lockstep(setup)
    assert len(timing.blocks) == setup.steps // BLOCK
    assert all(block > 0.0 for block in timing.blocks)
    assert set(timing.usage) == ({"composed"} if setup.composed else NODES | {topics.RECORDER})
    assert all(used.cpu > 0.0 for used in timing.usage.values())
    assert all(0 < occupied.pss <= occupied.rss for occupied in timing.memory.values())


def test_the_fleet_s_table_has_the_ratio_of_a_vehicle_s_cost() -> None:
    run = {"1": {"cpu_us": 400.0, "cpu_by_process_us": {"composed": 400.0}},
           "4": {"cpu_us": 480.0, "cpu_by_process_us": {"fleet_clock": 20.0, "composed": 460.0}}}  # fmt: skip
    ratio, kinds = sheets.sheets({"fleet": {"separate": run, "composed": run}})
    assert [row[1] for row in ratio.rows] == ["1.20", "1.20"]
    assert ("fleet_clock", "-", "20") in kinds.rows


def test_every_odometry_is_answered_against_the_wall_clock() -> None:
    for _ in range(3):  # a node that is paused for the whole second answers nothing
        report = free_running(20.0, 1.0).report
        assert len(report["sent"]) == 22  # the first and the last odometry, and a second in between
        assert len(report["latencies"]) + report["missed"] >= 20
        if report["latencies"]:
            break
    assert min(report["latencies"]) > 0.0


def test_a_section_as_table_and_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "figures.json"
    assert main(["--quick", "--only", "subpaths", "--json", str(file)]) == 0
    figures = json.loads(file.read_text())
    assert figures["machine"]["cores"]
    assert set(figures["subpaths"]["step_us"]) == {"10", "100"}
    shown = capsys.readouterr().out
    assert "Guidance, by number of subpaths" in shown
    assert "benchmark.py --write-docs" in shown


def test_one_vehicle_and_many_are_counted_in_vehicle_steps() -> None:
    ticks: list[str] = []
    scale = dataclasses.replace(QUICK, vehicles=(3,), flight=0.5)
    assert law_speed.closed_loop_figures(scale, ticks.append)["vehicle_steps_per_second"] > 0.0
    batch = law_speed.batch_figures(scale, ticks.append)
    assert batch["vehicle_steps_per_second"]["3"] > 0.0
    assert batch["fixed_us"]["3"] >= 0.0
    assert ticks == ["closed loop", "batch, 3 vehicles"]


def test_without_numba_few_vehicles_are_flown_and_the_table_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(law_speed, "COMPILED", False)
    scale = dataclasses.replace(QUICK, vehicles=(2, 10_000), flight=0.5)
    batch = law_speed.batch_figures(scale, lambda _: None)
    assert batch["compiled"] is False and list(batch["vehicle_steps_per_second"]) == ["2"]
    closed_loop = {"vehicle_steps_per_second": 1e4}
    (sheet,) = sheets.sheets({"simulation": {"closed_loop": closed_loop, "batch": batch}})
    assert [row[0] for row in sheet.rows] == ["closed_loop, one vehicle", "batch, not compiled, 2 vehicles"]


def test_the_command_brings_numba_and_the_console() -> None:
    script = Path(__file__).parents[4] / "scripts" / "benchmark.py"
    assert 'ensure_environment(extra=("batch", "console"))' in script.read_text(encoding="utf-8")


def test_the_suite_is_compared_with_its_own_floor(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A suite that takes one and a half times its floor, a plain floor twice as slow as the other."""

    def timed(setup: Setup) -> LockstepTiming:
        step = 400e-6 * (2.0 if setup.plain else 1.0 if setup.floor else 1.5)
        names = ["composed"] if setup.composed else sorted(NODES)
        names += [topics.RECORDER] * (setup.recorded and not setup.composed)
        usage, memory = Usage(1e-4, 4.0), MemoryUse(2**26, 2**25)
        return LockstepTiming((step, step), dict.fromkeys(names, usage), dict.fromkeys(names, memory))

    monkeypatch.setattr(graph_speed, "lockstep", timed)
    assert main(["--quick", "--only", "lockstep"]) == 0
    rows = [[cell.strip() for cell in line.split("│")[1:-1]] for line in capsys.readouterr().out.splitlines()]
    assert ["the mission", "1.50", "600", "400", "16.0", "83"] in rows
    assert ["the mission with its recorder", "1.50", "600", "500", "20.0", "83"] in rows
    assert ["plain rclpy nodes, empty callbacks", "2.00", "800", "400", "16.0", "62"] in rows
    assert ["all", "500", "320", "160"] in rows


def test_three_dimensions_are_compared_with_the_plane(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A dive that takes 1.2 times the planar step; engines that fly, however fast."""

    def timed(setup: Setup) -> LockstepTiming:
        step = (200e-6 if setup.composed else 800e-6) * (1.2 if setup.dives else 1.0)
        return LockstepTiming((step, step), {"all": Usage(step, 1.0)}, {})

    monkeypatch.setattr(dimensions, "lockstep", timed)
    monkeypatch.setattr(
        dimensions, "engine", SimpleNamespace(fly=lambda _: SimpleNamespace(steps=np.ones(1)))
    )
    assert main(["--quick", "--only", "dimensions"]) == 0
    rows = [[cell.strip() for cell in line.split("│")[1:-1]] for line in capsys.readouterr().out.splitlines()]
    assert ["one process for each node", "1.20", "800", "960", "800", "960"] in rows
    assert ["all nodes in one process", "1.20", "200", "240", "200", "240"] in rows
    assert {"in the plane", "in three dimensions"} <= {row[0] for row in rows if row}


def test_aborts_are_timed_from_the_call_to_the_stop(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without nodes: the middle and the largest of the times are shown."""
    monkeypatch.setattr(operation, "start_nodes", lambda *_: {"ailos_guidance"})
    monkeypatch.setattr(operation, "_aborts", lambda *_: [0.010, 0.090, 0.030])
    assert main(["--quick", "--only", "operation"]) == 0
    rows = [[cell.strip() for cell in line.split("│")[1:-1]] for line in capsys.readouterr().out.splitlines()]
    assert ["3", "30.0", "90.0"] in rows


def test_the_console_is_measured_with_a_browser(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without a mission: the console is started, and what was measured is shown."""
    figures = {"cpu_percent": 2.54, "rss": 120 * 2**20, "aborts": 3, "p50_ms": 39.31, "largest_ms": 94.0}

    async def measured(children: Any, names: set[str], _: Any) -> dict[str, Any]:
        assert names == {"ailos_guidance"}
        assert set(children.ids) == {"console"}
        return figures

    monkeypatch.setattr(console_cost, "start_nodes", lambda *_: {"ailos_guidance"})
    monkeypatch.setattr(console_cost, "_measured", measured)
    assert main(["--quick", "--only", "console"]) == 0
    line = next(line for line in capsys.readouterr().out.splitlines() if "39.3" in line)
    assert [part.strip() for part in line.strip("│ ").split("│")] == ["2.5", "120", "3", "39.3", "94.0"]


def test_what_a_flight_takes_once_is_told_apart_from_its_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """An engine that takes 70 us a flight and 2 us a step, on a clock that only it moves."""
    now = [0.0]

    def fly(scenarios: list[Any], _: int = 1) -> Any:
        steps = np.array([int(scenario.time_limit / scenario.step) + 1 for scenario in scenarios])
        now[0] += 70e-6 * len(scenarios) + 2e-6 * steps.sum()
        return SimpleNamespace(steps=steps)

    monkeypatch.setattr(law_speed, "engine", SimpleNamespace(fly=fly))
    monkeypatch.setattr(law_speed, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    batch = law_speed.batch_figures(dataclasses.replace(QUICK, vehicles=(1, 10)), lambda _: None)
    for number in ("1", "10"):
        assert batch["fixed_us"][number] == pytest.approx(70.0)
        assert batch["step_us"][number] == pytest.approx(2.0)
        assert batch["vehicle_steps_per_second"][number] == pytest.approx(41 / (70e-6 + 41 * 2e-6))


def test_two_checkouts_fly_in_turns() -> None:
    one = against.Contender(sys.executable, "closed_loop", "-", 2, 0.5, 1)
    other = against.Contender(sys.executable, "batch", "-", 2, 0.5, 1)
    try:
        for side in (one, other):
            side.fly(counts=False)
            side.fly()
            assert len(side.times) == 1 and side.times[0] > 0.0
    finally:
        one.close()
        other.close()


def test_another_checkout_may_have_former_names() -> None:
    assert contender.first_of("no_such_module", "math") is math
    with pytest.raises(ModuleNotFoundError, match="nor_this"):
        contender.first_of("no_such_module", "nor_this")
    assert start_up.launcher_of("/bin/true") == "auv_sim.cli.mission"
    with pytest.raises(BenchmarkFailed, match="/bin/false has no launcher"):
        start_up.launcher_of("/bin/false")


def test_a_checkout_without_an_environment_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--against", str(tmp_path)]) == 2
    assert f"--against: found {tmp_path}, which has no .venv/py3" in capsys.readouterr().err


def test_a_missions_start_is_timed_by_its_recording() -> None:
    assert start_up.first_command(composed=True) > 0.0


def figures() -> dict[str, object]:
    """Every section, with made-up figures."""
    kinds = ("plain floor", "floor", "suite", "floor, recorded", "suite, recorded")
    run = {"step_us": 1000.0, "cpu_us": 2000.0, "switches": 20.0, "cpu_by_process_us": {"recorder": 400.0}}
    at = {"p50_ms": 1.0, "p99_ms": 2.0, "p99.9_ms": 3.0, "largest_ms": 4.0, "jitter_ms": 0.5, "missed": 1,
          "cycles": 100, "cpu_percent": {"recorder": 4.0}}  # fmt: skip
    return {
        "machine": {"processor": "abacus"},
        "load": 0.0,
        "lockstep": {
            "separate": dict.fromkeys(kinds, run) | {"plain floor": run | {"step_us": 2500.0}},
            "composed": dict.fromkeys(kinds, run),
            "memory": {"recorder": {"rss": 2**26, "pss": 2**25}},
        },
        "dimensions": {
            "compiled": True,
            **{place: dict.fromkeys(("planar", "dives"), run) for place in ("separate", "composed")},
            "engine": {
                "planar": {"closed_loop": 80.0, "batch": 1.0}, "dives": {"closed_loop": 110.0, "batch": 1.5},
            },
        },
        "latency": {"20": at, "50": at},
        "simulation": {
            "closed_loop": {"vehicle_steps_per_second": 2e4},
            "batch": {
                "vehicle_steps_per_second": {"1": 1e6, "10000": 2e6}, "step_us": {"1": 0.9, "10000": 0.4},
                "fixed_us": {"1": 40.0, "10000": 39.96}, "threads": 2, "compiled": True,
            },
        },
        "start_up": {"seconds": 2.5},
        "subpaths": {"step_us": {"10": 20.0, "10000": 21.0}},
        "recording": {"rate_hz": 50.0, "cpu_percent": {"1": 2.0, "100": 20.0}},
        "against": {
            "closed_loop": 0.72, "batch": 104.2, "batch_at_sea": 25.14, "first_command": 0.4, "recorded": 1.1,
            "first_command_composed": 0.41, "recorded_composed": 1.3, "vehicles": 100_000,
        },
    }  # fmt: skip


def test_the_page_is_renewed_between_its_marks(tmp_path: Path) -> None:
    file = tmp_path / "performance.md"
    begin, end = doc_pages.marks(figures_page.PART)
    file.write_text(f"before\n{begin}\nold\n{end}\nafter\n")
    found = sheets.sheets(figures())
    figures_page.renew(file, tmp_path / "images", figures(), found)
    text = file.read_text()
    assert text.startswith("before\n")
    assert text.endswith("\nafter\n")
    assert "old" not in text
    assert "abacus" in text
    assert "| plain rclpy nodes, empty callbacks | 2.50 | 2500 |" in text
    assert "| in three dimensions | 73 | 110.0 | 1.50 |" in text
    assert "| batch, 10,000 vehicles | 100.0 | 2,000,000 | 0.500 | 0.400 | 40.0 |" in text
    assert "| batch, 100,000 vehicles, all cores: times the other's closed_loop | 104 |" in text
    assert (tmp_path / "images" / figures_page.PICTURE).stat().st_size > 10_000


def test_a_page_without_a_place_is_refused_before_anything_is_measured(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "page.md").write_text("nothing here\n")
    assert main(["--write-docs", "--page", str(tmp_path / "page.md")]) == 2
    assert "a page with <!-- figures: begin -->" in capsys.readouterr().err


def test_ctrl_c_leaves_nothing_behind(
    spawn: Callable[..., subprocess.Popen[str]], command_line: Callable[..., list[str]]
) -> None:
    process = spawn(command_line("auv_sim.cli.benchmark", "--quick", "--only", "lockstep"))
    while not (nodes := children_of(process.pid)) and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=180)
    assert process.returncode == 130
    assert error.strip() == "interrupted; nothing was written"
    assert not any(Path(f"/proc/{pid}").exists() for pid in nodes)
