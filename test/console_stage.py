"""The console's page in a real Chromium, before a server that plays a recorded flight."""

from __future__ import annotations

import inspect
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
        await tab.size(1280, 800)
        await tab.open(await fake.start())
        await tab.until("document.getElementById('mission-name').textContent !== 'no mission'")
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
    """Make a test of a coroutine on a fresh tab and server; the tab must end without a complaint."""

    def decorate(work: Callable[[Tab, FakeConsole], Awaitable[None]]) -> Any:
        def test(stage: Stage) -> None:
            async def play() -> None:
                tab, fake = await stage.fresh(**options)
                try:
                    await work(tab, fake)
                    own = (f"http://127.0.0.1:{fake.port}/", f"ws://127.0.0.1:{fake.port}/socket", "blob:")
                    assert [url for url in tab.requests if not url.startswith(own)] == []
                    assert [one for one in tab.complaints if "willReadFrequently" not in one] == []
                finally:
                    # An empty page of the same site keeps the process; the console's page would reconnect.
                    await tab.open(f"http://127.0.0.1:{fake.port}/left")
                    tab.requests.clear()
                    tab.complaints.clear()
                    await fake.stop()

            stage.run(play())

        test.__name__, test.__doc__ = work.__name__, inspect.getdoc(work)
        return needs_chromium(test)

    return decorate


async def settled(tab: Tab, fake: FakeConsole) -> None:
    """Wait until the page has the newest rows and the tick behind them, and has painted what it has.

    It paints 0.1 s after something has changed at the latest, in its own time: however late that is.
    """
    await tab.until(
        "import('/page/flights.js').then(({ flights: { vehicles } }) => vehicles.length > 0 &&"
        f" vehicles.every(v => v.tick?.now === {fake.now!r} && v.table.n === {fake.flown}))"
    )
    await tab.value(
        "import('/page/painting.js').then(async ({ painting }) => { let count; do { count = painting.count;"
        " await new Promise(done => setTimeout(done, 160));"
        " await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));"
        " } while (painting.count !== count); })"
    )


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
