"""A console server without ROS that plays a recorded flight; tests advance it and see what was requested.

cd test && python3 -m console_fake [--mission helix] [--rows 900]    # look at the page by hand
"""

from __future__ import annotations

import argparse
import asyncio
import json
import math
import struct
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import aiohttp
import yaml
from aiohttp import web

import console_flight
from console_gains import GAINS
from console_wire import beat, finite, send

PAGE = Path(__file__).resolve().parents[1] / "src/auv_sim/auv_sim/views/console/page"
CSP = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'"
)
NODES = ("plant", "current_observer", "guidance", "heading_autopilot", "recorder")


async def _no_wait() -> None:
    pass


class FakeConsole:
    """The server's side of the protocol for one recorded flight and any number of browsers.

    Attributes:
        quiet: waits until the page has an answer to everything that it has requested.
        serial: number of the newest state; the page has it in its tick.
        busy: number of requests that are being answered.
    """

    def __init__(self, mission: str = "survey_wgs84", vehicles: int = 1) -> None:
        self.rows, self.course = console_flight.recorded(mission)
        self.vehicles, self.flown, self.started = vehicles, 0, "first"
        self.state, self.reason = "idle", "waiting for the start service"
        self.ready, self.silent = True, ""
        self._asked: list[dict[str, Any]] = []
        self.quiet: Callable[[], Awaitable[None]] = _no_wait
        self.serial = self.busy = 0
        self._sending = asyncio.Lock()
        self.alarms: list[dict[str, Any]] = []
        self.events: list[dict[str, Any]] = []
        self.gains = [dict(one) for one in GAINS]
        self.browsers: list[web.WebSocketResponse] = []
        self.may_command = True
        self._server: web.AppRunner | None = None
        self.port = 0

    async def start(self, port: int = 0) -> str:
        """Listen; return the address."""
        app = web.Application()
        app.router.add_get("/", self._page)
        app.router.add_get("/socket", self._socket)
        app.router.add_get("/left", self._left)
        app.router.add_get("/page/{name}", self._file)
        self._server = web.AppRunner(app, shutdown_timeout=0.2)
        await self._server.setup()
        await web.TCPSite(self._server, "127.0.0.1", port).start()
        self.port = self._server.addresses[0][1]
        return f"http://127.0.0.1:{self.port}/"

    async def stop(self) -> None:
        """Close every socket and stop listening."""
        for browser in self.browsers:
            await browser.close()
        self.browsers = []
        assert self._server is not None
        await self._server.cleanup()

    async def _page(self, _: web.Request) -> web.StreamResponse:
        return web.FileResponse(PAGE / "console.html", headers={"Content-Security-Policy": CSP})

    async def _left(self, _: web.Request) -> web.StreamResponse:
        return web.Response(
            text="<title>left</title><link rel='icon' href='data:,'>", content_type="text/html"
        )

    async def _file(self, request: web.Request) -> web.StreamResponse:
        file = PAGE / request.match_info["name"]
        if file.parent != PAGE or not file.is_file():
            raise web.HTTPNotFound
        kind = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}[file.suffix]
        return web.FileResponse(file, headers={"Content-Type": kind})

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        async with self._sending:  # the record first, as it is now, then all that changes
            self.browsers.append(socket)
            for message in self._first():
                await send(socket, message)
        beating = asyncio.create_task(beat(socket))
        try:
            async for message in socket:
                if message.type == aiohttp.WSMsgType.TEXT:
                    await self._take(socket, json.loads(message.data))
        finally:
            beating.cancel()
            if socket in self.browsers:
                self.browsers.remove(socket)
        return socket

    async def _take(self, socket: web.WebSocketResponse, request: dict[str, Any]) -> None:
        self.busy += 1
        try:
            self._asked.append(request)
            answer = {"ok": True, "message": "", **self._answer(request)}
            await send(socket, {"kind": "answer", "id": request.get("id"), **answer})
            await self.publish()
        finally:
            self.busy -= 1

    async def requests(self, *kinds: str) -> list[dict[str, Any]]:
        """Return all that the page has requested until now, or what is of some kinds (`do`)."""
        await self.quiet()
        return [one for one in self._asked if not kinds or one["do"] in kinds]

    def _first(self) -> list[Any]:
        columns = [
            {"name": n, "unit": unit, "label": label} for n, (unit, label) in console_flight.COLUMNS.items()
        ]
        names = [
            {"index": k, "namespace": f"/auv{k + 1}", "name": f"auv{k + 1}"} for k in range(self.vehicles)
        ]
        hello = {
            "kind": "hello", "protocol": 1, "viewer": len(self.browsers), "may_command": self.may_command,
            "started": self.started, "vehicles": names, "columns": columns, "nodes": NODES,
        }  # fmt: skip
        messages: list[Any] = [hello]
        for k in range(self.vehicles):
            messages += [
                self._shifted(k), {"kind": "begin", "vehicle": k, "epoch": 1, "t0": 1.0},
                self._packed(k, 0, self.flown), {"kind": "events", "vehicle": k, "events": self.events},
                {"kind": "alarms", "vehicle": k, "alarms": self.alarms if k == 0 else []}, self._tick(k),
            ]  # fmt: skip
        return messages

    def _shifted(self, k: int) -> dict[str, Any]:
        path = [[x + 90.0 * k, y, z, s] for x, y, z, s in self.course["path"]]
        return {**self.course, "vehicle": k, "path": path}

    def _packed(self, k: int, first: int, last: int) -> bytes:
        rows = self.rows[first:last].copy()
        rows[:, 1] += 90.0 * k
        return struct.pack("<4I", k, 1, first, last - first) + rows.astype("<f4").tobytes()

    def _tick(self, k: int) -> dict[str, Any]:
        row = dict(zip(console_flight.COLUMNS, self.rows[max(0, self.flown - 1)].tolist(), strict=True))
        length, yaw = self.course["mission"]["length"], row["yaw_ref"]
        share = max(0.0, min(1.0, row["s"] / length)) if self.flown else 0.0
        ahead = [row["x"] + 90.0 * k + 4.0 * math.cos(yaw), row["y"] + 4.0 * math.sin(yaw), row["z"]]
        speed = math.hypot(row["ve"], row["vn"]) or 1.0
        current = [row["current_east"], row["current_north"], 0.0]
        health = [
            {"node": n, "age": 31.4 if n == self.silent else 0.2 + 0.1 * i,
             "level": 3 if n == self.silent else 0, "message": "silent" if n == self.silent else "OK"}
            for i, n in enumerate(NODES)
        ]  # fmt: skip
        running = self.state in ("running", "holding")
        return finite({
            "kind": "tick", "serial": self.serial,
            "vehicle": k, "now": 1.0 + row["t"], "state": self.state, "reason": self.reason,
            "mission_time": row["t"], "length": length, "flown": share * length, "share": share,
            "time_to_go": (1 - share) * length / speed,
            "next_joint": {"kind": "line to arc", "distance": 41.0, "time": 41.0 / speed}
            if running else None,
            "pose": [row["x"] + 90.0 * k, row["y"], row["z"], row["yaw"], row["pitch"]],
            "virtual_point": ahead if running else None, "current": current if self.flown else None,
            "covariance": [1.6, 0.4, 0.7], "health": health,
            "preflight": {"ready": self.ready, "items": [
                {"name": "nodes heard", "ok": True, "text": "5 of 5"},
                {"name": "navigation fresh", "ok": self.ready, "text": f"{0.1 if self.ready else 2.4} s old"},
                {"name": "plan check", "ok": True, "text": "flyable"}]},
            "can": {"start": not running, "hold": self.state == "running",
                    "resume": self.state == "holding", "abort": True},
        })  # fmt: skip

    def _answer(self, request: dict[str, Any]) -> dict[str, Any]:
        words = {"start": "running", "hold": "holding", "resume": "running", "abort": "aborted"}
        match request["do"]:
            case "start" | "hold" | "resume" | "abort" as what:
                self.state, self.reason = words[what], f"{what} was called"
                self.log("operator", f"browser 1: {what}", "warning" if what == "abort" else "info")
                return {"message": self.state}
            case "missions":
                return {"missions": [{"name": n, "description": "shipped"} for n in console_flight.MISSIONS]}
            case "mission_text":
                return {"text": f"version: 1\nname: {request['name']}\nthrust: 6.48\n"}
            case "check":
                return self._checked(request["text"])
            case "load":
                running = self.state == "running"
                message = "mission_text: not while running" if running else "loaded"
                return {"ok": not running, "message": message}
            case "parameters":
                return {"nodes": [{"node": "heading_autopilot", "parameters": self.gains}]}
            case "set":
                return self._set(request["name"], request["value"])
            case "parameter_file":
                return {"text": "heading_autopilot:\n  ros__parameters:\n    autopilot.nism.k3: 1.4\n"}
            case "acknowledge":
                (one,) = (alarm for alarm in self.alarms if alarm["id"] == request["alarm"])
                one["acknowledged"] = True
                self.alarms = [one for one in self.alarms if one["active"] or not one["acknowledged"]]
                return {}
        return {"ok": False, "message": f"not understood: {request['do']}"}

    def _checked(self, text: str) -> dict[str, Any]:
        thrust = (yaml.safe_load(text) or {}).get("thrust")
        if not isinstance(thrust, int | float) or thrust < 0:
            return {"ok": False, "lines": [f"thrust: found {thrust}, expected a number from 0 to 100 N"]}
        course = {key: value for key, value in self.course.items() if key not in ("kind", "vehicle")}
        return {"ok": True, "lines": ["flyable: the tightest turn has a radius of 12.0 m"], "course": course}

    def _set(self, name: str, value: float) -> dict[str, Any]:
        one = next(gain for gain in self.gains if gain["name"] == name)
        if not one["minimum"] <= value <= one["maximum"]:
            return {"ok": False, "message": f"Parameter {name} out of range Min: {one['minimum']}, "
                    f"Max: {one['maximum']}, value: {value}"}  # fmt: skip
        one["value"] = value
        return {}

    def log(self, source: str, text: str, level: str = "info") -> None:
        """Add an event."""
        time = float(self.rows[max(0, self.flown - 1), 0])
        event = {"id": len(self.events), "mission_time": time, "wall": "13:05:07", "source": source,
                 "level": level, "text": text}  # fmt: skip
        self.events.append(event)

    async def advance(self, rows: int) -> None:
        """Fly on by some rows and send them."""
        first, self.flown = self.flown, min(len(self.rows), self.flown + rows)
        for k in range(self.vehicles):
            await self.send(self._packed(k, first, self.flown))
        await self.publish()

    async def until(self, condition: Callable[[], bool]) -> None:
        """Wait until the page has made a condition true."""
        for _ in range(9000):
            if condition():
                return
            await asyncio.sleep(0.02)
        raise AssertionError(f"not true within 180 s, last requests: {self._asked[-3:]}")

    async def publish(self) -> None:
        """Send the state, the events and the alarms to every browser."""
        self.serial += 1
        for k in range(self.vehicles):
            await self.send({"kind": "events", "vehicle": k, "events": self.events[-5:]})
            await self.send({"kind": "alarms", "vehicle": k, "alarms": self.alarms if k == 0 else []})
            await self.send(self._tick(k))

    async def send(self, message: Any) -> None:
        """Send a message to every browser."""
        async with self._sending:
            for browser in list(self.browsers):
                if not browser.closed:
                    await send(browser, message)


async def _by_hand(mission: str, rows: int, vehicles: int) -> None:
    fake = FakeConsole(mission, vehicles)
    print(await fake.start(8649))
    while True:
        await fake.advance(rows)
        rows = 1
        await asyncio.sleep(0.5)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--mission", default="survey_wgs84", choices=console_flight.MISSIONS)
    parser.add_argument("--rows", type=int, default=900)
    parser.add_argument("--vehicles", type=int, default=1)
    options = parser.parse_args()
    asyncio.run(_by_hand(options.mission, options.rows, options.vehicles))
