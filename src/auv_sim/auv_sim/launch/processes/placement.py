"""On which processor the processes of a lockstep mission run.

Its nodes wait for each other, so one processor is all that they can use; on one they find each other's
messages in its cache, and nobody has to be woken across the machine. The recorder, which nobody waits for,
runs beside them. docs/performance.md has what that is worth.
"""

from __future__ import annotations

import contextlib
import os
import socket
from collections.abc import Iterable
from pathlib import Path

from auv_msgs_py.contract import topics

#: The same for all users of a machine; it goes with the process that holds it.
_CLAIM = "\0auv-lockstep-processor-{}"


class Processor:
    """One processor for the nodes of a mission that no other mission on this machine has; perhaps none.

    Args:
        usable: processors to choose from; those that this process may use by default.
    """

    def __init__(self, usable: Iterable[int] | None = None) -> None:
        self._usable = sorted(os.sched_getaffinity(0) if usable is None else usable)
        self._claim: socket.socket | None = None
        #: Its number; None where there is none to be had, and the system decides.
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
        """Let another mission have it."""
        if self._claim is not None:
            self._claim.close()
            self._claim = self.number = None

    def place(self, processes: dict[str, int]) -> None:
        """Put running processes where they belong.

        Call it when all of them have come up, which they do sooner on all processors.

        Args:
            processes: node name -> process id.
        """
        if self.number is None:
            return
        beside = {number for number in self._usable if number != self.number}
        for name, pid in processes.items():
            _put(pid, beside if name == topics.RECORDER else {self.number})


def _put(pid: int, processors: set[int]) -> None:
    """All threads of a process; as batch work, who is woken waits until who woke him has said everything."""
    tasks: list[Path] = []
    with contextlib.suppress(OSError):
        tasks += Path(f"/proc/{pid}/task").iterdir()
    for task in tasks:
        # What has ended meanwhile needs no place; where a container forbids it, all is slower, not different.
        with contextlib.suppress(OSError):
            os.sched_setaffinity(int(task.name), processors)
            os.sched_setscheduler(int(task.name), os.SCHED_BATCH, os.sched_param(0))
