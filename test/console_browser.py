"""A browser of a running console, for tests that are not asynchronous."""

from __future__ import annotations

import asyncio
import json
import re
import subprocess
from collections.abc import Callable
from typing import Any

import aiohttp
import numpy as np
from aiohttp import ClientWebSocketResponse

from auv_sim.views.console.record.track_columns import NAMES, PLACE
from auv_sim.views.console.record.wire_messages import ROWS_HEADER

_PATIENCE = 180.0
#: Requests that may come twice; a node that the machine pauses for a second answers them too late.
_OF_VALUES = ("set", "load", "check")


class ConsoleBrowser:
    """Opens the console's socket for each look or request; its cookie stays.

    Args:
        address: that the console printed, with its token.

    Attributes:
        rows: of the first vehicle, as it was received last, stamps in place of t.
        texts: the newest message of each kind.
        events: the texts of all events.
    """

    def __init__(self, address: str) -> None:
        self.address = address
        self._origin = address.partition("/?")[0]
        self._cookie = ""
        self._clear()

    def _clear(self) -> None:
        self.rows = np.empty((0, len(NAMES)))
        self.texts: dict[str, dict[str, Any]] = {}
        self.events: list[str] = []

    def column(self, name: str) -> np.ndarray[Any, Any]:
        """Return a column of the rows."""
        found: np.ndarray[Any, Any] = self.rows[:, PLACE[name]]
        return found

    def until(self, condition: Callable[[], object]) -> None:
        """Receive everything anew, until a condition holds."""
        asyncio.run(self._until(condition))

    def ask(self, do: str, **fields: Any) -> dict[str, Any]:
        """Return the answer to a request; one of `_OF_VALUES` is repeated while a node answers too late."""
        request = {"id": 1, "do": do, "vehicle": 0, "namespace": "/auv", **fields}
        for _ in range(5):
            asyncio.run(self._until(lambda: "answer" in self.texts, json.dumps(request)))
            if do not in _OF_VALUES or "did not answer within" not in self.texts["answer"].get("message", ""):
                break
        return self.texts["answer"]

    async def _until(self, condition: Callable[[], object], request: str = "") -> None:
        self._clear()
        try:
            await asyncio.wait_for(self._connected(condition, request), _PATIENCE)
        except TimeoutError:
            raise AssertionError(self.texts.get("tick"), self.events) from None

    async def _connected(self, condition: Callable[[], object], request: str) -> None:
        async with aiohttp.ClientSession() as session:
            if not self._cookie:
                async with session.get(self.address, allow_redirects=False) as entered:
                    (cookie,) = entered.cookies.values()
                    self._cookie = f"{cookie.key}={cookie.value}"
            headers = {"Cookie": self._cookie, "Origin": self._origin}
            url = self._origin.replace("http", "ws") + "/socket"
            async with session.ws_connect(url, headers=headers, max_msg_size=0) as socket:
                if request:
                    await socket.send_str(request)
                await self._receive(socket, condition)

    async def _receive(self, socket: ClientWebSocketResponse, condition: Callable[[], object]) -> None:
        """Receive until the condition holds at the end of a look: a tick follows what has changed with it."""
        t0, kind = 0.0, ""
        while not (kind in ("tick", "answer") and "tick" in self.texts and condition()):
            message, kind = await socket.receive(), ""
            if message.type is aiohttp.WSMsgType.BINARY:
                values = np.frombuffer(message.data[ROWS_HEADER.size :], "<f4").astype(float)
                rows = values.reshape(-1, len(NAMES))
                rows[:, 0] += t0
                self.rows = np.vstack([self.rows, rows])
                continue
            assert message.type is aiohttp.WSMsgType.TEXT, message
            found = json.loads(message.data)
            kind = found["kind"]
            self.texts[kind] = found
            if kind == "begin":
                t0, self.rows = found["t0"] or 0.0, self.rows[:0]
            elif kind == "events":
                self.events += [event["text"] for event in found["events"]]


def address_of(console: subprocess.Popen[str]) -> str:
    """Return the address that a process has printed for control."""
    assert console.stdout is not None
    for line in console.stdout:
        if found := re.match(r"console: (http://127\.0\.0\.1:\d+/\?token=\S+)$", line):
            return found[1]
    raise AssertionError("the console ended without an address")
