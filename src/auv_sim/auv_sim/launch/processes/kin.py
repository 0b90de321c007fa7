"""Parent and child processes under Linux: one that ends with its parent, one that adopts orphans."""

from __future__ import annotations

import ctypes
import signal

_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36
# Loaded before any fork: a child between fork and exec must not search for libraries.
_LIBC = ctypes.CDLL(None)


def end_with_parent() -> None:
    """End this process with its parent, even if that is killed."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)


def adopt_orphans(adopts: bool) -> None:
    """Adopt descendants whose parent ends as children of this process, or stop doing so."""
    _LIBC.prctl(_PR_SET_CHILD_SUBREAPER, int(adopts))
