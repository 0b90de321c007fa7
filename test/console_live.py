"""The console over a real graph: a mission that waits, the console's command, and a Chromium before it."""

from __future__ import annotations

import asyncio
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from chromium import Chromium, Tab

SIZE = (1440, 900)


def _module(name: str, *words: object) -> list[str]:
    return [sys.executable, "-m", f"auv_sim.cli.{name}", *map(str, words)]


@contextmanager
def graph(domain: int, log: Path, *words: object) -> Iterator[tuple[str, str, int]]:
    """Run a waiting mission and a console; yield its two addresses and the mission's process id."""
    environment = {**os.environ, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_DOMAIN_ID": str(domain)}
    mission = _module("mission", "--wait", "--domain", domain, "--quiet", *words)
    console = _module("console", "--domain", domain, "--port", 0, "--forget")
    with log.open("w") as output:
        processes = [
            subprocess.Popen(command, stdout=stream, stderr=subprocess.STDOUT, text=True, env=environment)
            for command, stream in ((mission, output), (console, subprocess.PIPE))
        ]
        try:
            assert processes[1].stdout is not None
            lines = [processes[1].stdout.readline() for _ in range(2)]
            addresses = [found[0] for line in lines if (found := re.search(r"http://\S+", line))]
            assert len(addresses) == 2, lines
            yield addresses[0], addresses[1], processes[0].pid
        finally:
            for process in processes:
                process.send_signal(signal.SIGINT)
            for process in processes:
                try:
                    process.wait(20)
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.wait()
            assert processes[1].stdout is not None
            processes[1].stdout.close()


def node_pid(launcher: int, module: str) -> int:
    """Return the process id of a node of the launcher, by the end of its module's name."""
    for file in Path(f"/proc/{launcher}/task").glob("*/children"):
        for child in file.read_text().split():
            if f".{module}\0" in Path(f"/proc/{child}/cmdline").read_text():
                return int(child)
    raise AssertionError(f"{module} is no child of {launcher}")


async def opened(browser: Chromium, address: str) -> Tab:
    """Return a tab with the console's page once a mission is there."""
    tab = await browser.tab()
    await tab.size(*SIZE)
    await tab.open(address)
    await tab.until("document.getElementById('mission-name').textContent !== 'no mission'", 60.0)
    return tab


async def state(tab: Tab, expected: str, seconds: float = 20.0) -> None:
    """Wait until the badge shows a state."""
    await tab.until(f"document.getElementById('state').dataset.state === {expected!r}", seconds)


async def start(tab: Tab) -> None:
    """Wait for the pre-flight line, and keep Start pressed until the mission runs."""
    await tab.until("document.getElementById('start').getAttribute('aria-disabled') === 'false'", 60.0)
    at = await tab.middle("#start")
    await tab.mouse("Moved", *at)
    await tab.mouse("Pressed", *at)
    await state(tab, "running")
    await tab.mouse("Released", *at)


async def flown(tab: Tab, share: float, seconds: float) -> None:
    """Wait until a share of the path has been flown, %."""
    await tab.until(f"parseFloat(document.getElementById('share').textContent) >= {share}", seconds)


async def load_gains(tab: Tab) -> None:
    """Open the list of gains and wait until it is there."""
    await tab.click("#open-gains")
    await tab.until("document.querySelector('.gain')", 20.0)
    await asyncio.sleep(0.2)
