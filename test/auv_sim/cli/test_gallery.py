"""`scripts/gallery.py`: which flights it takes as they are. The launcher is played by a function."""

from __future__ import annotations

import json
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from auv_path_following.missions import mission_file
from auv_sim.cli import gallery
from auv_sim.cli import mission as mission_command
from auv_sim.flight.run_record import Run
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.studies import gallery_session
from auv_sim.views import doc_pages
from conftest import children_of


class Launcher:
    """Leaves behind what the launcher leaves: its configuration, and its figures if it came so far."""

    def __init__(self) -> None:
        self.flown: list[tuple[str, tuple[float, float] | None, str]] = []
        self.outcomes: list[str] = []

    def __call__(self, arguments: list[str]) -> int:
        given = vars(mission_command.parser_of_one().parse_args(arguments))
        given["current"] = tuple(given["current"]) if given["current"] else None
        options = Options(**given)
        assert options.out is not None and not options.out.exists()
        resolved = mission_plan.make(options, options.out.absolute())
        resolved.write(options.out / "config")
        self.flown.append((options.mission, options.current, options.params))
        outcome = self.outcomes.pop(0) if self.outcomes else "complete"
        if outcome == "killed":
            raise KeyboardInterrupt
        figures = {"rms_distance": 0.1, "largest_distance": 0.5, "rudder_travel_per_metre": 0.2}
        record = {"outcome": outcome, **figures}
        (options.out / "summary.json").write_text(json.dumps(record), encoding="utf-8")
        return 0 if outcome == "complete" else 1


@pytest.fixture
def launcher(monkeypatch: pytest.MonkeyPatch) -> Launcher:
    played = Launcher()
    monkeypatch.setattr(gallery_session, "launch", played)
    monkeypatch.setattr(gallery_session, "KINDS", ("linear",))
    path = mission_file.load("course_linear").path
    s = np.linspace(0.0, path.n, 400)
    points = [path.evaluate(min(int(value), path.n - 1), value - min(int(value), path.n - 1)) for value in s]
    columns = {"t": 600.0 * s / path.n, "s": s, "psi": 0.0 * s, "ye": 0.0 * s}
    columns |= {name: np.array([getattr(p, name) for p in points]) for name in ("x", "y")}
    monkeypatch.setattr(gallery_session, "load", lambda _: Run.from_columns(columns))
    return played


@pytest.fixture
def asked(tmp_path: Path) -> list[str]:
    page = tmp_path / "page.md"
    begin, end = doc_pages.marks(gallery_session.PART)
    page.write_text(f"before\n{begin}\nold\n{end}\nbehind\n", encoding="utf-8")
    places = {"--page": page, "--images": tmp_path / "images", "--runs": tmp_path / "runs"}
    return [str(word) for pair in places.items() for word in pair]


BOTH = [("course_linear", None, "robust"), ("course_linear", (0.1, 0.2), "robust")]


def test_what_was_flown_is_drawn_tabled_and_not_flown_again(
    launcher: Launcher, asked: list[str], tmp_path: Path
) -> None:
    for _ in range(2):
        assert gallery.main(asked) == 0
        assert launcher.flown == BOTH
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert text.startswith("before\n") and text.endswith("behind\n") and "old" not in text
    assert "| Piecewise linear | G0 | 1259.7 | 0.100 | 0.50 | 0.20 | 0.100 | 0.50 | 0.20 |" in text
    assert (tmp_path / "images" / "course_linear.png").stat().st_size > 10_000
    assert sorted(path.name for path in (tmp_path / "runs").iterdir()) == ["linear-current", "linear-none"]


@pytest.mark.parametrize("outcome", ["aborted", "killed"])
def test_a_flight_that_did_not_come_to_its_end_is_flown_again(
    launcher: Launcher, asked: list[str], tmp_path: Path, outcome: str, capsys: pytest.CaptureFixture[str]
) -> None:
    launcher.outcomes = ["complete", outcome]
    assert gallery.main(asked) == {"aborted": 1, "killed": 130}[outcome]
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert {"aborted": "linear-current", "killed": "start it again to go on"}[outcome] in told
    assert "old" in (tmp_path / "page.md").read_text(encoding="utf-8")
    assert gallery.main(asked) == 0
    assert launcher.flown == [*BOTH, BOTH[1]]


def test_flights_of_another_configuration_are_not_taken(launcher: Launcher, asked: list[str]) -> None:
    assert gallery.main(asked) == 0
    assert gallery.main([*asked, "--params", "paper"]) == 0
    assert launcher.flown[2:] == [(mission, current, "paper") for mission, current, _ in BOTH]


def test_nor_is_one_whose_summary_says_that_it_was_aborted(
    launcher: Launcher, asked: list[str], tmp_path: Path
) -> None:
    """As an earlier version left them."""
    assert gallery.main(asked) == 0
    summary = tmp_path / "runs" / "linear-none" / "summary.json"
    summary.write_text(summary.read_text().replace("complete", "aborted"), encoding="utf-8")
    assert gallery.main(asked) == 0
    assert launcher.flown == [*BOTH, BOTH[0]]


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (["--params", "nowhere"], "nowhere: found no such parameter file"),
        (["--page", "README.md"], "a page with"),
        (["--pages", "README.md"], "gallery.py: unrecognized arguments: --pages"),
    ],
)
def test_a_mistake_gets_one_line_before_anything_is_flown(
    launcher: Launcher, asked: list[str], wrong: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    try:
        code = gallery.main([*asked, *wrong])
    except SystemExit as leaving:
        code = leaving.code
    assert code == 2
    err = capsys.readouterr().err
    assert told in err and err.count("\n") == 1
    assert not launcher.flown


def test_ctrl_c_ends_the_flight_as_well(
    spawn: Callable[..., subprocess.Popen[str]],
    command_line: Callable[..., list[str]],
    asked: list[str],
    tmp_path: Path,
) -> None:
    process = spawn(command_line("auv_sim.cli.gallery", *asked))
    log = tmp_path / "runs" / "linear-none.part" / "log"
    while not log.is_dir() and process.poll() is None:
        time.sleep(0.05)
    (mission,) = children_of(process.pid)
    nodes = children_of(mission)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=180)
    assert process.returncode == 130
    assert error.splitlines()[-1].startswith("interrupted")
    assert not any(Path(f"/proc/{pid}").exists() for pid in (mission, *nodes))
    assert not (tmp_path / "runs" / "linear-none").exists()
