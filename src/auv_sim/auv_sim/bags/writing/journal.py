"""A file that only ever holds whole writes. What a full disk cuts in half is taken back and kept.

`mcap.Writer` on a file of Python's leaves the half of a chunk on a full disk, and its own reader stops there
(test_mcap_library.py).
"""

from __future__ import annotations

import os
from pathlib import Path


class Journal:
    """Collect bytes in memory and hand them to the operating system all at once, or not at all.

    Bytes that the operating system has survive the end of this process, however it ends. When a commit
    fails (disk full, quota, file too large) the file is cut back to the last good commit and the bytes
    stay in memory for the next commit.

    Args:
        path: the file to make; it must not exist.

    Raises:
        OSError: it cannot be made.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._fd = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
        self._parts: list[bytes] = []
        self._committed = 0
        self.pending = 0
        #: Why the last commit failed; None where it succeeded.
        self.error: OSError | None = None

    @property
    def position(self) -> int:
        """Where the next byte will stand in the file."""
        return self._committed + self.pending

    def write(self, data: bytes) -> None:
        """Add bytes to the next commit."""
        self._parts.append(data)
        self.pending += len(data)

    def commit(self) -> bool:
        """Hand over everything that is pending; return False (see `error`) where it does not fit."""
        if not self._parts:
            return self.error is None
        data = b"".join(self._parts)
        view = memoryview(data)
        try:
            while view:
                view = view[os.write(self._fd, view) :]
        except OSError as error:
            self.error = error
            os.ftruncate(self._fd, self._committed)
            os.lseek(self._fd, self._committed, os.SEEK_SET)
            self._parts = [data]
            return False
        self._committed += len(data)
        self._parts, self.pending, self.error = [], 0, None
        return True

    def close(self) -> None:
        """Commit and wait until it is on the disk; what cannot be committed now is given up."""
        self.commit()
        os.fsync(self._fd)
        os.close(self._fd)
