"""Unpacks files (`*.zstd`) and single messages that rosbag2 compressed as a whole."""

from __future__ import annotations

from pathlib import Path

import zstandard

from auv_msgs_py.values.errors import ConfigurationError

#: The suffix of a file that is packed.
SUFFIX = ".zstd"
#: Largest growth: recordings shrink to a tenth, and more than this is an attack on the disk.
LARGEST_RATIO = 200
#: Small files may grow to this size in any case, bytes.
SMALL = 64_000_000
_STEP = 1 << 20


def unpack(file: Path, directory: Path) -> Path:
    """Write a packed file's content into a directory; of a truncated one, its readable part.

    Raises:
        ConfigurationError: it is not packed, grows without measure, or finds no room.
    """
    target = directory / file.with_suffix("").name
    limit = max(SMALL, LARGEST_RATIO * file.stat().st_size)
    size = 0
    try:
        with file.open("rb") as packed, target.open("wb") as plain:
            reader = zstandard.ZstdDecompressor(max_window_size=1 << 27).stream_reader(packed)
            while part := reader.read(_STEP):
                size += len(part)
                if size > limit:
                    raise ConfigurationError(
                        str(file), f"more than {limit:,} bytes in {file.stat().st_size:,}", "a recording"
                    )
                plain.write(part)
    except zstandard.ZstdError as error:
        if not size:
            raise ConfigurationError(str(file), f"{error}", "a file compressed with zstd") from None
    except OSError as error:
        raise ConfigurationError(str(file), f"{error.strerror}", "room for its content") from None
    return target


def unpack_message(data: bytes) -> bytes:
    """Return a packed message's content.

    Raises:
        zstandard.ZstdError: it is not packed, or grows without measure.
    """
    size = zstandard.frame_content_size(data)
    limit = max(SMALL, LARGEST_RATIO * len(data))
    if size > limit:
        raise zstandard.ZstdError(f"{size} bytes in {len(data)}")
    return zstandard.ZstdDecompressor().decompress(data, max_output_size=limit)
