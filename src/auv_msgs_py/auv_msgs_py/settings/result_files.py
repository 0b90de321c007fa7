"""Write results: each file whole, or not at all."""

from __future__ import annotations

import contextlib
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from auv_msgs_py.values.errors import SuiteError, printable

_LONGEST = 100


class NotWritten(SuiteError, OSError):
    """A file could not be written, e.g. because the disk is full; no part of it is left behind."""

    def __str__(self) -> str:
        return printable(f"{self.filename} cannot be written ({self.strerror})")


@contextlib.contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Write a file beside its target; it replaces the target once it is whole and on the disk.

    Yields:
        The path to write to. A target that exists and is not a regular file (``/dev/stdout``) is written
        directly.

    Raises:
        NotWritten: it cannot be written; the target is unchanged.
    """
    place = Path(os.path.realpath(target))
    direct = place.exists() and not place.is_file()
    # Without the target's suffix: a half-written file must not look like a table or a recording.
    draft = place if direct else place.with_name(f".{place.name[:_LONGEST]}.{os.getpid()}.part")
    try:
        yield draft
        if not direct:
            with draft.open("rb") as stream:
                os.fsync(stream.fileno())
            draft.replace(place)
    except BaseException as error:
        if not direct:
            with contextlib.suppress(OSError):
                draft.unlink(missing_ok=True)
        if isinstance(error, OSError) and not isinstance(error, BrokenPipeError):
            reason = os.strerror(error.errno) if error.errno else str(error)
            raise NotWritten(error.errno, reason, str(target)) from None
        raise


def write_text(target: Path, text: str) -> None:
    """Write a text file as UTF-8.

    Raises:
        NotWritten: as `replacing`.
    """
    with replacing(target) as draft:
        draft.write_text(text, encoding="utf-8")


def copy(source: Path, target: Path) -> None:
    """Copy a file's content.

    Raises:
        NotWritten: as `replacing`.
    """
    with replacing(target) as draft:
        shutil.copyfile(source, draft)
