"""The console's web server: the page, its files, and the socket for all that moves."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
import socket as sockets
from collections.abc import Awaitable, Callable, Iterable, Mapping
from typing import Any

from aiohttp import WSMsgType, web

from auv_sim.views.console.record.fault_log import FaultLog
from auv_sim.views.console.record.track_columns import COLUMNS
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.record.wire_messages import PROTOCOL, text_of
from auv_sim.views.console.web.operator_desk import LONGEST, OperatorDesk
from auv_sim.views.console.web.page_files import FRONT, PageFile
from auv_sim.views.console.web.page_guard import HEADERS, PageGuard
from auv_sim.views.console.web.page_sessions import LIFETIME
from auv_sim.views.console.web.viewer import Message, Viewer

#: Period at which changes are sent, s.
PERIOD = 0.1
#: A browser that does not answer a ping for half of this is cut off, s.
HEARTBEAT = 10.0
#: Bytes that the system buffers for a browser: a ping must not stand behind more.
_SEND_BUFFER = 262_144
#: Most browsers at once.
_MOST_VIEWERS = 50
_FORBIDDEN = "403: open the address that the console printed"
_Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class PageServer:
    """Serves browsers.

    Args:
        vehicles: all of them; the list grows as they are discovered.
        desk: takes the requests of browsers.
        guard: judges every request.
        files: of the page, by name.
        faults: logs what fails.
    """

    def __init__(
        self,
        vehicles: list[VehicleRecord],
        desk: OperatorDesk,
        guard: PageGuard,
        files: Mapping[str, PageFile],
        faults: FaultLog,
    ) -> None:
        self._vehicles, self._desk, self._guard, self._files = vehicles, desk, guard, files
        self._faults = faults
        self._started = secrets.token_hex(8)
        self._viewers: set[Viewer] = set()
        self._count = 0
        self._answers: set[asyncio.Task[None]] = set()

    def application(self) -> web.Application:
        """Return the application."""
        app = web.Application(middlewares=[self._judge], client_max_size=16_384)
        app.router.add_get("/", self._front)
        app.router.add_get("/page/{name:.+}", self._file)
        app.router.add_get("/socket", self._socket, allow_head=False)
        app.on_response_prepare.append(_add_headers)
        app.on_shutdown.append(self._end)
        app.cleanup_ctx.append(self._ticking)
        return app

    @property
    def viewers(self) -> int:
        """Number of open pages."""
        return len(self._viewers)

    def has_viewer(self, number: int) -> bool:
        """Return whether a browser is still there."""
        return any(viewer.number == number for viewer in self._viewers)

    def publish(self, messages: Iterable[Message]) -> None:
        """Send messages to every browser."""
        found = list(messages)
        for viewer in tuple(self._viewers):
            viewer.put(found)

    def greet_again(self) -> None:
        """Send the list of vehicles to every browser, after one was discovered."""
        for viewer in tuple(self._viewers):
            viewer.put([self._hello(viewer)])

    def look(self) -> None:
        """Send what has changed."""
        now = asyncio.get_running_loop().time()
        for vehicle in self._vehicles:
            with self._faults.guard(f"{vehicle.namespace} changes"):
                self.publish(vehicle.changes(now))

    @web.middleware
    async def _judge(self, request: web.Request, handler: _Handler) -> web.StreamResponse:
        if not self._guard.is_own_host(request.headers.get("Host")):
            return web.Response(status=421, text="421: not a name of this console")
        if request.method not in ("GET", "HEAD"):
            return web.Response(status=405, text="405: GET only", headers={"Allow": "GET, HEAD"})
        token = request.query.get("token")
        if request.path == "/" and token is not None:
            return self._enter(request, token)
        if self._may_command(request) is None:
            return web.Response(status=403, text=_FORBIDDEN)
        return await handler(request)

    def _enter(self, request: web.Request, token: str) -> web.Response:
        """Turn a token into a cookie, out of the address; the one to look takes no control away."""
        response = web.Response(status=303, headers={"Location": "/"})
        if self._guard.commands_already(token, self._cookie(request)):
            return response
        session = self._guard.session_of(token)
        if session is None:
            return web.Response(status=403, text=_FORBIDDEN)
        self._set_cookie(request, response, session)
        return response

    def _cookie(self, request: web.Request) -> str | None:
        return request.cookies.get(self._guard.cookie_name(request.headers.get("Host")))

    def _set_cookie(self, request: web.Request, response: web.StreamResponse, cookie: str) -> None:
        name = self._guard.cookie_name(request.headers.get("Host"))
        response.set_cookie(name, cookie, httponly=True, samesite="Strict", path="/", max_age=int(LIFETIME))

    def _renew(self, request: web.Request, response: web.StreamResponse) -> None:
        cookie = self._cookie(request)
        if cookie is not None:
            self._guard.renew(cookie)
            self._set_cookie(request, response, cookie)

    def _may_command(self, request: web.Request) -> bool | None:
        return self._guard.may_command(self._cookie(request))

    async def _front(self, request: web.Request) -> web.StreamResponse:
        response = self._content(FRONT)
        self._renew(request, response)
        return response

    async def _file(self, request: web.Request) -> web.StreamResponse:
        return self._content(request.match_info["name"])

    def _content(self, name: str) -> web.Response:
        file = self._files.get(name)
        if file is None:
            return web.Response(status=404, text="404: no such file")
        try:
            body = file.path.read_bytes()
        except OSError:
            return web.Response(status=404, text="404: the file is gone")
        return web.Response(body=body, content_type=file.type, charset="utf-8")

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        if not self._guard.is_own_origin(request.headers.get("Origin"), request.headers.get("Host")):
            return web.Response(status=403, text="403: a page of another origin")
        if len(self._viewers) >= _MOST_VIEWERS:
            return web.Response(status=503, text="503: too many browsers")
        socket = web.WebSocketResponse(heartbeat=HEARTBEAT, max_msg_size=LONGEST, compress=False)
        self._renew(request, socket)
        await socket.prepare(request)
        _bound_buffer(request.transport)
        self._count += 1
        viewer = Viewer(self._count, socket, request.transport, bool(self._may_command(request)))
        self.look()  # so that what is new is sent to the others, and to this one once
        self._viewers.add(viewer)
        viewer.put([self._hello(viewer)])
        now = asyncio.get_running_loop().time()
        for vehicle in self._vehicles:
            with self._faults.guard(f"{vehicle.namespace} record"):
                viewer.put(vehicle.whole(now), is_first=True)
        try:
            await self._listen(socket, viewer)
        finally:
            self._viewers.discard(viewer)
            await viewer.close()
        return socket

    async def _listen(self, socket: web.WebSocketResponse, viewer: Viewer) -> None:
        """Take requests until the browser leaves or floods."""
        async for message in socket:
            if message.type is not WSMsgType.TEXT:
                continue
            if viewer.floods(asyncio.get_running_loop().time()):
                viewer.cut()
                return
            task = asyncio.create_task(self._answer(message.data, viewer))
            self._answers.add(task)
            task.add_done_callback(self._answers.discard)
            await asyncio.sleep(0)  # a socket with many requests must not keep the others waiting

    async def _answer(self, text: str, viewer: Viewer) -> None:
        viewer.put([await self._desk.answer(text, viewer)])

    def _hello(self, viewer: Viewer) -> str:
        names = [name for vehicle in self._vehicles for name in vehicle.health.names]
        return text_of(
            "hello", protocol=PROTOCOL, viewer=viewer.number, may_command=viewer.may_command,
            started=self._started,
            vehicles=[
                {"index": each.index, "namespace": each.namespace, "name": each.namespace.strip("/") or "/"}
                for each in self._vehicles
            ],
            columns=[column._asdict() for column in COLUMNS],
            nodes=list(dict.fromkeys(names)),
        )  # fmt: skip

    async def _ticking(self, _: web.Application) -> Any:
        task = asyncio.create_task(self._tick())
        yield
        task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await task

    async def _tick(self) -> None:
        while True:
            self.look()
            await asyncio.sleep(PERIOD)

    async def _end(self, _: web.Application) -> None:
        for viewer in tuple(self._viewers):
            viewer.cut()


async def _add_headers(_: web.Request, response: web.StreamResponse) -> None:
    response.headers.update(HEADERS)


def _bound_buffer(transport: asyncio.BaseTransport | None) -> None:
    connection = transport.get_extra_info("socket") if transport is not None else None
    if connection is not None:
        with contextlib.suppress(OSError):
            connection.setsockopt(sockets.SOL_SOCKET, sockets.SO_SNDBUF, _SEND_BUFFER)
