"""Browsers of the console: early and late ones, slow ones, flooding ones, and what they ask for."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import Awaitable, Callable
from typing import Any

import aiohttp
import pytest

from auv_sim.views.console.record.track_columns import COLUMNS
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.record.wire_messages import ROWS_HEADER
from auv_sim.views.console.web import page_server, viewer
from page_bench import PageBench, asked, heard, page_bench


def on_bench(test: Callable[[PageBench], Awaitable[None]], **options: Any) -> None:
    async def run() -> None:
        async with page_bench(**options) as bench:
            await test(bench)

    asyncio.run(run())


async def rows_of(browser: aiohttp.ClientWebSocketResponse, count: int) -> list[float]:
    """Return the first column of the next rows."""
    found: list[float] = []
    while len(found) < count:
        message = await browser.receive(timeout=180.0)
        assert message.type in (aiohttp.WSMsgType.TEXT, aiohttp.WSMsgType.BINARY), message
        if message.type is aiohttp.WSMsgType.BINARY:
            values = memoryview(message.data[ROWS_HEADER.size :]).cast("f")
            found += values[:: len(COLUMNS)]
    return found


async def deaf_browser(bench: PageBench) -> socket.socket:
    """Open the console's socket and never read from it."""
    cookie = await bench.cookie(bench.tokens.control)
    deaf = socket.create_connection((bench.client.host, bench.client.port))
    deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    host = bench.origin.removeprefix("http://")
    deaf.sendall(
        f"GET /socket HTTP/1.1\r\nHost: {host}\r\nOrigin: {bench.origin}\r\nUpgrade: websocket\r\n"
        f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {'A' * 22}==\r\n"
        f"Cookie: {cookie['Cookie']}\r\n\r\n".encode()
    )
    return deaf


def test_two_browsers_and_a_late_one_see_the_same() -> None:
    async def check(bench: PageBench) -> None:
        (vehicle,) = bench.vehicles
        first, second = await bench.browser(), await bench.browser()
        hello = await heard(first, "hello")
        assert (hello["protocol"], hello["viewer"], hello["may_command"]) == (1, 1, True)
        assert [column["name"] for column in hello["columns"]] == [column.name for column in COLUMNS]
        assert hello["vehicles"] == [{"index": 0, "namespace": "/auv", "name": "auv"}]
        for k in range(4):
            vehicle.take_row(5.0 + k)
        bench.server.look()
        late = await bench.browser()
        assert await rows_of(first, 4) == await rows_of(second, 4) == await rows_of(late, 4)
        vehicle.take_row(9.0)
        assert await rows_of(first, 1) == await rows_of(late, 1) == [4.0], "once, though one came between"
        assert bench.server.viewers == 3
        assert (await heard(late, "tick"))["now"] == 9.0

    on_bench(check)


def test_every_request_is_answered_with_its_number() -> None:
    async def check(bench: PageBench) -> None:
        browser = await bench.browser()
        assert await asked(browser, id=7, do="start", vehicle=0, namespace="/auv") == {
            "kind": "answer", "id": 7, "ok": True, "message": "start was called",
        }  # fmt: skip
        for request in (
            {"do": "fly"}, {"do": 3}, {}, {"do": "start", "vehicle": 1}, {"do": "start", "vehicle": True},
            {"do": "start", "vehicle": "0"}, {"do": "start", "vehicle": -1}, {"do": None}, {"do": ["abort"]},
        ):  # fmt: skip
            answer = await asked(browser, id="x", **request)
            assert (answer["ok"], bool(answer["message"])) == (False, True)
        for text in ("no json", "[]", "3", "{", '{"id": NaN, "do": "x"}', "[" * 5000):
            await browser.send_str(text)
            assert not (await heard(browser, "answer", id=None))["ok"]
        assert bench.done == [("start", 1)]
        answer = await asked(browser, id=9, do="resume", vehicle=0, namespace="/auv")
        assert (answer["ok"], answer["message"]) == (False, "the console failed: OverflowError: of a bug")

    on_bench(check)


def test_a_request_for_another_vehicle_is_refused() -> None:
    async def check(bench: PageBench) -> None:
        browser = await bench.browser()
        answer = await asked(browser, id=1, do="start", vehicle=0, namespace="/auv2")
        assert answer["message"] == "vehicle 0: found namespace '/auv2', expected '/auv'"
        for request in ({"do": "start"}, {"do": "hold"}, {"do": "abort", "namespace": "/auv2"},
                        {"do": "missions", "namespace": "/auv2"}):  # fmt: skip
            assert not (await asked(browser, id=2, vehicle=0, **request))["ok"]
        assert bench.done == []
        assert (await asked(browser, id=3, do="abort", vehicle=0))["ok"], "there is one vehicle"
        bench.vehicles.append(VehicleRecord(1, "/auv2"))
        assert not (await asked(browser, id=4, do="abort", vehicle=1))["ok"], "which one is not said"
        assert (await asked(browser, id=5, do="abort", vehicle=1, namespace="/auv2"))["ok"]
        assert bench.done == [("abort", 1), ("abort", 1)]

    on_bench(check)


