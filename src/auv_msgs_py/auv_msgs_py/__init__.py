"""The common language of the suite: types, frames, topics, settings, ROS 2 plumbing. No laws live here."""

from __future__ import annotations

import sys
from importlib import metadata

#: Settings are pydantic 2 dataclasses; Ubuntu 24.04's own package is 1.10.
_PYDANTIC = 2


def _check_pydantic() -> None:
    """End the process with one line where pydantic is older than the suite needs.

    Raises:
        SystemExit: with exit code 2. An ImportError would bury the line under the traceback of every node.
    """
    found = metadata.version("pydantic")
    if int(found.split(".")[0]) < _PYDANTIC:
        advice = f"python3 -m pip install 'pydantic>={_PYDANTIC}'"
        print(
            f"auv_msgs_py: found pydantic {found}, expected {_PYDANTIC} or newer: {advice}", file=sys.stderr
        )
        raise SystemExit(2)


_check_pydantic()
