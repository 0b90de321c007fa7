"""Messages to the page: text is JSON, rows are binary."""

from __future__ import annotations

import json
import math
import struct
from typing import Any

from auv_sim.views.console.record.history import Rows

PROTOCOL = 1
#: Vehicle, epoch, number of the first row, number of rows.
ROWS_HEADER = struct.Struct("<4I")


def text_of(kind: str, **content: Any) -> str:
    """Return a message as JSON; a number that is not finite becomes null."""
    return json.dumps(_finite({"kind": kind, **content}), separators=(",", ":"), allow_nan=False)


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


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(each) for each in value]
    return value
