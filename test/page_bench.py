"""A console's server without a graph: fake vehicles and deeds, and a browser of aiohttp."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import aiohttp
from aiohttp import ClientWebSocketResponse
from aiohttp.test_utils import TestClient, TestServer

from auv_sim.views.console.record.fault_log import FaultLog
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.web.operator_desk import Answer, OperatorDesk
from auv_sim.views.console.web.page_files import FRONT, PageFile
from auv_sim.views.console.web.page_guard import PageGuard, new_tokens
from auv_sim.views.console.web.page_server import PageServer
from auv_sim.views.console.web.page_sessions import PageSessions


async def _failing(_: VehicleRecord, __: int, ___: Mapping[str, Any]) -> Answer:
    raise OverflowError("of a bug")


class PageBench:
    """One server, with one vehicle, and what its operators have done."""

    def __init__(self, view_only: bool = False, names: tuple[str, ...] = ()) -> None:
        self.vehicles = [VehicleRecord(0, "/auv")]
        self.now = 0.0
        self.faults: list[str] = []
        self.done: list[tuple[str, int]] = []
        self.tokens = new_tokens(view_only)
        self.may_answer = asyncio.Event()
        self.may_answer.set()
        self.guard = PageGuard(self.tokens, names, PageSessions(None, lambda: self.now))
        looks = {"missions": self._deed("missions")}
        commands = {name: self._deed(name) for name in ("start", "abort", "hold")}
        commands["resume"] = _failing
        files = {FRONT: PageFile(Path(__file__), "text/html")}
        desk = OperatorDesk(self.vehicles, looks, commands)
        self.server = PageServer(
            self.vehicles, desk, self.guard, files, FaultLog(self.faults.append, lambda: 0.0)
        )
        self.client: TestClient[Any, Any]

    def _deed(self, name: str) -> Callable[[VehicleRecord, int, Mapping[str, Any]], Awaitable[Answer]]:
        async def act(_: VehicleRecord, viewer: int, __: Mapping[str, Any]) -> Answer:
            if name != "abort":
                await self.may_answer.wait()
            self.done.append((name, viewer))
            return Answer(True, f"{name} was called", {"missions": []} if name == "missions" else {})

        return act

    @property
    def cookie_name(self) -> str:
        return f"auv_console_{self.client.port}"

    @property
    def origin(self) -> str:
        return str(self.client.make_url("/")).rstrip("/")

    async def cookie(self, token: str) -> dict[str, str]:
        """Turn a token into the headers of a browser that has its cookie."""
        response = await self.client.get("/", params={"token": token}, allow_redirects=False)
        assert response.status == 303, await response.text()
        self.client.session.cookie_jar.clear()
        return {"Cookie": f"{self.cookie_name}={response.cookies[self.cookie_name].value}"}

    async def browser(self, token: str = "") -> ClientWebSocketResponse:
        """Open the socket as the page does."""
        headers = {**await self.cookie(token or self.tokens.control), "Origin": self.origin}
        return await self.client.ws_connect("/socket", headers=headers)


@asynccontextmanager
async def page_bench(**options: Any) -> AsyncIterator[PageBench]:
    bench = PageBench(**options)
    bench.client = TestClient(TestServer(bench.server.application()), cookie_jar=aiohttp.DummyCookieJar())
    async with bench.client:
        yield bench


async def heard(socket: ClientWebSocketResponse, kind: str, **fields: Any) -> dict[str, Any]:
    """Return the next text message of a kind with these fields."""
    while True:
        message = await socket.receive(timeout=180.0)
        assert message.type in (aiohttp.WSMsgType.TEXT, aiohttp.WSMsgType.BINARY), message
        if message.type is aiohttp.WSMsgType.TEXT:
            found: dict[str, Any] = json.loads(message.data)
            if found["kind"] == kind and all(found.get(name) == value for name, value in fields.items()):
                return found


async def asked(socket: ClientWebSocketResponse, **request: Any) -> dict[str, Any]:
    """Send a request and return its answer."""
    await socket.send_str(json.dumps(request))
    return await heard(socket, "answer", id=request.get("id"))
