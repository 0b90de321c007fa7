"""Measures the console: its processor time beside a mission at 20 Hz, and an abort from the browser."""

from __future__ import annotations

import asyncio
import json
import tempfile
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.checks.benchmark.measures.children import BenchmarkFailed, MeasuredProcesses, processes
from auv_sim.checks.benchmark.measures.law_speed import Tick
from auv_sim.checks.benchmark.measures.operation import start_nodes
from auv_sim.checks.benchmark.measures.rig import NAMESPACE
from auv_sim.checks.benchmark.scale import Scale
from auv_sim.checks.benchmark.usage import memory
from auv_sim.checks.patience import PATIENCE

_MODULE = "auv_sim.cli.console"
_BEFORE = "console: "


def console_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure a console with one browser beside the paper's mission, free running at 20 Hz.

    Returns:
        Processor time in % of one core, memory in bytes, and the times from a request to abort, as a click
        sends it, to thrust 0 on the wire, ms.

    Raises:
        ConfigurationError: aiohttp is not installed.
    """
    try:
        import aiohttp  # noqa: F401
    except ImportError:
        raise ConfigurationError("aiohttp", "not installed", "requirements/console.txt, or --only") from None
    tick("console")
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name, processes(Path(name)) as children:
        names = start_nodes(children, Path(name))
        children.start(topics.CONSOLE, _MODULE, ["--port", "0", "--forget", "--namespace", NAMESPACE])
        return asyncio.run(_measured(children, names, scale))


async def _measured(children: MeasuredProcesses, names: set[str], scale: Scale) -> dict[str, Any]:
    import aiohttp

    from auv_sim.launch.monitor import Monitor  # only now: a process with DDS threads must not fork

    monitor = Monitor(NAMESPACE)
    rig = _Rig(children, monitor)
    try:
        await rig.until(lambda: not monitor.missing_nodes(names, topics.RECORDER in names))
        await rig.until(lambda: bool(rig.address()))
        address = rig.address()
        origin = address.partition("/?")[0]
        # Browsers keep cookies of an address without a name; this client does so if asked.
        async with aiohttp.ClientSession(cookie_jar=aiohttp.CookieJar(unsafe=True)) as session:
            async with session.get(address, allow_redirects=False):
                pass
            async with session.ws_connect(f"{origin}/socket", origin=origin, max_msg_size=0) as socket:
                return await _with_browser(rig, socket, scale)
    finally:
        monitor.close()


async def _with_browser(rig: _Rig, socket: Any, scale: Scale) -> dict[str, Any]:
    reading = asyncio.create_task(rig.read(socket))

    async def ask(do: str) -> None:
        await socket.send_str(json.dumps({"id": do, "do": do, "vehicle": 0, "namespace": NAMESPACE}))

    try:
        await rig.until(lambda: rig.may_start)
        took = await _aborts(rig, ask, 6 * scale.rounds)
        await ask("start")
        await rig.until(lambda: rig.thrust > 0.0)
        percent = await rig.share(scale.seconds)
    finally:
        reading.cancel()
    return {
        "cpu_percent": percent,
        "rss": rig.memory(),
        "aborts": len(took),
        "p50_ms": float(np.median(took) * 1e3),
        "largest_ms": float(np.max(took) * 1e3),
    }


async def _aborts(rig: _Rig, ask: Callable[[str], Awaitable[None]], number: int) -> list[float]:
    """Start and abort a mission again and again; return the times that it took to stop, s."""
    took = []
    for k in range(number):
        await rig.until(lambda: rig.may_start)
        await ask("start")
        await rig.until(lambda: rig.thrust > 0.0)
        await rig.pause(0.013 * (k % 5))  # at different times between two odometries
        begin = time.perf_counter()
        await ask("abort")
        await rig.until(lambda: rig.thrust == 0.0)
        took.append(time.perf_counter() - begin)
        rig.may_start = False  # until the console reports the end
    return took


class _Rig:
    """Hears thrust on the wire and ticks in the browser."""

    def __init__(self, children: MeasuredProcesses, monitor: Any) -> None:
        self._children, self._monitor = children, monitor
        self.thrust, self.may_start = 0.0, False

        def heard(message: Any) -> None:
            self.thrust = message.data

        kind = qos.message_class(topics.THRUST_CMD.type)
        profile = qos.requested(topics.THRUST_CMD, reliable=True)
        monitor.node.create_subscription(kind, topics.THRUST_CMD.name, heard, profile)

    def address(self) -> str:
        """Return the address that the console has printed; empty before."""
        child = next(child for child in self._children if child.name == topics.CONSOLE)
        lines = child.last_lines(5)
        return next((line.removeprefix(_BEFORE) for line in lines if line.startswith(_BEFORE)), "")

    async def read(self, socket: Any) -> None:
        """Take what the console sends."""
        async for message in socket:
            if isinstance(message.data, str) and '"kind":"tick"' in message.data:
                self.may_start = json.loads(message.data)["can"]["start"]

    async def until(self, condition: Callable[[], bool]) -> None:
        """Look until a condition holds.

        Raises:
            BenchmarkFailed: a process has ended, or `PATIENCE` has.
        """
        deadline = time.monotonic() + PATIENCE
        while not condition():
            dead = self._children.dead()
            if dead is not None or time.monotonic() > deadline:
                raise BenchmarkFailed(dead.obituary() if dead else f"no result within {PATIENCE:g} s")
            self._monitor.look(0.0)
            await asyncio.sleep(0.0005)

    async def pause(self, seconds: float) -> None:
        """Wait, and go on hearing."""
        end = time.perf_counter() + seconds
        await self.until(lambda: time.perf_counter() > end)

    async def share(self, seconds: float) -> float:
        """Return the console's processor time in % of one core."""
        begin, before = time.perf_counter(), self._children.usage()[topics.CONSOLE].cpu
        await asyncio.sleep(seconds)
        used = self._children.usage()[topics.CONSOLE].cpu - before
        return 100.0 * used / (time.perf_counter() - begin)

    def memory(self) -> int:
        """Return the console's resident set, bytes."""
        return memory(self._children.ids[topics.CONSOLE]).rss
