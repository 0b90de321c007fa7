"""A process of a mission that another process, `ros2 launch`, has started and waits for."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import subprocess
from pathlib import Path

from auv_sim.launch.processes.process_group import UNKNOWN_CODE


class Launched:
    """A process that is found by its command line; only its parent can read its exit code.

    Args:
        executable: its executable's name, or the module that Python runs.
        mark: text that no other mission's processes have in their command line.
    """

    def __init__(self, executable: str, mark: str) -> None:
        self._executable, self._mark = executable, mark
        #: Process id; 0 before the process was found.
        self.pid = 0
        self._handle = -1

    def poll(self) -> int | None:
        """Return `UNKNOWN_CODE` once it has ended; None while it runs or has not been found."""
        if not self._found():
            return None
        return UNKNOWN_CODE if select.select([self._handle], [], [], 0.0)[0] else None

    def wait(self, timeout: float | None = None) -> int:
        """Wait for its end; return `UNKNOWN_CODE`, at once if it never existed.

        Raises:
            subprocess.TimeoutExpired: it has not ended within `timeout` s.
        """
        if self._found() and not select.select([self._handle], [], [], timeout)[0]:
            raise subprocess.TimeoutExpired(self._executable, timeout or 0.0)
        return UNKNOWN_CODE

    def send_signal(self, sig: int) -> None:
        """Send a signal, unless it has ended or never existed."""
        if self._found():
            with contextlib.suppress(ProcessLookupError):
                signal.pidfd_send_signal(self._handle, sig)

    def kill(self) -> None:
        """Send SIGKILL."""
        self.send_signal(signal.SIGKILL)

    def _found(self) -> bool:
        if self.pid == 0:
            for folder in Path("/proc").iterdir():
                if folder.name.isdecimal() and self._is_it(folder):
                    with contextlib.suppress(ProcessLookupError):
                        self._handle = os.pidfd_open(int(folder.name))
                        self.pid = int(folder.name)
                        break
        return self.pid != 0

    def _is_it(self, folder: Path) -> bool:
        with contextlib.suppress(OSError):
            words = (folder / "cmdline").read_bytes().decode(errors="replace").split("\0")
            named = any(word == self._executable or Path(word).name == self._executable for word in words)
            return named and any(self._mark in word for word in words)
        return False