def test_a_page_that_may_only_look_commands_nothing() -> None:
    async def check(bench: PageBench) -> None:
        browser = await bench.browser(bench.tokens.view)
        assert (await heard(browser, "hello"))["may_command"] is False
        for name in ("start", "abort", "hold"):
            answer = await asked(browser, id=1, do=name, vehicle=0)
            assert not answer["ok"]
            assert answer["message"] == "view only: commands need the control address"
        assert (await asked(browser, id=2, do="missions"))["ok"]
        assert bench.done == [("missions", 1)]

    on_bench(check, view_only=True)
    on_bench(check, view_only=False)


def test_an_abort_waits_for_no_other_request() -> None:
    async def check(bench: PageBench) -> None:
        browser = await bench.browser()
        bench.may_answer.clear()
        for k in range(viewer.MOST_PENDING + 1):
            await browser.send_str(json.dumps({"id": k, "do": "start", "vehicle": 0, "namespace": "/auv"}))
        assert "not answered yet" in (await heard(browser, "answer", id=viewer.MOST_PENDING))["message"]
        assert (await asked(browser, id="stop", do="abort", vehicle=0))["ok"]
        bench.may_answer.set()
        assert (await heard(browser, "answer", id=viewer.MOST_PENDING - 1))["ok"]

    on_bench(check)


def test_a_browser_that_floods_is_cut_and_others_stay() -> None:
    async def check(bench: PageBench) -> None:
        quiet, flood = await bench.browser(), await bench.browser()
        for _ in range(3 * viewer.MOST_REQUESTS):
            await flood.send_str('{"id": 1, "do": "nothing"}')
        while (await flood.receive(timeout=180.0)).type is aiohttp.WSMsgType.TEXT:
            pass
        assert flood.closed
        assert (await asked(quiet, id=2, do="abort", vehicle=0))["ok"]
        assert bench.server.viewers == 1

    on_bench(check)


def test_a_request_that_is_too_long_ends_its_browser_alone() -> None:
    async def check(bench: PageBench) -> None:
        quiet, loud = await bench.browser(), await bench.browser()
        await loud.send_str(json.dumps({"id": 1, "do": "start", "text": "x" * 600_000}))
        while (await loud.receive(timeout=180.0)).type is aiohttp.WSMsgType.TEXT:
            pass
        assert (await asked(quiet, id=2, do="abort", vehicle=0))["ok"]

    on_bench(check)


def test_a_browser_that_never_reads_is_cut_and_delays_no_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """The buffers of the system fill up, then the one of the browser, up to its bound."""
    monkeypatch.setattr(viewer, "MOST_BEHIND", 200_000)

    async def check(bench: PageBench) -> None:
        loop, reader = asyncio.get_running_loop(), await bench.browser()
        deaf = await deaf_browser(bench)
        while bench.server.viewers < 2:
            await asyncio.sleep(0.01)
        begin, rounds = loop.time(), 0
        while bench.server.viewers == 2:
            assert loop.time() - begin < 180.0
            bench.server.publish(['{"kind": "filler", "text": "' + "x" * 50_000 + '"}'] * 2)
            rounds += 1
            for _ in range(2):
                await heard(reader, "filler")
        assert rounds > 2, "small lags are forgiven"
        assert (await asked(reader, id=1, do="abort", vehicle=0))["ok"]
        deaf.close()

    on_bench(check)


def test_the_whole_record_counts_for_nothing_in_a_slow_browsers_bound(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(viewer, "MOST_BEHIND", 20_000)

    async def check(bench: PageBench) -> None:
        for k in range(3000):
            bench.vehicles[0].take_row(float(k + 1))
        browser = await bench.browser()
        assert len(await rows_of(browser, 3000)) == 3000

    on_bench(check)


def test_a_browser_that_answers_no_ping_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page_server, "HEARTBEAT", 1.0)

    async def is_alone_cut(bench: PageBench) -> bool:
        deaf, reader = await deaf_browser(bench), await bench.browser()
        while bench.server.viewers < 2:
            await asyncio.sleep(0.01)
        while bench.server.viewers == 2:
            await reader.receive(timeout=180.0)
            await asyncio.sleep(0)  # once it is closed it receives at once
        stays = bench.server.viewers == 1 and not reader.closed
        if stays:
            assert (await asked(reader, id=1, do="abort", vehicle=0))["ok"]
        deaf.close()
        await reader.close()
        while bench.server.viewers:
            await asyncio.sleep(0.01)
        return stays

    async def check(bench: PageBench) -> None:
        # Where this process is paused for half a second, the reader answers no ping either.
        for _ in range(20):
            if await is_alone_cut(bench):
                return
        raise AssertionError("the browser that answers was cut each time")

    on_bench(check)


def test_a_vehicle_that_makes_the_console_fail_keeps_no_other_from_the_browsers() -> None:
    async def check(bench: PageBench) -> None:
        def fail(_: float) -> list[str | bytes]:
            raise OverflowError("of a bug")

        bench.vehicles[0].changes = bench.vehicles[0].whole = fail  # type: ignore[method-assign]
        bench.vehicles.append(VehicleRecord(1, "/auv2"))
        browser = await bench.browser()
        assert (await heard(browser, "tick"))["vehicle"] == 1
        bench.vehicles[1].take_row(5.0)
        assert (await heard(browser, "tick", now=5.0))["vehicle"] == 1, "the ticks go on"
        assert bench.faults == [
            f"the console failed at /auv {what}: OverflowError: of a bug" for what in ("changes", "record")
        ]

    on_bench(check)
