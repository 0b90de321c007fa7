"""How the fake console puts messages on its sockets."""

from __future__ import annotations

import asyncio
import contextlib
import json
from typing import Any

import numpy as np
from aiohttp import web


async def beat(socket: web.WebSocketResponse) -> None:
    """Send every second an answer that the page does not wait for: it gives up a server silent for 5 s."""
    while not socket.closed:
        await send(socket, {"kind": "answer", "id": None})
        await asyncio.sleep(1.0)


async def send(socket: web.WebSocketResponse, message: Any) -> None:
    """Send rows (bytes) or a message to a browser, which may have left."""
    with contextlib.suppress(ConnectionError):
        if isinstance(message, bytes):
            await socket.send_bytes(message)
        else:
            await socket.send_str(json.dumps(finite(message), allow_nan=False))


def finite(value: Any) -> Any:
    """Return a message with null in place of every number that JSON does not have."""
    if isinstance(value, dict):
        return {key: finite(one) for key, one in value.items()}
    if isinstance(value, list):
        return [finite(one) for one in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value
