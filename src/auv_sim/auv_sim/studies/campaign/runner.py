"""Flies a campaign's chunks: on the cores of this machine, or through Dask on others."""

from __future__ import annotations

import functools
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import pyarrow as pa

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.flight.batch import engine
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.run_table import table_of
from auv_sim.studies.campaign.store import Store, bundle_of, fingerprint, write_bundle
from auv_sim.studies.pool import WorkerDied, each

#: A chunk, or the three parts of the error that ended it: an exception of ours does not survive pickling.
Result: TypeAlias = "pa.Table | tuple[str, str, str]"


def fly_chunk(source: str, first: int, end: int) -> Result:
    """Fly runs `first` to `end - 1` of the study in a file."""
    try:
        plan = _plan(source)
        runs = range(first, end)
        scenarios = [plan.scenario(run) for run in runs]
        flights = engine.fly(scenarios)
        return table_of(plan, runs, flights, [scenario.path.n for scenario in scenarios])
    except ConfigurationError as error:
        return error.where, error.found, error.expected


def fly_bundled(files: Mapping[str, bytes], study: str, first: int, end: int) -> Result:
    """Fly runs `first` to `end - 1` on a machine that has none of the files."""
    return fly_chunk(_unpacked(fingerprint(files), study, files), first, end)


@functools.cache
def _plan(source: str) -> StudyPlan:
    return StudyPlan(Path(source))


_directories: dict[str, tempfile.TemporaryDirectory[str]] = {}


def _unpacked(name: str, study: str, files: Mapping[str, bytes]) -> str:
    """Write the files once in each process; they are removed when it ends. Return the study's path."""
    if name not in _directories:
        _directories[name] = tempfile.TemporaryDirectory(prefix="auv_campaign_")
        write_bundle(files, Path(_directories[name].name))
    return str(Path(_directories[name].name) / f"{study}.yaml")


def on_this_machine(store: Store, chunks: list[range], workers: int) -> Iterator[tuple[range, pa.Table]]:
    """Yield every chunk with its table, as they are finished.

    Raises:
        ConfigurationError: a run whose values do not go together.
        WorkerDied: a process of the pool has ended.
    """
    for index, result in each(functools.partial(_fly, str(store.plan.source)), chunks, workers):
        yield chunks[index], _table(result)


def _fly(source: str, runs: range) -> Result:
    return fly_chunk(source, runs.start, runs.stop)


def through_dask(
    store: Store, chunks: list[range], workers: int, scheduler: str
) -> Iterator[tuple[range, pa.Table]]:
    """Yield every chunk with its table, as they are finished.

    Args:
        store: the campaign.
        chunks: what to fly.
        workers: processes of a cluster on this machine, if there is no scheduler.
        scheduler: its address; empty for a cluster on this machine.

    Raises:
        ConfigurationError: no Dask, no answer of the scheduler, or a run whose values do not go together.
        WorkerDied: a chunk ended several workers, one after the other.
    """
    distributed = _dask()
    cluster: Any = scheduler or distributed.LocalCluster(
        n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
    )
    try:
        client = distributed.Client(cluster, timeout=20)
    except (OSError, ValueError) as error:
        raise ConfigurationError("--dask", f"{scheduler} ({error})", "a scheduler that answers") from None
    with client:
        files = client.scatter(bundle_of(store.plan), broadcast=True)
        study = store.plan.source.stem
        futures = {
            client.submit(fly_bundled, files, study, chunk.start, chunk.stop, pure=False): chunk
            for chunk in chunks
        }
        try:
            for future in distributed.as_completed(list(futures)):
                yield futures[future], _table(future.result())
        except distributed.KilledWorker:
            raise WorkerDied("workers died again and again: killed, or out of memory") from None
    if not scheduler:
        cluster.close()


def _dask() -> Any:
    """Return Dask's module, whose functions have no types."""
    try:
        import distributed
    except ImportError:
        raise ConfigurationError("--dask", "no Dask", "pip install -r requirements/cluster.txt") from None
    return distributed


def _table(result: Result) -> pa.Table:
    if isinstance(result, tuple):
        raise ConfigurationError(*result)
    return result
