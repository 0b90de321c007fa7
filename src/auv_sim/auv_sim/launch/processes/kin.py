"""Parents and children as Linux knows them: a process that ends with its parent, one that adopts orphans."""

from __future__ import annotations

import ctypes
import signal

_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36
# Found before any fork: a child between fork and exec must not look for libraries.
_LIBC = ctypes.CDLL(None)


def end_with_parent() -> None:
    """Have this process end when its parent does, however that ends, even by SIGKILL."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)


def adopt_orphans(adopts: bool) -> None:
    """Have processes whose parent ends become children of this one, their ancestor, or no longer."""
    _LIBC.prctl(_PR_SET_CHILD_SUBREAPER, int(adopts))
