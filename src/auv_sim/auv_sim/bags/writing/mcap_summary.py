"""The summary at the end of an MCAP file: the index by which readers find chunks and topics."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence

from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import ChunkIndex, Footer, McapRecord, SummaryOffset


class ChunkIndexes:
    """The chunk indexes of a file, compressed in memory: a recorder makes 7,200 an hour."""

    def __init__(self) -> None:
        self.count = 0
        self._packer = zlib.compressobj()
        self._packed = bytearray()

    def append(self, index: ChunkIndex) -> None:
        """Add the index of one more chunk."""
        builder = RecordBuilder()
        index.write(builder)
        self._packed += self._packer.compress(builder.end())  # type: ignore[no-untyped-call]
        self.count += 1

    def write(self, builder: RecordBuilder) -> None:
        """Write all of them; call once, as the last."""
        self._packed += self._packer.flush()
        builder.write(zlib.decompress(bytes(self._packed)))


#: Records of one kind, in the order of the summary.
Group = tuple[Opcode, Sequence[McapRecord | ChunkIndexes]]


def summary(start: int, groups: Sequence[Group]) -> bytes:
    """Return the records of all groups, where each group begins, and the footer with their checksum.

    Args:
        start: where the summary begins in the file, bytes.
        groups: what it holds.
    """
    builder = RecordBuilder()
    offsets = []
    for opcode, records in groups:
        begin = builder.count
        for record in records:
            record.write(builder)
        if records:
            length = builder.count - begin
            offsets.append(SummaryOffset(group_opcode=opcode, group_start=start + begin, group_length=length))
    offset_start = start + builder.count
    for offset in offsets:
        offset.write(builder)
    content: bytes = builder.end()  # type: ignore[no-untyped-call]
    head = struct.pack("<BQQQ", Opcode.FOOTER, 20, start, offset_start)
    crc = zlib.crc32(head, zlib.crc32(content))
    Footer(summary_start=start, summary_offset_start=offset_start, summary_crc=crc).write(builder)
    footer: bytes = builder.end()  # type: ignore[no-untyped-call]
    return content + footer
