"""Campaigns flown: the same bytes however they are cut up, taken up again after a kill, run for run."""

from __future__ import annotations

import json
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.cli import campaign
from auv_sim.flight.batch import engine
from auv_sim.studies.campaign import runner
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.evaluation import campaign_pictures
from auv_sim.studies.campaign.evaluation.summary import summarise
from auv_sim.studies.campaign.store import RESULTS, Store

STUDY = """\
version: 1
name: trial
seed: 7
runs: 7
time_limit: 90
vary:
  mission: {choice: [paper_composite, course_fermat]}
  autopilot.nism.k1: {grid: [0.2, 0.4]}
  guidance.switching.mode: {grid: [g0, all]}
  guidance.compensate_current: {choice: [true, false]}
  vehicle.hull.Nuud: {uniform: [0.7, 1.3], factor: true}
  initial.distance: {disc: 20}
  current.speed: {disc: 0.3}
axes: [initial.distance, current.speed]
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    file = tmp_path / "trial.yaml"
    file.write_text(STUDY, encoding="utf-8")
    return file


def flown(study: Path, directory: Path, *options: str) -> bytes:
    assert campaign.main([str(study), "--out", str(directory), "--quiet", *options]) == 0
    return (directory / RESULTS).read_bytes()


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Store:
    """A campaign that was flown in this process."""
    folder = tmp_path_factory.mktemp("campaign")
    (folder / "trial.yaml").write_text(STUDY, encoding="utf-8")
    store = Store(folder / "out", StudyPlan(folder / "trial.yaml"))
    for chunk in store.missing(10):
        store.keep(chunk, runner.fly_chunk(str(store.plan.source), chunk.start, chunk.stop))
    store.finish()
    return store


def test_cores_chunks_and_dask_make_no_difference(finished: Store, study: Path, tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    alone = (finished.directory / RESULTS).read_bytes()
    assert flown(study, tmp_path / "two", "--workers", "2", "--chunk", "5") == alone
    assert flown(study, tmp_path / "dask", "--dask", "--workers", "1", "--chunk", "11") == alone
    summaries = [(tmp_path / name / "summary.json").read_bytes() for name in ("two", "dask")]
    assert summaries[0] == summaries[1]


def test_a_row_is_what_its_scenario_flies(finished: Store) -> None:
    table = pq.read_table(finished.directory / RESULTS)
    assert table.num_rows == finished.plan.runs == 28
    for run in (0, 13, 27):
        row, values = table.slice(run, 1).to_pylist()[0], finished.plan.values(run)
        assert {name: row[name] for name in values} == values
        scenario = finished.plan.scenario(run)
        flights = engine.fly([scenario])
        assert (row["run"], row["rms_distance"]) == (run, flights.rms_distance[0])
        assert len(row["subpath_rms_distance"]) == scenario.path.n


def test_a_summary_counts_what_is_in_the_table(finished: Store) -> None:
    table = pq.read_table(finished.directory / RESULTS)
    summary = summarise(finished.plan, table)
    assert summary.runs == 28 and summary.completed.value == 0.0  # 90 s are too short to arrive
    assert len(summary.points) == 4 and sum(point.runs for point in summary.points) == 28
    worst = table.column("rms_distance").to_numpy()[list(summary.worst)]
    assert worst[0] == np.max(table.column("rms_distance").to_numpy()) and np.all(np.diff(worst) <= 0.0)
    assert json.loads(summary.to_json())["figures"]["rms_distance"]["mean"]["value"] is None


def test_pictures_are_drawn(finished: Store, tmp_path: Path) -> None:
    table = pq.read_table(finished.directory / RESULTS)
    files = campaign_pictures.draw(finished.plan, table, summarise(finished.plan, table), tmp_path)
    assert [file.name for file in files] == ["distribution.png", "success.png", "sensitivity.png"]
    assert all(file.stat().st_size > 10_000 for file in files)


def test_only_what_is_missing_is_flown(finished: Store, tmp_path: Path) -> None:
    store = Store(tmp_path / "again", StudyPlan(finished.plan.source))
    assert store.missing(12) == [range(12), range(12, 24), range(24, 28)]
    source = str(store.plan.source)
    for chunk in (range(12, 24), range(3, 7)):
        store.keep(chunk, runner.fly_chunk(source, chunk.start, chunk.stop))
    # What a kill leaves half written has another name, and counts for nothing.
    (store.directory / "chunks" / "0000000-0000002.parquet.part").write_bytes(b"half")
    taken_up = Store(tmp_path / "again")
    assert taken_up.missing(3) == [range(3), range(7, 10), range(10, 12), range(24, 27), range(27, 28)]
    for chunk in taken_up.missing(3):
        taken_up.keep(chunk, runner.fly_chunk(source, chunk.start, chunk.stop))
    taken_up.finish()
    assert (tmp_path / "again" / RESULTS).read_bytes() == (finished.directory / RESULTS).read_bytes()
    assert not (tmp_path / "again" / "chunks").exists() and taken_up.missing(3) == []


def test_a_campaign_is_not_mixed_with_another(finished: Store, study: Path, tmp_path: Path) -> None:
    study.write_text(STUDY.replace("seed: 7", "seed: 8"), encoding="utf-8")
    with pytest.raises(ConfigurationError, match="a campaign of another study or of other files"):
        Store(finished.directory, StudyPlan(study))
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("dear", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="a directory with other files"):
        Store(tmp_path / "mine", StudyPlan(study))
    with pytest.raises(ConfigurationError, match="found no campaign"):
        Store(tmp_path)


def test_code_that_changed_in_between_is_refused(study: Path, tmp_path: Path, capsys) -> None:
    Store(tmp_path / "old", StudyPlan(study))
    identity = tmp_path / "old" / "config" / "campaign.json"
    begun = json.loads(identity.read_text(encoding="utf-8")) | {"code": "another"}
    identity.write_text(json.dumps(begun), encoding="utf-8")
    assert campaign.main([str(study), "--out", str(tmp_path / "old"), "--quiet"]) == 2
    assert "a campaign begun with another version" in capsys.readouterr().err


#: The command, killed when its fourth chunk was to be written.
KILLED = """
import os, signal, sys
from auv_sim.cli import campaign
from auv_sim.studies.campaign import store
write, written = store._write_table, []
def write_three(*arguments):
    if len(written) == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    written.append(write(*arguments))
