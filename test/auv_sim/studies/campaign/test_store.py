"""A campaign's directory: begun as a whole, worked on by one, and told in one line when it cannot be used."""

from __future__ import annotations

import errno
from collections.abc import Iterator
from pathlib import Path

import pytest

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.values.errors import ConfigurationError, SuiteError
from auv_sim.cli import campaign
from auv_sim.studies.campaign import campaign_replay, runner, store
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.store import RESULTS, Store
from auv_sim.studies.pool import WorkerDied

STUDY = """\
version: 1
name: {name}
description: "more [/bold] about $x_$ it"
runs: 4
time_limit: 20
vary:
  initial.distance: {{disc: 20}}
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    file = tmp_path / "trial.yaml"
    file.write_text(STUDY.format(name="trial"), encoding="utf-8")
    return file


def one_line(capsys: pytest.CaptureFixture[str]) -> str:
    captured = capsys.readouterr()
    assert captured.out == "" and len(captured.err.strip().splitlines()) == 1
    return captured.err


def full(*_: object, **__: object) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


def test_a_start_that_did_not_come_far_is_made_good(study: Path, tmp_path: Path, monkeypatch) -> None:
    plan, out = StudyPlan(study), tmp_path / "out"
    written = store.write_bundle

    def killed(files: dict[str, bytes], directory: Path) -> None:
        written(dict(list(files.items())[:1]), directory)
        raise KeyboardInterrupt

    monkeypatch.setattr(store, "write_bundle", killed)
    with pytest.raises(KeyboardInterrupt):
        Store(out, plan)
    monkeypatch.setattr(store, "write_bundle", full)
    with pytest.raises(ConfigurationError, match=r"out: found a place that cannot be used \(No space left"):
        Store(out, plan)
    monkeypatch.setattr(store, "write_bundle", written)
    assert Store(out, plan).missing(9) == [range(4)]
    assert Store(out).plan.study == plan.study


def test_what_cannot_be_written_is_told(study: Path, tmp_path: Path, monkeypatch) -> None:
    begun = Store(tmp_path / "out", StudyPlan(study))
    table = runner.fly_chunk(str(begun.plan.source), 0, 2)
    begun.keep(range(2), table)
    monkeypatch.setattr(store.pq, "write_table", full)
    with pytest.raises(SuiteError, match=r"parquet cannot be written \(No space left on device\)"):
        begun.keep(range(2, 4), table)
    assert begun.missing(9) == [range(2, 4)]


def test_one_at_a_time(study: Path, tmp_path: Path, capsys) -> None:
    begun = Store(tmp_path / "out", StudyPlan(study))
    command = [str(study), "--out", str(tmp_path / "out"), "--workers", "1", "--quiet"]
    with begun.alone():
        assert campaign.main(command) == 2
    assert "out: found a campaign that is being flown, expected another one: --out DIR" in one_line(capsys)
    assert campaign.main(command) == 0


@pytest.mark.parametrize("place", ["letter.txt", "letter.txt/below", "/proc/nope"])
def test_places_that_cannot_hold_a_campaign(study: Path, tmp_path: Path, place: str, capsys) -> None:
    (tmp_path / "letter.txt").write_text("dear", encoding="utf-8")
    assert campaign.main([str(study), "--out", str(tmp_path / place)]) == 2
    line = one_line(capsys)
    assert line.startswith("--out: found ") and f"{place} (" in line


@pytest.mark.parametrize("damage", ["", "{", "[]", "{}", '{"study": 3, "files": "a", "code": "b"}', "\udcff"])
def test_a_damaged_campaign_is_told(study: Path, tmp_path: Path, damage: str, capsys) -> None:
    Store(tmp_path / "out", StudyPlan(study))
    (tmp_path / "out" / "config" / "campaign.json").write_text(damage, "utf-8", errors="surrogateescape")
    for arguments in ([str(study), "--out", str(tmp_path / "out")], [str(tmp_path / "out")]):
        assert campaign.main(arguments) == 2
        assert "campaign.json: " in one_line(capsys)


def test_damaged_files_are_told(study: Path, tmp_path: Path, capsys) -> None:
    out = tmp_path / "out"
    assert campaign.main([str(study), "--out", str(out), "--workers", "1", "--quiet"]) == 0
    (out / RESULTS).write_bytes(b"PAR1 no more")
    assert campaign.main([str(out), "--quiet"]) == 2
    assert f"{RESULTS}: found a damaged table (" in one_line(capsys)
    (out / "config" / "files.json").write_text("{", encoding="utf-8")
    assert campaign.main([str(out), "--quiet"]) == 2
    assert "files.json: line " in one_line(capsys)


def test_a_worker_that_dies_costs_nothing_flown(study: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    def dying(work: object, chunks: list[range], workers: int) -> Iterator[tuple[int, object]]:
        yield 0, work(chunks[0])  # type: ignore[operator]
        raise WorkerDied("a worker process died: killed, or out of memory")

    command = [str(study), "--out", str(tmp_path / "out"), "--chunk", "2", "--workers", "1", "--quiet"]
    with monkeypatch.context() as patched:
        patched.setattr(runner, "each", dying)
        assert campaign.main(command) == 1
    line = one_line(capsys)
    assert "campaign failed: a worker process died" in line and "Go on:  python3 scripts/campaign.py" in line
    assert Store(tmp_path / "out").missing(2) == [range(2, 4)]
    assert campaign.main(command) == 0


def test_names_are_not_markup(study: Path, tmp_path: Path, capsys) -> None:
    study.write_text(STUDY.format(name='"leg [/m] $x_$"'), encoding="utf-8")
    out = tmp_path / "a [/b]"
    assert campaign.main([str(study), "--out", str(out), "--workers", "1"]) == 0
    told = capsys.readouterr().out
    assert "leg [/m] $x_$: 4 flights" in told and "more [/bold] about" in told and f"{out}/{RESULTS}" in told
    assert campaign.main([str(out), "--replay-run", "1"]) == 1  # 20 s do not reach the path's end
    assert "leg [/m] $x_$, run 1" in capsys.readouterr().out


def test_a_relative_directory_makes_files_for_anywhere(study: Path, tmp_path: Path, monkeypatch) -> None:
    study.write_text(STUDY.format(name="trial\nsea: rough"), encoding="utf-8")
    Store(tmp_path / "out", StudyPlan(study))
    monkeypatch.chdir(tmp_path)
    begun = Store(Path("out"))
    campaign_replay.write_files(begun.plan, 0, begun.directory / "runs" / "config")
    parameters = yaml_file.parse(tmp_path / "out" / "runs" / "config" / "params.yaml")
    sea = Path(parameters["/**/remus_plant"]["ros__parameters"]["sea"])
    assert sea.is_absolute() and sea.is_file()
