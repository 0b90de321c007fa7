"""Child processes of one mission: started together, watched, and gone together."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from auv_msgs_py.run import GATE, OPEN

_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None)


def _die_with_parent() -> None:
    """Runs in the child: even a launcher that is killed with -9 leaves nothing running."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)


@dataclass(frozen=True)
class Child:
    """One process and its log."""

    name: str
    process: subprocess.Popen[bytes]
    log: Path

    @property
    def exit_code(self) -> int | None:
        """None while it runs."""
        return self.process.poll()

    def last_lines(self, count: int = 6) -> list[str]:
        """The end of its log."""
        text = self.log.read_text(encoding="utf-8", errors="replace")
        return [line for line in text.splitlines() if line.strip()][-count:]


class Children:
    """Starts and stops child processes.

    Args:
        log_directory: stdout and stderr of each go to ``<name>.log`` there.
        environment: variables on top of the launcher's own.
    """

    def __init__(self, log_directory: Path, environment: Mapping[str, str]) -> None:
        self._directory = log_directory
        self._environment = {**os.environ, **environment, "PYTHONUNBUFFERED": "1"}
        self._children: dict[str, Child] = {}
        self._loaded, self._report = os.pipe()
        os.set_blocking(self._loaded, False)
        self._gated = self._at_gate = 0
        log_directory.mkdir(parents=True, exist_ok=True)

    def start(self, name: str, module: str, arguments: Sequence[str], gated: bool = False) -> None:
        """Run ``python -m module arguments`` in its own session: Ctrl-C reaches only the launcher.

        A gated process runs nodes of the suite and makes them when `open_gate` is called.
        """
        log = self._directory / f"{name}.log"
        with log.open("wb") as stream:
            process = subprocess.Popen(  # noqa: S603 - our own interpreter, our own modules
                [sys.executable, "-m", module, *arguments],
                stdin=subprocess.PIPE if gated else subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                env={**self._environment, GATE: str(self._report)} if gated else self._environment,
                pass_fds=(self._report,) if gated else (),
                start_new_session=True,
                preexec_fn=_die_with_parent,
            )
        self._gated += gated
        self._children[name] = Child(name, process, log)

    def at_gate(self) -> bool:
        """Whether every gated process has loaded and waits."""
        with contextlib.suppress(BlockingIOError):
            self._at_gate += len(os.read(self._loaded, self._gated or 1))
        return self._at_gate >= self._gated

    def open_gate(self) -> None:
        """Let the gated processes make their nodes."""
        for child in self._children.values():
            if child.process.stdin is not None:
                with contextlib.suppress(BrokenPipeError):  # it has ended, which `dead` reports
                    child.process.stdin.write(OPEN.encode())
                    child.process.stdin.flush()

    def __iter__(self):  # type: ignore[no-untyped-def]
        return iter(self._children.values())

    @property
    def ids(self) -> dict[str, int]:
        """Name -> process id."""
        return {name: child.process.pid for name, child in self._children.items()}

    def dead(self) -> Child | None:
        """The first child that has ended, if any has."""
        return next((child for child in self._children.values() if child.exit_code is not None), None)

    def stop(self, names: Sequence[str] | None = None, patience: float = 10.0) -> None:
        """SIGINT to the named children (all by default); who does not leave within `patience` s is killed."""
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
            if child.process.stdin is not None:
                with contextlib.suppress(BrokenPipeError):
                    child.process.stdin.close()
