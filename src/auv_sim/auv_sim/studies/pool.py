"""Processes that share out work, and are gone when whoever started them is, or with his Ctrl-C."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import resource_tracker
from typing import Any, TypeVar

from rich.progress import Progress

from auv_msgs_py.values.errors import SuiteError

T = TypeVar("T")


class WorkerDied(SuiteError):
    """A process that shared in the work is gone."""


class _Pool(ProcessPoolExecutor):
    """A terminal sends Ctrl-C to the workers too: it waits until they can take it without a traceback."""

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        # Whoever is missing is started in here, and inherits what is blocked; what comes meanwhile is kept.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            return super().submit(fn, *args, **kwargs)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def worker_pool(workers: int) -> ProcessPoolExecutor:
    """So many processes. Spawned, not forked: whoever calls may have threads."""
    resource_tracker.ensure_running()  # its start, which would come with the first worker's, unblocks SIGINT
    return _Pool(workers, mp_context=multiprocessing.get_context("spawn"), initializer=_end_with_parent)


def each(
    work: Callable[[Any], T], items: Sequence[Any], workers: int, done: Callable[[], None] = lambda: None
) -> Iterator[tuple[int, T]]:
    """`work` on every item in a pool of processes; (index, result) as they come.

    Args:
        work: a function of a module, or a `functools.partial` of one.
        items: what to work on.
        workers: processes; 1 works here.
        done: called after each.

    Raises:
        WorkerDied: killed, or out of memory; what has come until then counts.
    """
    if workers <= 1:
        for index, item in enumerate(items):
            yield index, work(item)
            done()
        return
    with worker_pool(workers) as pool:
        try:
            futures = {pool.submit(work, item): index for index, item in enumerate(items)}
            for future in as_completed(futures):
                yield futures[future], future.result()
                done()
        except BrokenProcessPool:
            raise WorkerDied("a worker process died: killed, or out of memory") from None
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def tracked(
    bar: Progress, workers: int, what: str, work: Callable[[Any], T], items: Sequence[Any]
) -> list[T]:
    """`work` on each item, with a bar; results in the order of the items."""
    task = bar.add_task(what, total=len(items))
    found = dict(each(work, items, workers, lambda: bar.advance(task)))
    return [found[index] for index in range(len(items))]


def _end_with_parent() -> None:
    """A worker whose parent was killed would wait for work for ever; Ctrl-C ends it as any other program."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
