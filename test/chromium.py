"""A real Chromium, driven by its DevTools protocol over aiohttp: mouse, keys, pictures, requests."""

from __future__ import annotations

import asyncio
import base64
import json
import os
import shutil
import signal
import subprocess
import threading
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import aiohttp

EXECUTABLE = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
_FLAGS = (
    "--headless=new", "--no-sandbox", "--remote-debugging-port=0", "--no-first-run", "--disable-gpu",
    "--disable-extensions", "--disable-background-networking", "--disable-component-update",
    "--disable-dev-shm-usage", "--mute-audio", "--hide-scrollbars",
)  # fmt: skip
#: How long anything may take on a busy machine, s.
_PATIENCE = 180.0


class Tab:
    """One page: commands, evaluation, input, and the events that came."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self._socket, self._next, self._pending = socket, 0, dict[int, asyncio.Future[Any]]()
        self._page = "nothing yet"
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self._reader = asyncio.create_task(self._read())

    async def _read(self) -> None:
        async for message in self._socket:
            data = json.loads(message.data)
            if "id" in data:
                self._pending.pop(data["id"]).set_result(data)
            else:
                self._hear(data["method"], data["params"])

    def _hear(self, method: str, params: dict[str, Any]) -> None:
        match method:
            case "Network.requestWillBeSent" if params["documentURL"].startswith(self._page):
                self.requests.append(params["request"]["url"])
            case "Network.webSocketCreated":
                self.requests.append(params["url"])
            case "Runtime.exceptionThrown":
                self.complaints.append(json.dumps(params["exceptionDetails"])[:600])
            case "Runtime.consoleAPICalled" if params["type"] in ("error", "warning", "assert"):
                self.complaints.append(json.dumps(params["args"])[:600])
            case "Log.entryAdded" if params["entry"]["level"] in ("error", "warning"):
                self.complaints.append(f"{params['entry']['text']} {params['entry'].get('url', '')}")

    async def call(self, method: str, **params: Any) -> Any:
        """Send a command of the protocol; return its result."""
        self._next += 1
        future = self._pending[self._next] = asyncio.get_running_loop().create_future()
        await self._socket.send_str(json.dumps({"id": self._next, "method": method, "params": params}))
        data = await asyncio.wait_for(future, _PATIENCE)
        assert "error" not in data, f"{method}: {data.get('error')}"
        return data["result"]

    async def value(self, expression: str) -> Any:
        """Evaluate an expression, which may be a promise, in the page."""
        found = await self.call(
            "Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in found, json.dumps(found["exceptionDetails"])[:800]
        return found["result"].get("value")

    async def until(self, expression: str, seconds: float = _PATIENCE) -> None:
        """Wait until an expression is true."""
        for _ in range(int(seconds / 0.05)):
            if await self.value(f"(async () => !!(await ({expression})))()"):
                return
            await asyncio.sleep(0.05)
        raise AssertionError(f"not true within {seconds} s: {expression}")

    async def open(self, url: str) -> None:
        """Load a page from the beginning."""
        self._page = url.partition("?")[0]
        await self.call("Page.navigate", url=url)
        await self.until("document.readyState === 'complete'")

    async def size(self, width: int, height: int, mobile: bool = False) -> None:
        """Set the size of the window, CSS px."""
        await self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                        deviceScaleFactor=2 if mobile else 1, mobile=mobile)  # fmt: skip

    async def window(self, state: str) -> None:
        """Set the state of the browser's window: normal or minimized, which hides the page."""
        found = await self.call("Browser.getWindowForTarget")
        await self.call("Browser.setWindowBounds", windowId=found["windowId"], bounds={"windowState": state})

    async def middle(self, selector: str) -> tuple[float, float]:
        """Return the middle of an element, which is scrolled into sight."""
        found = await self.value(
            f"(() => {{ const e = document.querySelector({selector!r});"
            " e.scrollIntoView({ block: 'nearest' });"
            " const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()"
        )
        return found[0], found[1]

    async def key(self, kind: str, name: str, **more: Any) -> None:
        """Send a key event: Down or Up."""
        await self.call("Input.dispatchKeyEvent", type=f"key{kind}", key=name, code=name, **more)

    async def mouse(self, kind: str, x: float, y: float) -> None:
        """Send a mouse event: Pressed, Released or Moved."""
        held = {"button": "left", "clickCount": 1} if kind != "Moved" else {}
        await self.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, **held)

    async def click(self, selector: str, seconds: float = 0.0) -> None:
        """Press the left button on an element, for a time or as shortly as possible."""
        at, before = await self.middle(selector), None
        while at != before:  # what is above it may still grow
            await asyncio.sleep(0.03)
            at, before = await self.middle(selector), at
        await self.mouse("Moved", *at)
        if not seconds:  # both at once: nothing that this process waits for makes the press longer
            await asyncio.gather(self.mouse("Pressed", *at), self.mouse("Released", *at))
            return
        await self.mouse("Pressed", *at)
        await asyncio.sleep(seconds)
        await self.mouse("Released", *at)

    async def stroke(self, name: str) -> None:
        """Press a key as shortly as possible."""
        await asyncio.gather(self.key("Down", name), self.key("Up", name))

    async def type(self, selector: str, text: str) -> None:
        """Replace the text of a field by typing, and leave it."""
        await self.value(f"document.querySelector({selector!r}).select()")
        await self.call("Input.insertText", text=text)
        await self.value(f"document.querySelector({selector!r}).blur()")

    async def close(self) -> None:
        """Close the page."""
        self._reader.cancel()
        await self.call_no_answer("Page.close")
        await self._socket.close()

    async def call_no_answer(self, method: str) -> None:
        """Send a command after which the page does not answer."""
        await self._socket.send_str(json.dumps({"id": 0, "method": method}))

    async def screenshot(self, file: Path) -> None:
        """Write what is in sight as a PNG."""
        found = await self.call("Page.captureScreenshot", format="png")
        file.write_bytes(base64.b64decode(found["data"]))


