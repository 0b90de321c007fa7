"""A campaign's directory: its files as they were when it began, what has been flown, and the results.

    config/       the study and every file that it names; which campaign this is
    chunks/       finished runs, one Parquet file for each chunk; removed when all are in results.parquet
    results.parquet, summary.json, *.png

A file appears under its name when it is complete, and so does config/ as a whole: a campaign may be killed at
any time. One process at a time works on it.
"""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import json
import os
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.result_files import replacing
from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.command_line import make_directory
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.run_table import schema_of
from auv_sim.studies.campaign.study_files import BUNDLED
from auv_sim.studies.campaign.version import code_digest

RESULTS = "results.parquet"
_CONFIG, _IDENTITY = "config", "campaign.json"
#: What an interrupted start may leave behind.
_LOCK, _SCRATCH = ".lock", ".config.part"
#: Rows of a group in results.parquet: fixed, so that the file does not depend on the chunks.
_ROW_GROUP = 65536


@settings
class _Identity:
    """Which campaign a directory holds."""

    study: str = setting(doc="the study's file, without its ending")
    files: str = setting(doc="fingerprint of the study and all files it names")
    code: str = setting(doc="the version of the code that it was begun with")


class Store:
    """One campaign's directory, new or begun before.

    Args:
        directory: of the campaign.
        plan: the study; None to continue the one that is there.

    Raises:
        ConfigurationError: the directory holds another campaign, or none where one is needed; or it cannot be
            used.
    """

    def __init__(self, directory: Path, plan: StudyPlan | None = None) -> None:
        self.directory = directory.absolute()
        self._chunks = self.directory / "chunks"
        config = self.directory / _CONFIG
        try:
            if plan is not None and not (config / _IDENTITY).exists():
                self._begin(plan)
            if not (config / _IDENTITY).is_file():
                raise ConfigurationError(str(directory), "no campaign", "the directory of one")
        except OSError as error:
            raise self._unusable(error) from None
        begun = yaml_file.load(config / _IDENTITY, _Identity)
        if plan is not None and fingerprint(bundle_of(plan)) != begun.files:
            raise ConfigurationError(
                str(directory), "a campaign of another study or of other files", "a new directory: --out DIR"
            )
        self.same_code = begun.code == code_digest()
        self.plan = StudyPlan(config / f"{begun.study}.yaml")

    def _begin(self, plan: StudyPlan) -> None:
        make_directory(self.directory)
        begun = self.directory / _CONFIG / _IDENTITY
        there = {path.name for path in self.directory.iterdir()} - {_LOCK, _SCRATCH}
        if there and not begun.exists():  # if it exists now, another start was faster
            raise ConfigurationError(str(self.directory), "a directory with other files", "a new one")
        with self.alone():
            if begun.exists():
                return
            scratch = self.directory / _SCRATCH
            shutil.rmtree(scratch, ignore_errors=True)
            files = bundle_of(plan)
            identity = {"study": plan.source.stem, "files": fingerprint(files), "code": code_digest()}
            write_bundle(files | {_IDENTITY: json.dumps(identity, indent=2).encode() + b"\n"}, scratch)
            scratch.rename(self.directory / _CONFIG)

    @contextlib.contextmanager
    def alone(self) -> Iterator[None]:
        """Hold the lock of this campaign: no other process works on it inside.

        Raises:
            ConfigurationError: another process holds it, or the directory cannot be used.
        """
        with contextlib.ExitStack() as opened:
            try:
                lock = opened.enter_context((self.directory / _LOCK).open("a"))
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise ConfigurationError(
                    str(self.directory), "a campaign that is being flown", "another one: --out DIR"
                ) from None
            except OSError as error:
                raise self._unusable(error) from None
            yield

    def _unusable(self, error: OSError) -> ConfigurationError:
        found = f"a place that cannot be used ({error.strerror or error})"
        return ConfigurationError(str(self.directory), found, "a directory that can be written: --out DIR")

    @property
    def finished(self) -> bool:
        """Whether the results are there."""
        return (self.directory / RESULTS).is_file()

    def missing(self, size: int) -> list[range]:
        """Return the runs that have not been flown, in chunks of at most `size`."""
        if self.finished:
            return []
        done = [False] * self.plan.runs
        for chunk in self._flown():
            done[chunk.start : chunk.stop] = [True] * len(chunk)
        chunks: list[range] = []
        run = 0
        while run < len(done):
            if done[run]:
                run += 1
                continue
            end = run
            while end < len(done) and not done[end] and end - run < size:
                end += 1
            chunks.append(range(run, end))
            run = end
        return chunks

    def _flown(self) -> list[range]:
        names = [path.stem.split("-") for path in self._chunks.glob("*-*.parquet")]
        return sorted((range(int(first), int(last) + 1) for first, last in names), key=lambda c: c.start)

    def _chunk_file(self, runs: range) -> Path:
        return self._chunks / f"{runs.start:07d}-{runs.stop - 1:07d}.parquet"

    def keep(self, runs: range, table: pa.Table) -> None:
        """Keep a finished chunk.

        Raises:
            NotWritten: it cannot be written.
        """
        _write_table(table, self._chunk_file(runs), len(runs))

    def finish(self) -> pa.Table:
        """Write all runs in order as results.parquet, remove the chunks, return the table.

        Raises:
            ConfigurationError: a table that is damaged.
            NotWritten: the results cannot be written.
        """
        if not self.finished:
            parts = [_read_table(self._chunk_file(chunk)) for chunk in self._flown()]
            table = pa.concat_tables([schema_of(self.plan).empty_table(), *parts]).combine_chunks()
            assert table.column("run").to_pylist() == list(range(self.plan.runs)), "runs are missing"
            _write_table(table, self.directory / RESULTS, _ROW_GROUP)
        shutil.rmtree(self._chunks, ignore_errors=True)
        return _read_table(self.directory / RESULTS)


def bundle_of(plan: StudyPlan) -> dict[str, bytes]:
    """Return the study and every file that it names, to be written anywhere: name -> contents."""
    names: dict[str, dict[str, str]] = {}
    files = {f"{plan.source.stem}.yaml": plan.source.read_bytes()}
    for number, (kind, name, (main, *others)) in enumerate(plan.files.named()):
        for path in (main, *others):
            files[f"{kind}/{number}/{path.relative_to(main.parent)}"] = path.read_bytes()
        names.setdefault(kind, {})[name] = f"{kind}/{number}/{main.name}"
    files[BUNDLED] = json.dumps(names, indent=2).encode()
    return files


def write_bundle(files: Mapping[str, bytes], directory: Path) -> None:
    """Write a bundle."""
    for name, contents in files.items():
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("wb") as file:
            file.write(contents)
            file.flush()
            os.fsync(file.fileno())


def fingerprint(files: Mapping[str, bytes]) -> str:
    """Return a name for a bundle's contents."""
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(f"{name}\0{len(files[name])}\0".encode() + files[name])
    return digest.hexdigest()


def _write_table(table: pa.Table, path: Path, rows: int) -> None:
    with replacing(path) as part:
        path.parent.mkdir(exist_ok=True)
        pq.write_table(table, part, compression="zstd", row_group_size=max(rows, 1))


def _read_table(path: Path) -> pa.Table:
    try:
        return pq.read_table(path)
    except (pa.ArrowException, OSError) as error:
        reason = str(error).splitlines()[0]
        raise ConfigurationError(
            str(path), f"a damaged table ({reason})", "a whole table; remove it to fly its runs again"
        ) from None
