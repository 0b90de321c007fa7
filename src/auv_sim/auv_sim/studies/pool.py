"""Worker pool that ends with its parent process or on Ctrl-C."""

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
    """A worker process has ended."""


class _Pool(ProcessPoolExecutor):
    """Blocks Ctrl-C, which a terminal also sends to the workers, until they can end without a traceback."""

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        # Missing workers are started in here and inherit the blocked signals; a signal meanwhile is kept.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            return super().submit(fn, *args, **kwargs)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def worker_pool(workers: int) -> ProcessPoolExecutor:
    """Return a pool of `workers` processes, spawned, not forked: the caller may have threads."""
    resource_tracker.ensure_running()  # its start, which would come with the first worker's, unblocks SIGINT
    return _Pool(workers, mp_context=multiprocessing.get_context("spawn"), initializer=_end_with_parent)


def each(
    work: Callable[[Any], T], items: Sequence[Any], workers: int, done: Callable[[], None] = lambda: None
) -> Iterator[tuple[int, T]]:
    """Run `work` on every item in a pool of processes; yield (index, result) as they finish.

    Args:
        work: a function of a module, or a `functools.partial` of one.
        items: what to work on.
        workers: processes; 1 works in this one.
        done: called after each.

    Raises:
        WorkerDied: a worker was killed, or out of memory; results until then are valid.
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
    """Run `work` on each item under a progress bar; return the results in the order of the items."""
    task = bar.add_task(what, total=len(items))
    found = dict(each(work, items, workers, lambda: bar.advance(task)))
    return [found[index] for index in range(len(items))]


def _end_with_parent() -> None:
    """End this worker with its parent, for whose work it would otherwise wait for ever, and on Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
