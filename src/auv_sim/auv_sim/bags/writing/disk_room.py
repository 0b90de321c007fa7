"""Room on the disk."""

from __future__ import annotations

import shutil
from pathlib import Path

_MEGABYTE = 1_000_000


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
