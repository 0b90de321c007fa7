"""Room on the disk."""

from __future__ import annotations

import math
import shutil
import time
from pathlib import Path

_MEGABYTE = 1_000_000
#: Time between two looks at the disk, s.
PERIOD = 0.1


def room_lacking(directory: Path, least: int) -> tuple[str, str] | None:
    """Return what was found and what was expected where fewer than `least` MB are free, else None.

    Args:
        directory: on the disk in question; it need not exist yet.
        least: MB; 0 for no limit.
    """
    there = directory.absolute()
    while not there.exists():
        there = there.parent
    free = shutil.disk_usage(there).free
    if free >= least * _MEGABYTE:
        return None
    return f"{free // _MEGABYTE} MB free for {directory}", f"at least {least} MB"


class RoomWatch:
    """Looks at the disk again and again, but not at each of many flushes within milliseconds.

    Args:
        directory: on the disk in question.
    """

    def __init__(self, directory: Path) -> None:
        self._directory = directory
        self._looked = -math.inf

    def lacking(self, least: int) -> tuple[str, str] | None:
        """Return what `room_lacking` does, or None until `PERIOD` has passed since the last look."""
        now = time.monotonic()
        if now - self._looked < PERIOD:
            return None
        self._looked = now
        return room_lacking(self._directory, least)
