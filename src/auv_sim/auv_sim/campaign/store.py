"""A campaign's directory: its files as they were when it began, what has been flown, and the results.

    config/       the study and every file that it names
    chunks/       finished runs, one Parquet file for each chunk; removed when all are in results.parquet
    results.parquet, summary.json, *.png

A file appears under its name when it is complete, so a campaign may be killed at any time.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections.abc import Mapping
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from auv_msgs_py.errors import ConfigurationError
from auv_sim.batch.compiled import laws_digest
from auv_sim.campaign.plan import BUNDLED, StudyPlan
from auv_sim.campaign.table import schema_of
from auv_sim.command_line import make_directory

RESULTS = "results.parquet"
_IDENTITY = "campaign.json"
#: Of results.parquet: fixed, so that the file is the same whatever the chunks were.
_ROW_GROUP = 65536


class Store:
    """One campaign's directory, new or begun before.

    Args:
        directory: where.
        plan: the study; None to take up the one that is there.

    Raises:
        ConfigurationError: the directory holds another campaign, or none where one is needed.
    """

    def __init__(self, directory: Path, plan: StudyPlan | None = None) -> None:
        self.directory = directory
        config = directory / "config"
        if plan is not None and not (directory / _IDENTITY).exists():
            self._begin(plan, config)
        if not (directory / _IDENTITY).is_file():
            raise ConfigurationError(str(directory), "no campaign", "the directory of one")
        begun = json.loads((directory / _IDENTITY).read_text(encoding="utf-8"))
        if plan is not None and fingerprint(bundle_of(plan)) != begun["files"]:
            raise ConfigurationError(
                str(directory), "a campaign of another study or of other files", "a new directory: --out DIR"
            )
        self.same_laws = begun["laws"] == laws_digest()
        self.plan = StudyPlan(config / f"{begun['study']}.yaml")
        self._chunks = directory / "chunks"

    def _begin(self, plan: StudyPlan, config: Path) -> None:
        make_directory(self.directory)
        if any(self.directory.iterdir()):
            raise ConfigurationError(str(self.directory), "a directory with other things in it", "a new one")
        files = bundle_of(plan)
        write_bundle(files, config)
        identity = {"study": plan.source.stem, "files": fingerprint(files), "laws": laws_digest()}
        _write(self.directory / _IDENTITY, json.dumps(identity, indent=2).encode() + b"\n")

    @property
    def finished(self) -> bool:
        """Whether the results are there."""
        return (self.directory / RESULTS).is_file()

    def missing(self, size: int) -> list[range]:
        """The runs that have not been flown, in chunks of at most `size`."""
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
        """Keep a finished chunk."""
        self._chunks.mkdir(exist_ok=True)
        _write_table(table, self._chunk_file(runs), len(runs))

    def finish(self) -> pa.Table:
        """All runs in order, as results.parquet; the chunks are not needed any more."""
        if not self.finished:
            parts = [pq.read_table(self._chunk_file(chunk)) for chunk in self._flown()]
            table = pa.concat_tables([schema_of(self.plan).empty_table(), *parts]).combine_chunks()
            assert table.column("run").to_pylist() == list(range(self.plan.runs)), "runs are missing"
            _write_table(table, self.directory / RESULTS, _ROW_GROUP)
        shutil.rmtree(self._chunks, ignore_errors=True)
        return pq.read_table(self.directory / RESULTS)


def bundle_of(plan: StudyPlan) -> dict[str, bytes]:
    """The study and every file that it names, so that they can be put down anywhere: name -> contents."""
    names: dict[str, dict[str, str]] = {}
    files = {f"{plan.source.stem}.yaml": plan.source.read_bytes()}
    for number, (kind, name, (main, *others)) in enumerate(plan.files()):
        for path in (main, *others):
            files[f"{kind}/{number}/{path.relative_to(main.parent)}"] = path.read_bytes()
        names.setdefault(kind, {})[name] = f"{kind}/{number}/{main.name}"
    files[BUNDLED] = json.dumps(names, indent=2).encode()
    return files


def write_bundle(files: Mapping[str, bytes], directory: Path) -> None:
    """Put a bundle down; its study is there last."""
    for name in sorted(files, key=lambda name: "/" not in name):
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(files[name])


def fingerprint(files: Mapping[str, bytes]) -> str:
    """Names a bundle's contents."""
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(f"{name}\0{len(files[name])}\0".encode() + files[name])
    return digest.hexdigest()


def _write_table(table: pa.Table, path: Path, rows: int) -> None:
    part = path.with_name(path.name + ".part")
    pq.write_table(table, part, compression="zstd", row_group_size=max(rows, 1))
    _settle(part, path)


def _write(path: Path, contents: bytes) -> None:
    part = path.with_name(path.name + ".part")
    part.write_bytes(contents)
    _settle(part, path)


def _settle(part: Path, path: Path) -> None:
    with part.open("rb") as file:
        os.fsync(file.fileno())
    part.replace(path)
