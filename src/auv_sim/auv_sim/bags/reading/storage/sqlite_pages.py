"""Messages from the pages of a damaged SQLite file.

Where a page is missing or damaged the library loses everything below it. Rows, however, are in leaf pages,
which can be read without any other page (except the continuation of a long row), so they are found page by
page. The format: https://www.sqlite.org/fileformat2.html, sections 1.6 and 2.1.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

_PAGE_SIZE_AT, _RESERVED_AT = 16, 20
_FIRST_PAGE_HEADER = 100
_TABLE_LEAF = 13
#: Bytes of an integer by its serial type; 8 and 9 are the constants 0 and 1.
_INTEGERS = {1: 1, 2: 2, 3: 3, 4: 4, 5: 6, 6: 8, 8: 0, 9: 0}

#: Row number, topic number, log time (ns), the serialised message.
Row = tuple[int, int, int, bytes]


def rows_of(file: Path) -> Iterator[Row]:
    """Yield every complete row that has the form of rosbag2's table of messages, page by page."""
    with file.open("rb") as stream:
        data = stream.read()
    if len(data) < _FIRST_PAGE_HEADER:
        return
    (size,) = struct.unpack_from(">H", data, _PAGE_SIZE_AT)
    size = 65536 if size == 1 else size
    if size < 512:
        return
    usable = size - data[_RESERVED_AT]
    for start in range(0, len(data) - size + 1, size):
        head = start + (_FIRST_PAGE_HEADER if start == 0 else 0)
        if data[head] == _TABLE_LEAF:
            yield from _page(data, start, head, size, usable)


def _page(data: bytes, start: int, head: int, size: int, usable: int) -> Iterator[Row]:
    (cells,) = struct.unpack_from(">H", data, head + 3)
    for k in range(min(cells, (size - 8) // 2)):
        at = head + 8 + 2 * k
        if at + 2 > start + size:
            return
        (offset,) = struct.unpack_from(">H", data, at)
        try:
            row = _cell(data, start + offset, start + size, size, usable)
        except (IndexError, struct.error):
            continue
        if row is not None:
            yield row


def _cell(data: bytes, at: int, end: int, size: int, usable: int) -> Row | None:
    """Return one row, or None where it is incomplete or of another table."""
    length, at = _varint(data, at)
    number, at = _varint(data, at)
    if length > len(data):
        return None
    largest = usable - 35
    local = length
    if length > largest:
        least = (usable - 12) * 32 // 255 - 23
        local = least + (length - least) % (usable - 4)
        local = local if local <= largest else least
    if at + local > end:
        return None
    record = data[at : at + local]
    if local < length:
        (following,) = struct.unpack_from(">I", data, at + local)
        record += _continued(data, following, length - local, size, usable)
    return _record(record, number) if len(record) == length else None


def _continued(data: bytes, page: int, missing: int, size: int, usable: int) -> bytes:
    """Return the rest of a long row, in a chain of pages, as far as it is there."""
    parts = []
    while missing > 0 and page > 0 and page * size <= len(data):
        start = (page - 1) * size
        (page,) = struct.unpack_from(">I", data, start)
        parts.append(data[start + 4 : start + min(usable, 4 + missing)])
        missing -= len(parts[-1])
    return b"".join(parts)


def _record(record: bytes, number: int) -> Row | None:
    """Return a row of the table of messages, whose number is outside of the record; None for another form."""
    at, kinds = 0, []
    header, at = _varint(record, at)
    while at < header:
        kind, at = _varint(record, at)
        kinds.append(kind)
    if at != header or len(kinds) != 4 or kinds[0] != 0:
        return None
    if kinds[1] not in _INTEGERS or kinds[2] not in _INTEGERS or kinds[3] < 12 or kinds[3] % 2:
        return None
    topic, at = _integer(record, at, kinds[1])
    log_ns, at = _integer(record, at, kinds[2])
    if at + (kinds[3] - 12) // 2 != len(record):
        return None
    return number, topic, log_ns, record[at:]


def _integer(record: bytes, at: int, kind: int) -> tuple[int, int]:
    size = _INTEGERS[kind]
    value = int.from_bytes(record[at : at + size], "big", signed=True) if size else kind - 8
    return value, at + size


def _varint(data: bytes, at: int) -> tuple[int, int]:
    """Return a number of one to nine bytes, seven bits in each but the ninth, and its end."""
    value = 0
    for k in range(8):
        byte = data[at + k]
        value = value << 7 | byte & 0x7F
        if byte < 0x80:
            return value, at + k + 1
    return value << 8 | data[at + 8], at + 9
