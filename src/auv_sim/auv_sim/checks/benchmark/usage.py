"""Reads what processes use from /proc: processor time, context switches, memory."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import NamedTuple


class Usage(NamedTuple):
    """All threads of a process: processor time, s, and voluntary context switches."""

    cpu: float
    switches: int


def usage(pid: int) -> Usage:
    """Return what a process has used so far; the kernel counts in nanoseconds."""
    cpu, switches = 0, 0
    for task in Path(f"/proc/{pid}/task").iterdir():
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):  # the thread has ended meanwhile
            cpu += int((task / "schedstat").read_text().split()[0])
            for line in (task / "status").read_text().splitlines():
                if line.startswith("voluntary_ctxt_switches"):
                    switches += int(line.split()[1])
    return Usage(cpu * 1e-9, switches)


class MemoryUse(NamedTuple):
    """Resident and proportional set (shared pages divided among their users), bytes."""

    rss: int
    pss: int


def memory(pid: int) -> MemoryUse:
    """Return the memory that a process occupies now."""
    found = {}
    for line in Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines():
        key, *rest = line.split()
        if key in ("Rss:", "Pss:"):
            found[key] = int(rest[0]) * 1024
    return MemoryUse(found["Rss:"], found["Pss:"])
