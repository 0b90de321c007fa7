"""One browser: its own buffer and its own task, so that a slow one delays no other."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
from collections import deque
from collections.abc import Iterable

from aiohttp import web

Message = str | bytes

#: A browser that is this far behind is cut off, bytes.
MOST_BEHIND = 4_000_000
#: More requests than this within a second are a flood.
MOST_REQUESTS = 100
#: More unanswered requests than this are refused; an abort is not.
MOST_PENDING = 16


class Viewer:
    """A browser's socket.

    Args:
        number: of the browser, from 1.
        socket: prepared.
        transport: below it; None where the browser has gone already.
        may_command: whether its requests to the vehicle are taken.
    """

    def __init__(
        self,
        number: int,
        socket: web.WebSocketResponse,
        transport: asyncio.BaseTransport | None,
        may_command: bool,
    ) -> None:
        self.number, self.may_command = number, may_command
        self.pending = 0
        self._socket, self._transport = socket, transport
        self._queue: deque[Message] = deque()
        self._behind = self._allowed = 0
        self._has_more = asyncio.Event()
        self._is_cut = False
        self._second, self._requests = 0, itertools.count(1)
        self._task = asyncio.create_task(self._send())

    def put(self, messages: Iterable[Message], is_first: bool = False) -> None:
        """Queue messages; cut the browser off where it is too far behind.

        Args:
            messages: to send.
            is_first: the whole record, which is excluded from the limit.
        """
        for message in messages:
            self._queue.append(message)
            self._behind += len(message)
            self._allowed += len(message) * is_first
        if self._behind > MOST_BEHIND + self._allowed:
            self.cut()
        self._has_more.set()

    def floods(self, now: float) -> bool:
        """Count a request at steady time `now`, s; return whether there are too many in this second."""
        if int(now) != self._second:
            self._second, self._requests = int(now), itertools.count(1)
        return next(self._requests) > MOST_REQUESTS

    def cut(self) -> None:
        """End the connection without waiting for the browser."""
        self._is_cut = True
        self._queue.clear()
        if isinstance(self._transport, asyncio.WriteTransport):
            self._transport.abort()

    async def close(self) -> None:
        """End the task."""
        self._task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await self._task

    async def _send(self) -> None:
        while not self._is_cut:
            self._has_more.clear()
            while self._queue:
                message = self._queue.popleft()
                try:
                    if isinstance(message, bytes):
                        await self._socket.send_bytes(message)
                    else:
                        await self._socket.send_str(message)
                except (ConnectionError, RuntimeError):  # it has gone
                    return
                self._behind -= len(message)
                self._allowed = min(self._allowed, self._behind)
            await self._has_more.wait()
