"""The launcher's side of `loader`: one process that imports for all nodes, then forks into them."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from types import TracebackType

from auv_msgs_py.node.start_gate import OPEN
from auv_sim.launch.outcome import MissionFailed
from auv_sim.launch.processes.kin import adopt_orphans

#: Unused arguments: the nodes write their own command line over them, for `ps`.
_ROOM = ("." * 250,)


class Adopted:
    """A child that another process has forked for this one.

    Args:
        pid: its process id.
    """

    def __init__(self, pid: int) -> None:
        self.pid = pid
        self._code: int | None = None

    def poll(self) -> int | None:
        """Return the exit code, negative for a signal; None while it runs."""
        if self._code is None:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            self._code = os.waitstatus_to_exitcode(status) if pid else None
        return self._code

    def wait(self, timeout: float | None = None) -> int:
        """Wait for its end; return the exit code.

        Raises:
            subprocess.TimeoutExpired: it has not ended within `timeout` s.
        """
        deadline = time.monotonic() + timeout if timeout is not None else None
        while (code := self.poll()) is None:
            if deadline is not None and time.monotonic() >= deadline:
                raise subprocess.TimeoutExpired(str(self.pid), timeout or 0.0)
            time.sleep(0.005)
        return code

    def send_signal(self, sig: int) -> None:
        """Send a signal, unless it has ended."""
        if self.poll() is None:
            os.kill(self.pid, sig)

    def kill(self) -> None:
        """Send SIGKILL."""
        self.send_signal(signal.SIGKILL)


class Loader:
    """The process that imports the nodes' libraries and forks into them: `auv_sim.launch.processes.loader`.

    Start it early: it imports while the launcher reads its files.
    """

    def __init__(self) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed on exit
        # The nodes that the loader leaves behind become children of this process.
        adopt_orphans(True)
        # Without the threads of linear algebra, which nothing needs here, the process can fork.
        environment = {**os.environ, "PYTHONUNBUFFERED": "1", "OPENBLAS_NUM_THREADS": "1"}
        self._process = subprocess.Popen(  # noqa: S603 - our own interpreter, our own module
            [sys.executable, "-m", "auv_sim.launch.processes.loader", *_ROOM],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            env=environment,
            start_new_session=True,
        )
        assert self._process.stdin is not None and self._process.stdout is not None
        self._order, self._reports = self._process.stdin.fileno(), self._process.stdout.fileno()
        self._nodes = self._at_gate = 0

    def fork(
        self, environment: Mapping[str, str], nodes: Sequence[tuple[str, str, Sequence[str], str]]
    ) -> dict[str, Adopted]:
        """Fork the nodes, which wait at their gate once they have loaded.

        Args:
            environment: variables for all of them.
            nodes: (name, module, arguments, log file) of each.

        Returns:
            Name -> process.

        Raises:
            MissionFailed: the loader has ended.
        """
        answer = b""
        with contextlib.suppress(BrokenPipeError):
            os.write(self._order, json.dumps((dict(environment), nodes)).encode() + b"\n")
            while not answer.endswith(b"\n") and (more := os.read(self._reports, 1)):
                answer += more
        self._process.wait()
        if not answer:
            self._errors.seek(0)
            lines = self._errors.read().decode(errors="replace").splitlines()[-6:]
            raise MissionFailed("\n  | ".join(["the nodes cannot be loaded:", *lines]))
        os.set_blocking(self._reports, False)
        self._nodes = len(nodes)
        return {name: Adopted(pid) for name, pid in json.loads(answer).items()}

    def at_gate(self) -> bool:
        """Return whether every node has loaded and waits."""
        with contextlib.suppress(BlockingIOError):
            self._at_gate += len(os.read(self._reports, self._nodes or 1))
        return self._at_gate >= self._nodes

    def open_gate(self) -> None:
        """Let the nodes start."""
        with contextlib.suppress(BrokenPipeError):  # all have ended, which `Children.dead` reports
            os.write(self._order, OPEN * self._nodes)

    def __enter__(self) -> Loader:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the loader if it has not forked yet."""
        self._process.kill()
        with self._process:  # closes its pipes and waits
            self._errors.close()
        adopt_orphans(False)
