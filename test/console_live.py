"""The console over a real graph: a mission that waits, the console's command, and a Chromium before it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

from chromium import Chromium, Tab
from console_stage import at_rest

SIZE = (1440, 900)


class Live:
    """A waiting mission and a console on one domain, in processes that end with it.

    Args:
        domain: ROS domain.
        place: for the log, and for what the console keeps.
        words: options of the mission.
    """

    def __init__(self, domain: int, place: Path, *words: object) -> None:
        self._domain, self._place, self._port = domain, place, 0
        self._environment = {
            **os.environ, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_DOMAIN_ID": str(domain),
            "XDG_CACHE_HOME": str(place),
        }  # fmt: skip
        self._log = (place / "log").open("w")
        self.mission = self._start("mission", "--wait", "--quiet", *words, output=self._log)
        self.serve()

    def _start(self, name: str, *words: object, output: Any) -> subprocess.Popen[str]:
        command = [sys.executable, "-m", f"auv_sim.cli.{name}", "--domain", self._domain, *words]
        return subprocess.Popen(
            [str(word) for word in command], stdout=output, stderr=subprocess.STDOUT, text=True,
            env=self._environment,
        )  # fmt: skip

    def serve(self) -> None:
        """Start the console, on the same port as before."""
        self._console = self._start("console", "--port", self._port, output=subprocess.PIPE)
        assert self._console.stdout is not None
        lines: list[str] = []
        addresses: list[str] = []
        while len(addresses) < 2:  # among lines of the middleware, on a machine with more of its kind
            lines.append(self._console.stdout.readline())
            assert lines[-1], lines
            addresses += re.findall(r"http://\S+", lines[-1])
        self.address, self.to_look = addresses
        self._port = int(self.address.partition("127.0.0.1:")[2].partition("/")[0])

    def stop_console(self) -> None:
        """End the console alone."""
        self._end(self._console)
        assert self._console.stdout is not None
        self._console.stdout.close()

    @staticmethod
    def _end(process: subprocess.Popen[str]) -> None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(180)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def __enter__(self) -> Live:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop_console()
        self._end(self.mission)
        self._log.close()


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
    tab.calm = lambda: at_rest(tab)
    await tab.size(*SIZE)
    await tab.open(address)
    await tab.until("document.getElementById('mission-name').textContent !== 'no mission'")
    return tab


async def state(tab: Tab, expected: str) -> None:
    """Wait until the badge shows a state."""
    await tab.until(f"document.getElementById('state').dataset.state === {expected!r}")


async def start(tab: Tab) -> None:
    """Wait for the pre-flight line, and keep Start pressed until the page has an answer.

    A pre-flight that changes meanwhile cancels a press, and the page says so; where it has changed before the
    press, the page takes none: press again.
    """
    said = "document.getElementById('answer').textContent"
    answer, is_taken = "", f"document.getElementById('start').classList.contains('pressed') || {said} !== ''"
    for _ in range(20):
        await tab.until("document.getElementById('start').getAttribute('aria-disabled') === 'false'")
        await tab.value(f"{said} = ''")
        at = await tab.press("#start")
        if not await tab.value(is_taken):
            await tab.mouse("Released", *at)
            continue
        await tab.until(f"/^Start: .*[^…]$/.test({said})")
        await tab.mouse("Released", *at)
        answer = str(await tab.value(said))
        if "nothing was sent" not in answer:
            break
    assert answer == "Start: started"
    await state(tab, "running")


async def flown(tab: Tab, share: float, seconds: float) -> None:
    """Wait until a share of the path has been flown, %."""
    await tab.until(f"parseFloat(document.getElementById('share').textContent) >= {share}", seconds)


async def load_gains(tab: Tab) -> None:
    """Open the list of gains and wait until it is there."""
    await tab.click("#open-gains")
    await tab.until("document.querySelector('.gain')")
