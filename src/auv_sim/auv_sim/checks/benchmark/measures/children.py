"""Processes under measurement: watched, interruptible, and gone afterwards."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from auv_msgs_py.node.run import StopRequest
from auv_msgs_py.values.errors import SuiteError
from auv_sim.checks.benchmark.usage import Usage, usage
from auv_sim.launch.processes.domains import free_domain, variables_of
from auv_sim.launch.processes.process_group import Children


class BenchmarkFailed(SuiteError):
    """Something that was to be measured did not run."""


class MeasuredProcesses(Children):
    """Child processes in a ROS domain of their own.

    Args:
        directory: their logs go below it.
        domain: ROS domain.
        stop: set by a signal.
    """

    def __init__(self, directory: Path, domain: int, stop: StopRequest) -> None:
        environment = variables_of(domain)
        os.environ.update(environment)  # for nodes of this process that observe them
        super().__init__(directory / "log", environment)
        self._stop = stop

    def usage(self) -> dict[str, Usage]:
        """Return what each has used so far."""
        return {name: usage(pid) for name, pid in self.ids.items()}

    def until(self, condition: Callable[[], bool], look: Callable[[], None], patience: float) -> None:
        """Look repeatedly until the condition holds.

        Raises:
            BenchmarkFailed: a process has ended, or patience (s) has.
            KeyboardInterrupt: a signal came.
        """
        deadline = time.monotonic() + patience
        while not condition():
            dead = self.dead()
            if dead is not None:
                raise BenchmarkFailed(f"{dead.name} ended early: {' '.join(dead.last_lines(3))}")
            if time.monotonic() > deadline:
                raise BenchmarkFailed(f"no result within {patience:g} s")
            look()
            if self._stop.requested:
                raise KeyboardInterrupt


@contextmanager
def interruptible() -> Iterator[StopRequest]:
    """Let signals only set a flag inside, so that no process is started and lost."""
    stop = StopRequest()
    try:
        yield stop
    finally:
        stop.withdraw()
    if stop.requested:
        raise KeyboardInterrupt


@contextmanager
def processes(directory: Path) -> Iterator[MeasuredProcesses]:
    """Yield processes that are stopped at the end, whatever happens."""
    with interruptible() as stop, free_domain() as domain:
        children = MeasuredProcesses(directory, domain, stop)
        try:
            yield children
        finally:
            children.stop()
