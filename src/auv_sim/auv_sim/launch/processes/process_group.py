"""Child processes of one mission: started, watched and stopped together."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from auv_msgs_py.contract import topics
from auv_sim.launch.processes.kin import end_with_parent

#: In place of an exit code that only the parent of a process can read.
UNKNOWN_CODE = 256
#: Children that only display the mission; it continues without them.
_FOR_PEOPLE = (topics.DISPLAY, topics.CONSOLE)


class Process(Protocol):
    """The part of `subprocess.Popen` that is used here."""

    pid: int

    def poll(self) -> int | None: ...
    def wait(self, timeout: float | None = None) -> int: ...
    def send_signal(self, sig: int) -> None: ...
    def kill(self) -> None: ...


class Starter(Protocol):
    """What starts a mission's nodes: a `Loader`, or `ros2 launch`."""

    def fork(
        self, environment: Mapping[str, str], nodes: Sequence[tuple[str, str, Sequence[str], str]]
    ) -> Mapping[str, Process]:
        """Prepare the nodes, (name, module, arguments, log file) each; return name -> process."""

    def at_gate(self) -> bool:
        """Return whether every node is ready to enter the graph."""

    def open_gate(self) -> None:
        """Let the nodes start."""


@dataclass(frozen=True)
class Child:
    """One process and its log."""

    name: str
    process: Process
    log: Path

    @property
    def exit_code(self) -> int | None:
        """None while it runs."""
        return self.process.poll()

    def last_lines(self, count: int = 6) -> list[str]:
        """Return the last lines of its log; of ROS's own where another process has its output."""
        ros = self.log.parent.glob(f"ros/*_{self.process.pid}_*.log")
        log = self.log if self.log.exists() else next(ros, None)
        text = log.read_text(encoding="utf-8", errors="replace") if log else ""
        return [line for line in text.splitlines() if line.strip()][-count:]

    def obituary(self) -> str:
        """Return how it ended, with its last lines."""
        code = self.exit_code or 0
        how = f"was killed by signal {-code}" if code < 0 else f"ended with code {code}"
        if code == UNKNOWN_CODE:
            how = "ended"
        lines = "\n".join(f"  | {line}" for line in self.last_lines())
        if not lines and not self.log.exists():
            return f"{self.name} {how}"
        return f"{self.name} {how}; its last lines ({self.log}):\n{lines}"


def _for_owner(path: str, flags: int) -> int:
    descriptor = os.open(path, flags, 0o600)
    os.fchmod(descriptor, 0o600)  # of a file that was there
    return descriptor


class Children:
    """Starts and stops child processes.

    Args:
        log_directory: stdout and stderr of each go to ``<name>.log`` there.
        environment: variables on top of the launcher's own.
    """

    def __init__(self, log_directory: Path, environment: Mapping[str, str]) -> None:
        self._directory = log_directory
        self._environment = dict(environment)
        self._children: dict[str, Child] = {}
        log_directory.mkdir(parents=True, exist_ok=True)

    def start(
        self, name: str, module: str, arguments: Sequence[str], is_log_secret: bool = False
    ) -> None:  # fmt: skip
        """Run ``python -m module arguments`` in its own session: Ctrl-C reaches only the launcher.

        Args:
            name: of the child.
            module: to run.
            arguments: of its command line.
            is_log_secret: whether its log is for the owner alone, from its creation.
        """
        log = self._log(name)
        with open(log, "wb", opener=_for_owner if is_log_secret else None) as stream:
            process = subprocess.Popen(  # noqa: S603 - our own interpreter, our own modules
                [sys.executable, "-m", module, *arguments],
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                env={**os.environ, **self._environment, "PYTHONUNBUFFERED": "1"},
                start_new_session=True,
                preexec_fn=end_with_parent,
            )
        self._children[name] = Child(name, process, log)

    def fork(self, loader: Starter, nodes: Mapping[str, tuple[str, Sequence[str]]]) -> None:
        """Start nodes by `loader`: name -> module and arguments. They wait at its gate."""
        order = [
            (name, module, list(arguments), str(self._log(name)))
            for name, (module, arguments) in nodes.items()
        ]
        for name, process in loader.fork(self._environment, order).items():
            self._children[name] = Child(name, process, self._log(name))

    def _log(self, name: str) -> Path:
        return self._directory / f"{name}.log"

    def __iter__(self) -> Iterator[Child]:
        return iter(self._children.values())

    @property
    def ids(self) -> dict[str, int]:
        """Name -> process id."""
        return {name: child.process.pid for name, child in self._children.items()}

    def dead(self) -> Child | None:
        """Return the first needed child that has ended, None if all run."""
        needed = (each for each in self._children.values() if each.name not in _FOR_PEOPLE)
        return next((each for each in needed if each.exit_code is not None), None)

    def stop(self, names: Sequence[str] | None = None, patience: float = 10.0) -> None:
        """Send SIGINT to the named children (default: all); kill those that outlive `patience`, s."""
        chosen = [self._children[name] for name in names or self._children if name in self._children]
        for child in chosen:
            if child.exit_code is None:
                child.process.send_signal(signal.SIGINT)
        deadline = time.monotonic() + patience
        for child in chosen:
            try:
                child.process.wait(max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                child.process.kill()
                child.process.wait()
