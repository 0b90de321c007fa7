"""Messages to the page: text is JSON, rows are binary."""

from __future__ import annotations

import json
import struct
from typing import Any

from auv_msgs_py.values.strict_json import without_nan
from auv_sim.views.console.record.history import Rows

PROTOCOL = 1
#: Vehicle, epoch, number of the first row, number of rows.
ROWS_HEADER = struct.Struct("<4I")


def text_of(kind: str, **content: Any) -> str:
    """Return a message as JSON; a number that is not finite becomes null."""
    return json.dumps(without_nan({"kind": kind, **content}), separators=(",", ":"), allow_nan=False)


def rows_message(vehicle: int, epoch: int, first: int, rows: Rows) -> bytes:
    """Return rows as a binary message.

    Args:
        vehicle: its index.
        epoch: number of the row table.
        first: rows taken before these.
        rows: (n, columns).
    """
    head = ROWS_HEADER.pack(vehicle, epoch, first, len(rows))
    return head + rows.astype("<f4", copy=False).tobytes()
