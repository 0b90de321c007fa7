"""The console's page in a real Chromium, before a server that plays a recorded flight.

A test waits for what it looks at, never for a time: `await fake.requests()` for all that the page has sent,
`settled` for what the page shows, `tab.until` for a text, `tab.pause` for timers of the page.
"""

from __future__ import annotations

import asyncio
import inspect
import json
import re
import tempfile
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from chromium import EXECUTABLE, Background, Chromium, Tab
from console_fake import PAGE, FakeConsole

needs_chromium = pytest.mark.skipif(EXECUTABLE is None, reason="not run: no Chromium")


class Stage:
    """A browser with one tab, and a fake server for each test."""

    def __init__(self, run: Background, browser: Chromium) -> None:
        self.run, self.browser = run, browser
        self._tab: Tab | None = None

    async def fresh(self, **options: Any) -> tuple[Tab, FakeConsole]:
        """Return the tab with the page of a new fake server with 1200 rows flown; a new port forgets all."""
        fake = FakeConsole(**options)
        fake.flown = min(1200, len(fake.rows))
        if self._tab is None:  # a new tab for each test costs twice as much
            self._tab = await self.browser.tab()
        tab = self._tab
        tab.calm = lambda: settled(tab, fake) if fake.browsers else at_rest(tab)
        fake.quiet = lambda: answered(tab)
        await tab.size(1280, 800)
        await tab.open(await fake.start())
        await settled(tab, fake)
        return tab, fake


def stages() -> Iterator[Stage]:
    """Start a browser; end it and everything it made."""
    run = Background()
    with tempfile.TemporaryDirectory(prefix="console_page_", ignore_cleanup_errors=True) as profile:
        browser = Chromium(Path(profile))
        try:
            run(browser.begin())
            yield Stage(run, browser)
        finally:
            run(browser.end())
            run.close()


def on_page(**options: Any) -> Callable[[Callable[[Tab, FakeConsole], Awaitable[None]]], Any]:
    """Make a test of a coroutine on a fresh tab and server that have settled.

    The tab must end without a complaint, except those that contain a text of `tab.expected`.
    """

    def decorate(work: Callable[[Tab, FakeConsole], Awaitable[None]]) -> Any:
        def test(stage: Stage) -> None:
            async def play() -> None:
                tab, fake = await stage.fresh(**options)
                try:
                    await work(tab, fake)
                    await answered(tab)
                    own = (f"http://127.0.0.1:{fake.port}/", f"ws://127.0.0.1:{fake.port}/socket", "blob:")
                    assert [url for url in tab.requests if not url.startswith(own)] == []
                    expected = ("willReadFrequently", *tab.expected)
                    assert [one for one in tab.complaints if not any(word in one for word in expected)] == []
                finally:
                    # An empty page of the same site keeps the process; the console's page would reconnect.
                    await tab.open(f"http://127.0.0.1:{fake.port}/left")
                    tab.requests.clear()
                    tab.complaints.clear()
                    tab.expected.clear()
                    await fake.stop()

            stage.run(play())

        test.__name__, test.__doc__ = work.__name__, inspect.getdoc(work)
        return needs_chromium(test)

    return decorate


def under_way(tab: Tab) -> set[tuple[str, int]]:
    """Return the requests that the page has sent and that are not answered: socket and number."""
    found = set()
    for socket, texts in tab.sockets.items():
        for is_sent, text in texts:
            number = (socket, json.loads(text).get("id"))
            if is_sent:
                found.add(number)
            elif '"answer"' in text:
                found.discard(number)
    return found


async def answered(tab: Tab) -> None:
    """Wait until the page has an answer to everything that it has requested until now.

    The browser reports what the page sends before it returns a value to a later evaluation.
    """
    for _ in range(9000):
        await tab.value("0")
        if not under_way(tab):
            return
        await asyncio.sleep(0.02)
    raise AssertionError(f"no answer within 180 s: {under_way(tab)}")


async def painted(tab: Tab) -> bool:
    """Wait until the page has painted what it has; return whether nothing new has arrived meanwhile."""
    return bool(
        await tab.value(
            "import('/page/painting.js').then(async ({ painting }) => { const { count } = painting;"
            " const frame = () => new Promise(done => requestAnimationFrame(done));"
            " while (painting.stale && painting.count === count) await frame();"
            " await frame(); await frame(); return !painting.stale; })"
        )
    )


async def at_rest(tab: Tab) -> None:
    """Wait until the page has its answers and has painted them: nothing of them moves its parts any more."""
    await answered(tab)
    await painted(tab)


async def settled(tab: Tab, fake: FakeConsole) -> None:
    """Wait until the page has its answers, the newest rows and the state after them, and has painted all."""
    for _ in range(1000):
        await answered(tab)
        await fake.until(lambda: not fake.busy)
        serial = fake.serial
        await tab.until(
            "import('/page/flights.js').then(({ flights: { vehicles } }) => vehicles.length > 0 &&"
            f" vehicles.every(v => v.tick?.serial === {serial} && v.table.n === {fake.flown}))"
        )
        if await painted(tab) and not under_way(tab) and not fake.busy and serial == fake.serial:
            return
    raise AssertionError("the page does not settle")


def by_day() -> dict[str, tuple[int, int, int]]:
    """Return the colours of the page by day: name -> red, green, blue."""
    text = (PAGE / "colours.css").read_text(encoding="utf-8")
    pairs = re.findall(r"--(\w+): light-dark\(#(\w{6})", text)
    return {name: (int(code[:2], 16), int(code[2:4], 16), int(code[4:], 16)) for name, code in pairs}


async def pixels(tab: Tab, north: float, east: float, reach: int = 0) -> list[tuple[int, int, int]]:
    """Return the colours of the chart at a place, and `reach` px around it."""
    found = await tab.value(
        f"""(async () => {{
        const {{ view }} = await import("/page/chart.js");
        const {{ placing }} = await import("/page/map_drawing.js");
        const canvas = document.getElementById("chart"), r = canvas.getBoundingClientRect();
        const s = devicePixelRatio, [x, y] = placing(view, r.width, r.height)({north}, {east}), d = {reach};
        const from = [Math.round(x * s) - d, Math.round(y * s) - d], n = 2 * d + 1;
        const data = canvas.getContext("2d").getImageData(...from, n, n);
        return Array.from(data.data); }})()"""
    )
    return [(found[k], found[k + 1], found[k + 2]) for k in range(0, len(found), 4)]
