"""Open files of other programs: regular files only, and no more of one than a limit."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from auv_msgs_py.values.errors import ConfigurationError

#: Largest text file that is read, bytes. This many bytes of empty JSON lists take 350 MB of memory.
MOST_BYTES = 16_000_000

_KINDS = (
    (stat.S_ISDIR, "a directory"),
    (stat.S_ISFIFO, "a named pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)
_POINTER = b"version https://git-lfs.github.com/spec/"


@contextmanager
def opened(path: Path, expected: str, most: int | None = None) -> Iterator[BinaryIO]:
    """Open a regular file for reading.

    Args:
        path: the file; a symbolic link is followed.
        expected: what the file should be, for the error (`a YAML file`).
        most: largest size accepted, bytes; None for any.

    Raises:
        ConfigurationError: there is no such file, it cannot be opened, is not a regular file (a directory, a
            named pipe, a device) or is larger than `most`.
    """
    try:
        # O_NONBLOCK: opening a named pipe without a writer would wait for one. It has no effect on a file.
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
    except FileNotFoundError:
        raise ConfigurationError(str(path), "no such file", expected) from None
    except (OSError, ValueError) as error:
        raise ConfigurationError(
            str(path), f"a file that cannot be read ({_reason(error)})", expected
        ) from None
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            kind = next((name for matches, name in _KINDS if matches(status.st_mode)), "a special file")
            raise ConfigurationError(str(path), kind, expected)
        if most is not None and status.st_size > most:
            raise _too_large(path, status.st_size, most)
        with os.fdopen(descriptor, "rb", closefd=False) as stream:
            yield stream
    finally:
        os.close(descriptor)


def read_bytes(path: Path, expected: str, most: int = MOST_BYTES) -> bytes:
    """Read a whole file.

    Args:
        path, expected: as for `opened`.
        most: largest size accepted, bytes.

    Raises:
        ConfigurationError: as `opened`; also where the file is a Git LFS pointer.
    """
    with opened(path, expected, most) as stream:
        try:
            data = stream.read(most + 1)  # a file can grow, and files under /proc have no size
        except OSError as error:
            found = f"a file that cannot be read ({_reason(error)})"
            raise ConfigurationError(str(path), found, expected) from None
    if len(data) > most:
        raise _too_large(path, len(data), most)
    if data.startswith(_POINTER):
        raise ConfigurationError(str(path), "a Git LFS pointer", f"{expected} (fetch it with: git lfs pull)")
    return data


def read_text(path: Path, expected: str, most: int = MOST_BYTES) -> str:
    """Read a whole UTF-8 text file, without its byte order mark.

    Raises:
        ConfigurationError: as `read_bytes`; also text in another encoding.
    """
    data = read_bytes(path, expected, most)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        found = f"a file that cannot be read (byte {error.start} is not UTF-8 text)"
        raise ConfigurationError(str(path), found, expected) from None


def exists(path: Path) -> bool:
    """Return whether the path exists; False for a name that no file can have (too long, a NUL in it)."""
    return os.path.exists(path)  # noqa: PTH110 - Path.exists() raises for such names


def is_file(path: Path) -> bool:
    """Return whether the path is a regular file; False for a name that no file can have."""
    return os.path.isfile(path)  # noqa: PTH113 - Path.is_file() raises for such names


def is_directory(path: Path) -> bool:
    """Return whether the path is a directory; False for a name that no directory can have."""
    return os.path.isdir(path)  # noqa: PTH112 - Path.is_dir() raises for such names


def from_home(name: str) -> Path:
    """Return a name as a path, a leading ``~`` replaced by the home directory where there is one."""
    try:
        return Path(name).expanduser()
    except RuntimeError:  # no HOME and no such user
        return Path(name)


def _reason(error: OSError | ValueError) -> str:
    return (error.strerror if isinstance(error, OSError) else None) or str(error)


def _too_large(path: Path, size: int, most: int) -> ConfigurationError:
    return ConfigurationError(str(path), f"{size:,} bytes", f"a file of at most {most:,} bytes")
