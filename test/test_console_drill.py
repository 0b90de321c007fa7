"""An operator steers a mission over the real graph from the console's page in Chromium."""

from __future__ import annotations

import asyncio
import json
import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from aiohttp import web

from auv_sim.bags.reading.load import load_messages
from chromium import Chromium, Tab
from console_live import Live, load_gains, opened, start, state
from console_stage import Stage, needs_chromium, stages

MISSION = """\
version: 1
name: drill
frame: ned
thrust: {thrust}
origin: {{latitude_deg: 63.44, longitude_deg: 10.4}}
segments: [{{line: {{start: [0, 0], length: 3000, course_deg: 30}}}}]
"""
GAIN = "[data-name='autopilot.nism.k1'] input"


@pytest.fixture(scope="module")
def stage() -> Iterator[Stage]:
    yield from stages()


@needs_chromium
def test_load_refuse_correct_start_hold_gain_resume_abort(stage: Stage, domain: int, tmp_path: Path) -> None:
    run = tmp_path / "run"
    with Live(domain, tmp_path, "--composed", "--speed", 4, "--out", run) as live:
        stage.run(_drill(stage.browser, live))
    logged = [message.msg for _, message in load_messages(run / "bag", "rosout")]
    deeds = [text.removeprefix("/auv: browser 1: ") for text in logged if "browser" in text]
    refused = [text.partition(": refused: ")[0] for text in deeds if ": refused: " in text]
    assert refused == ["load a mission", "set heading_autopilot autopilot.nism.k1 -1"]
    assert [text for text in deeds if ": refused: " not in text] == [
        "load a mission", "start", "hold", "set heading_autopilot autopilot.nism.k1 0.55", "resume", "abort",
    ]  # fmt: skip
    thrust = [message.data for _, message in load_messages(run / "bag", "thrust_cmd")]
    assert max(thrust) == pytest.approx(6.0, abs=1e-6)
    assert thrust[-1] == 0.0


async def text(tab: Tab, name: str) -> str:
    """Return the words of an element."""
    return str(await tab.value(f"document.getElementById({name!r}).textContent"))


async def said(tab: Tab, word: str) -> None:
    """Wait until the last answer contains a word."""
    await tab.until(f"document.getElementById('answer').textContent.includes({word!r})")


async def _drill(browser: Chromium, live: Live) -> None:
    tab = await opened(browser, live.address)
    await _load(tab)
    await tab.until("document.getElementById('mission-name').textContent.startsWith('drill')")
    await start(tab)
    await tab.until("parseFloat(document.getElementById('lengths').textContent) > 20")
    await _check(tab, MISSION.format(thrust=5.0))
    await tab.click("#load")
    await tab.until("document.getElementById('check-lines').className === 'bad'")
    assert "running" in await text(tab, "check-lines")
    await tab.click("#hold")
    await state(tab, "holding")
    await load_gains(tab)
    await tab.type(GAIN, "-1")
    await said(tab, "out of range")
    await tab.type(GAIN, "0.55")
    await said(tab, "k1: ")
    await tab.until(f"document.querySelector({GAIN!r}).closest('.gain').classList.contains('changed')")
    await tab.click("#resume")
    await state(tab, "running")
    await _refuse_a_foreign_page(browser, live)
    await _look_only(browser, live)
    rows = "import('/page/flights.js').then(m => m.flights.vehicles[0]?.table.n || 0)"
    before = await tab.value(rows)
    live.stop_console()
    await tab.until("!document.getElementById('banner').hidden")
    await asyncio.to_thread(live.serve)
    await state(tab, "running")
    await tab.until(f"{rows}.then(n => n >= {before})")
    await tab.click("#abort")
    await tab.until("/^Abort: .*[^…]$/.test(document.getElementById('answer').textContent)")
    assert await text(tab, "answer") == "Abort: abort was called"
    await state(tab, "aborted")
    assert "abort was called" in await text(tab, "state-reason")
    own = live.address.partition("?")[0]
    allowed = (own, own.replace("http", "ws", 1))
    assert [url for url in tab.requests if not url.startswith(allowed)] == []
    # While the server was away the browser reports the connections that were refused.
    assert [one for one in tab.complaints if "ERR_CONNECTION_REFUSED" not in one] == []
    await tab.close()


async def _load(tab: Tab) -> None:
    """Have a mission refused, correct it, and send it."""
    await tab.click("#open-mission")
    await tab.type("#mission-text", MISSION.format(thrust=-6.0))
    await tab.click("#check")
    await tab.until("document.getElementById('check-lines').className === 'bad'")
    assert "thrust" in await text(tab, "check-lines")
    assert await tab.value("document.getElementById('load').disabled")
    await _check(tab, MISSION.format(thrust=6.0))
    await tab.click("#load")
    await tab.until("document.getElementById('mission-name').textContent.startsWith('drill')")


async def _check(tab: Tab, mission: str) -> None:
    """Write a mission and check it until it may be sent."""
    await tab.type("#mission-text", mission)
    await tab.click("#check")
    await tab.until("!document.getElementById('load').disabled")
    draft = await tab.value("import('/page/chart.js').then(m => [m.view.draft.north, m.view.draft.east])")
    end = [3000.0 * math.cos(math.radians(30.0)), 3000.0 * math.sin(math.radians(30.0))]
    assert [line[-1] for line in draft] == pytest.approx(end)


async def _refuse_a_foreign_page(browser: Chromium, live: Live) -> None:
    """Try a page of another origin in the same browser: it reads nothing and opens no socket."""
    own = live.address.partition("?")[0]

    async def page(_: web.Request) -> web.Response:
        return web.Response(text="<title>foreign</title>", content_type="text/html")

    app = web.Application()
    app.router.add_get("/", page)
    foreign = web.AppRunner(app)
    await foreign.setup()
    await web.TCPSite(foreign, "127.0.0.1", 0).start()
    tab = await browser.tab()
    await tab.open(f"http://127.0.0.1:{foreign.addresses[0][1]}/")
    socket = own.replace("http", "ws", 1) + "socket"
    attempt = (
        f"new Promise(done => {{ const s = new WebSocket({json.dumps(socket)});"
        " s.onopen = () => done('open'); s.onerror = () => done('refused'); })"
    )
    assert await tab.value(attempt) == "refused"
    assert await tab.value(f"fetch({own!r}).then(() => 'read', () => 'refused')") == "refused"
    await tab.close()
    await foreign.cleanup()


async def _look_only(browser: Chromium, live: Live) -> None:
    """The address for looking shows the flight in a browser of its own, without a command."""
    context = await browser.context()
    tab = await browser.tab(context)
    await tab.open(live.to_look)
    await state(tab, "running")
    assert await tab.value("document.getElementById('commands').hidden")
    answer = await tab.value(
        "new Promise(done => { const s = new WebSocket(`ws://${location.host}/socket`);"
        " s.onopen = () => s.send(JSON.stringify({ id: 5, do: 'abort', vehicle: 0 }));"
        " s.onmessage = e => { if (typeof e.data !== 'string') return; const m = JSON.parse(e.data);"
        " if (m.kind === 'answer') { s.close(); done(m); } }; })"
    )
    assert (answer["id"], answer["ok"]) == (5, False)
    await state(tab, "running")
    place = await tab.value("import('/page/flights.js').then(m => m.flights.vehicles[0].tick.pose)")
    # It flies the course of 30 degrees from north.
    assert math.degrees(math.atan2(place[0], place[1])) == pytest.approx(30.0, abs=3.0)
    await tab.close()