store._write_table = write_three
campaign.main(sys.argv[1:])
"""


def test_a_killed_campaign_goes_on(study: Path, tmp_path: Path, command_line) -> None:
    out = tmp_path / "killed"
    words = [str(study), "--out", str(out), "--chunk", "2", "--workers", "2"]
    killed = subprocess.run([sys.executable, "-c", KILLED, *words], capture_output=True, check=False)
    assert killed.returncode == -signal.SIGKILL, killed.stderr
    assert len(list((out / "chunks").glob("*.parquet"))) == 3
    store = Store(out)
    assert sum(map(len, store.missing(50))) == 28 - 2 * 3
    command = command_line("auv_sim.cli.campaign", *words)
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    assert "28/28" in done.stdout and "--replay-run" in done.stdout
    table = pq.read_table(out / RESULTS)
    assert table.column("run").to_pylist() == list(range(28))
    alone = engine.fly([store.plan.scenario(21)])
    assert table.column("rms_distance")[21].as_py() == alone.rms_distance[0]


def test_a_run_is_flown_again(finished: Store, tmp_path: Path, capsys) -> None:
    shutil.copytree(finished.directory, tmp_path / "copy")
    assert campaign.main([str(tmp_path / "copy"), "--replay-run", "13"]) == 1  # 90 s are too short to arrive
    told = capsys.readouterr().out
    assert "end of the path not reached after 90.0 s" in told and "of the path; missed" in told
    assert "vehicle.hull.Nuud" in told and "--graph" in told
    apart = re.search(r"in the campaign: rms distance \S+ m, (\S+) m apart", told)
    assert apart and float(apart[1]) < 1e-9
    assert (tmp_path / "copy" / "runs" / "0000013" / "overview.png").is_file()
    assert campaign.main([str(tmp_path / "copy"), "--replay-run", "28"]) == 2
    assert "--replay-run: found 28, expected a run from 0 to 27" in capsys.readouterr().err


def test_bad_input_gets_one_line(study: Path, capsys) -> None:
    study.write_text(STUDY + "judge: beauty\n", encoding="utf-8")
    for arguments in ([str(study)], ["no_such_study"], [str(study), "--graph"]):
        assert campaign.main(arguments) == 2
        captured = capsys.readouterr()
        assert captured.out == "" and len(captured.err.strip().splitlines()) == 1
