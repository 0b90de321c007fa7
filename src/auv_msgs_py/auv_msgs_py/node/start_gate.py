"""The gate at which a launcher's nodes wait, outside the graph, until the launcher has looked. ROS-free."""

from __future__ import annotations

import os
import select
import sys
from collections.abc import Callable

#: Set in the environment of nodes that a launcher starts: the number of a pipe on which each reports, with a
#: byte, that it has loaded. It then waits for `OPEN` on its standard input, which it shares with the others.
GATE, OPEN = "AUV_START_GATE", b"open\n"
#: In place of the pipe's number: the launcher looked before it started the nodes, and the gate is open.
PASSED = "passed"


def is_gated() -> bool:
    """Return whether this process was started by a launcher that looks at the graph."""
    return GATE in os.environ


def pass_gate(is_stopped: Callable[[], bool]) -> bool:
    """Wait until the gate is open; without a launcher it is open.

    Args:
        is_stopped: whether a signal has asked this process to end.

    Returns:
        Whether to make the nodes: False when the launcher has ended or `is_stopped`.
    """
    if os.environ.get(GATE, PASSED) == PASSED:
        return True
    pipe = int(os.environ[GATE])
    os.write(pipe, b".")
    os.close(pipe)
    while not is_stopped():
        if select.select([sys.stdin], [], [], 0.1)[0]:
            return os.read(sys.stdin.fileno(), len(OPEN)) == OPEN
    return False