class Chromium:
    """A browser process of its own, with its own profile."""

    def __init__(self, profile: Path) -> None:
        assert EXECUTABLE is not None
        self.profile = profile
        self._process = subprocess.Popen(
            [EXECUTABLE, *_FLAGS, f"--user-data-dir={profile}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip

    async def begin(self) -> None:
        """Wait until the browser listens."""
        port_file = self.profile / "DevToolsActivePort"
        for _ in range(int(_PATIENCE / 0.05)):
            if port_file.is_file() and (lines := port_file.read_text().splitlines()):
                self._address = f"http://127.0.0.1:{lines[0]}"
                self._session = aiohttp.ClientSession()
                return
            await asyncio.sleep(0.05)
        raise AssertionError("Chromium does not listen")

    async def _browser(self, method: str, **params: Any) -> Any:
        """Send a command to the browser itself."""
        async with self._session.get(f"{self._address}/json/version") as answer:
            about = await answer.json()
        async with self._session.ws_connect(about["webSocketDebuggerUrl"]) as socket:
            await socket.send_str(json.dumps({"id": 1, "method": method, "params": params}))
            return json.loads((await socket.receive()).data)["result"]

    async def context(self) -> str:
        """Return a new place for tabs that share no cookies with the others."""
        made = await self._browser("Target.createBrowserContext")
        return str(made["browserContextId"])

    async def tab(self, context: str | None = None) -> Tab:
        """Open a page."""
        where = {"browserContextId": context} if context is not None else {}
        made = await self._browser("Target.createTarget", url="about:blank", **where)
        address = f"{self._address.replace('http', 'ws', 1)}/devtools/page/{made['targetId']}"
        tab = Tab(await self._session.ws_connect(address, max_msg_size=0))
        for domain in ("Page", "Runtime", "Network", "Log"):
            await tab.call(f"{domain}.enable")
        return tab

    async def end(self) -> None:
        """Close the session and end the browser's processes."""
        await self._session.close()
        os.killpg(self._process.pid, signal.SIGTERM)
        try:
            await asyncio.to_thread(self._process.wait, 5)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)


class Background:
    """An event loop in a thread of its own, in which plain tests run a browser and a server."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()

    def __call__(self, work: Coroutine[Any, Any, Any], seconds: float = 4 * _PATIENCE) -> Any:
        """Run some work; return its result."""
        return asyncio.run_coroutine_threadsafe(work, self._loop).result(seconds)

    def close(self) -> None:
        """Stop the loop."""
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(5)
