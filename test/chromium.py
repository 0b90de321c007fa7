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
from collections.abc import Awaitable, Callable, Coroutine
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
#: Makes `aim` of an element e: what the page itself sees of the next press on it, by mouse or key.
_AIM = (
    "if (!window.aim) {"
    " const on = (name, see) => addEventListener(name, see, true), now = () => performance.now();"
    " const begin = v => { aim.hit = aim.at.contains(v.target); aim.from = now(); };"
    " const end = () => { aim.to = now(); };"
    " on('pointerdown', begin); on('keydown', begin); on('pointerup', end); on('keyup', end);"
    " on('click', v => { aim.clicks += aim.at.contains(v.target); }); }"
    " window.aim = { at: e, hit: null, clicks: 0, from: 0, to: 0 };"
)


async def _no_wait() -> None:
    pass


class Tab:
    """One page: commands, evaluation, input, and the events that came."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse, downloads: Path) -> None:
        self._downloads = downloads
        self._socket, self._next, self._pending = socket, 0, dict[int, asyncio.Future[Any]]()
        self._page = "nothing yet"
        #: Texts on each open socket of the page, in order: whether the page sent it, and the text.
        self.sockets: dict[str, list[tuple[bool, str]]] = {}
        #: Waits until nothing that is under way can still move the parts of the page.
        self.calm: Callable[[], Awaitable[None]] = _no_wait
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self.expected: list[str] = []
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
                self.sockets[params["requestId"]] = []
            case "Network.webSocketFrameSent" | "Network.webSocketFrameReceived":
                one, is_sent = params["response"], method.endswith("Sent")
                if one["opcode"] == 1 and params["requestId"] in self.sockets:
                    self.sockets[params["requestId"]].append((is_sent, one["payloadData"]))
            case "Network.webSocketClosed":
                self.sockets.pop(params["requestId"], None)
            case "Page.frameNavigated" if "parentId" not in params["frame"]:
                self.sockets.clear()
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
        await self.value("window.left = true")
        await self.call("Page.navigate", url=url)
        await self.until("!window.left && document.readyState === 'complete'")

    async def pause(self, seconds: float) -> None:
        """Wait for a time of the page's own timers: those that are due earlier have run."""
        await self.value(f"new Promise(done => setTimeout(done, {1000.0 * seconds}))")

    async def size(self, width: int, height: int, mobile: bool = False) -> None:
        """Set the size of the window, CSS px."""
        await self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                        deviceScaleFactor=2 if mobile else 1, mobile=mobile)  # fmt: skip
        await self.until(f"innerWidth === {width}")

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

    async def mouse(self, kind: str, x: float, y: float, is_held: bool = False) -> None:
        """Send a mouse event: Pressed, Released or Moved, the last with the button held or not."""
        held = {"button": "left", "clickCount": 1} if kind != "Moved" else {"buttons": int(is_held)}
        await self.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, **held)

    async def aim(self, selector: str) -> tuple[float, float]:
        """Point at the middle of an element once the page has come to rest; return the place."""
        await self.calm()
        at, before = await self.middle(selector), None
        while at != before:
            await asyncio.sleep(0.03)
            at, before = await self.middle(selector), at
        await self.value(f"(() => {{ const e = document.querySelector({selector!r}); {_AIM} }})()")
        await self.mouse("Moved", *at)
        return at

    async def press(self, selector: str) -> tuple[float, float]:
        """Press the left button on an element; return the place to release it."""
        at = await self.aim(selector)
        await self.mouse("Pressed", *at)
        assert await self.value("aim.hit"), f"{selector} moved before it was pressed"
        return at

    async def click(self, selector: str, seconds: float = 0.0) -> float:
        """Click an element, pressed for a time or as shortly as possible.

        Returns:
            Time from the press to the release as the page has seen it, s.
        """
        at = await self.aim(selector)
        # Both at once where it is short: nothing that this process waits for makes the press longer.
        if seconds:
            await self.mouse("Pressed", *at)
            await self.pause(seconds)
            await self.mouse("Released", *at)
        else:
            await asyncio.gather(self.mouse("Pressed", *at), self.mouse("Released", *at))
        hit, clicks, lasted = await self.value("[aim.hit, aim.clicks, aim.to - aim.from]")
        assert hit, f"{selector} moved before it was pressed"
        assert clicks == 1, f"{selector} was pressed and released, which made {clicks} clicks"
        return float(lasted) / 1000.0

    async def stroke(self, name: str) -> float:
        """Press a key on the focused element as shortly as possible; return as `click` does."""
        await self.value(f"(() => {{ const e = document.activeElement; {_AIM} }})()")
        await asyncio.gather(self.key("Down", name), self.key("Up", name))
        return float(await self.value("aim.to - aim.from")) / 1000.0

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

    async def downloaded(self, name: str) -> str:
        """Return the text of a file once it has been downloaded."""
        file = self._downloads / name  # it has another name until it is whole
        for _ in range(int(_PATIENCE / 0.05)):
            if file.is_file():
                return file.read_text(encoding="utf-8")
            await asyncio.sleep(0.05)
        raise AssertionError(f"{name} was not downloaded")

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
        tab = Tab(await self._session.ws_connect(address, max_msg_size=0), self.profile / "downloads")
        for domain in ("Page", "Runtime", "Network", "Log"):
            await tab.call(f"{domain}.enable")
        place = str(self.profile / "downloads")
        await tab.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=place)
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
