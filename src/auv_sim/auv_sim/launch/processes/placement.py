"""The processor on which a lockstep mission runs.

Its nodes wait for each other, so they can use only one processor; on one, their messages stay in its cache,
and no process is woken on another processor. The recorder, for which no node waits, runs beside them.
docs/performance.md has the gain.
"""

from __future__ import annotations

import contextlib
import os
import socket
from collections.abc import Iterable
from pathlib import Path

from auv_msgs_py.contract import topics

#: Abstract socket, the same for all users of a machine; it is released when its process ends.
_CLAIM = "\0auv-lockstep-processor-{}"


class Processor:
    """One processor for the nodes of a mission that no other mission on this machine uses; perhaps none.

    Args:
        usable: processors to choose from; those that this process may use by default.
    """

    def __init__(self, usable: Iterable[int] | None = None) -> None:
        self._usable = sorted(os.sched_getaffinity(0) if usable is None else usable)
        self._claim: socket.socket | None = None
        #: Its number; None where none is free, and the system decides.
        self.number = self._claimed() if len(self._usable) > 1 else None

    def _claimed(self) -> int | None:
        begin = os.getpid() % len(self._usable)
        for number in self._usable[begin:] + self._usable[:begin]:
            claim = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
            try:
                claim.bind(_CLAIM.format(number))
            except OSError:
                claim.close()
                continue
            self._claim = claim
            return number
        return None

    def release(self) -> None:
        """Release the processor for other missions."""
        if self._claim is not None:
            self._claim.close()
            self._claim = self.number = None

    def place(self, processes: dict[str, int]) -> None:
        """Assign running processes to their processors.

        Call it once all of them have started, which is faster on all processors.

        Args:
            processes: node name -> process id.
        """
        if self.number is None:
            return
        beside = {number for number in self._usable if number != self.number}
        for name, pid in processes.items():
            _put(pid, beside if name == topics.RECORDER else {self.number})


def _put(pid: int, processors: set[int]) -> None:
    """Assign all threads of a process; as batch work a woken thread does not preempt the one that woke it."""
    tasks: list[Path] = []
    with contextlib.suppress(OSError):
        tasks += Path(f"/proc/{pid}/task").iterdir()
    for task in tasks:
        # Threads may have ended meanwhile; where a container forbids it, the mission is slower, not
        # different.
        with contextlib.suppress(OSError):
            os.sched_setaffinity(int(task.name), processors)
            os.sched_setscheduler(int(task.name), os.SCHED_BATCH, os.sched_param(0))
