"""The rows of a vehicle on disk, so that a restarted console shows the track again.

A file belongs to one publisher of odometry: a simulator or driver that was started anew has another identity,
and its track is another one. The file is a cache: without it, or when the disk is full, nothing else is lost.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
from pathlib import Path

import numpy as np

from auv_sim.views.console.record.history import Rows
from auv_sim.views.console.record.track_columns import NAMES

#: Files that were not written for this long are removed, s.
STALE = 86_400.0
#: Most files that are kept; the oldest ones go.
MOST_FILES = 20
_SUFFIX = ".track"


def remove_stale(directory: Path, now: float) -> None:
    """Remove tracks that are too many, or were not written for `STALE` s.

    Args:
        directory: of the tracks.
        now: the machine's time, s.
    """
    files = sorted((-_written(file), file) for file in directory.glob(f"*{_SUFFIX}"))
    for number, (written, file) in enumerate(files, start=1):
        if now + written > STALE or number > MOST_FILES:
            with contextlib.suppress(OSError):
                file.unlink()


def _written(file: Path) -> float:
    try:
        return file.stat().st_mtime
    except OSError:
        return 0.0


class TrackFile:
    """One file: a line of JSON, then the rows as little-endian float32.

    Args:
        directory: of all tracks; None keeps none.
        owner: of the track: domain, namespace and publisher.
    """

    def __init__(self, directory: Path | None, owner: str) -> None:
        name = hashlib.sha256(owner.encode()).hexdigest()[:24]
        self._file = directory / f"{name}{_SUFFIX}" if directory is not None else None

    def read(self) -> tuple[float, Rows] | None:
        """Return the stamp of the rows' t = 0, s, and the rows; None where there is no usable file."""
        if self._file is None:
            return None
        try:
            head, _, body = self._file.read_bytes().partition(b"\n")
            facts = json.loads(head)
            if facts["columns"] != list(NAMES):
                return None
            t0 = float(facts["t0"])
        except (OSError, ValueError, KeyError, TypeError):
            return None
        whole = len(body) - len(body) % (4 * len(NAMES))  # the last row may be cut off
        rows = np.frombuffer(body[:whole], "<f4").reshape(-1, len(NAMES))
        return (t0, rows.astype(np.float32)) if len(rows) and np.isfinite(t0) else None

    def begin(self, t0: float, rows: Rows) -> None:
        """Write the file anew, for the owner of this process alone."""
        if self._file is None:
            return
        head = json.dumps({"t0": t0, "columns": list(NAMES)}).encode() + b"\n"
        try:
            descriptor = os.open(self._file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
            with os.fdopen(descriptor, "wb") as stream:
                stream.write(head + rows.astype("<f4").tobytes())
        except OSError:
            self._file = None

    def append(self, rows: bytes) -> None:
        """Append rows; after a failure the file is left alone."""
        if self._file is None or not rows:
            return
        try:
            with self._file.open("ab") as stream:
                stream.write(rows)
        except OSError:
            self._file = None
