"""Fly two missions over the graph and write the pictures of docs/console.md, in about three minutes.

cd test && python3 -m console_pictures
"""

from __future__ import annotations

import argparse
import os
import signal
import tempfile
from pathlib import Path

from PIL import Image

from chromium import Background, Chromium, Tab
from console_live import SIZE, Live, flown, load_gains, node_pid, opened, start, state

IMAGES = Path(__file__).resolve().parents[1] / "docs" / "images"


async def picture(tab: Tab, name: str) -> None:
    """Write docs/images/console_<name>.png once the page has painted."""
    await tab.calm()
    file = IMAGES / f"console_{name}.png"
    await tab.screenshot(file)
    with Image.open(file) as found:
        small = found.convert("RGB").quantize(192, dither=Image.Dither.NONE)
    small.save(file, optimize=True)
    print(f"docs/images/console_{name}.png")


async def survey(browser: Chromium, address: str) -> None:
    """Take the pictures of a survey: the plan check, in flight, at night, on a phone, on abort."""
    tab = await opened(browser, address)
    await tab.click("#open-mission")
    await tab.until("document.getElementById('mission-choice').options.length > 1")
    await tab.value(
        "(c => { c.value = 'figure_of_eight'; c.dispatchEvent(new Event('change')); })"
        "(document.getElementById('mission-choice'))"
    )
    await tab.until("document.getElementById('mission-text').value")
    await tab.click("#check")
    await tab.until("!document.getElementById('load').disabled")
    await picture(tab, "check")
    await tab.type("#mission-text", "")
    await tab.value("document.getElementById('mission-text').dispatchEvent(new Event('input'))")
    await tab.click("#open-watch")
    await start(tab)
    await flown(tab, 36.0, 300.0)
    at = await tab.middle("#chart")
    await tab.mouse("Moved", at[0] + 60, at[1] - 40)
    await picture(tab, "flight")
    for _ in range(2):
        await tab.click("#light")
    await load_gains(tab)
    await picture(tab, "night")
    await tab.click("#light")
    await tab.click("#open-watch")
    await tab.size(390, 844, mobile=True)
    await tab.value("scrollTo(0, 0)")
    await picture(tab, "phone")
    await tab.size(*SIZE)
    await tab.click("#abort")
    await state(tab, "aborted")
    await picture(tab, "abort")
    await tab.close()


async def dive(browser: Chromium, address: str, launcher: int) -> None:
    """Take the pictures of a dive: in flight, and with a node that has stopped."""
    tab = await opened(browser, address)
    await start(tab)
    await flown(tab, 60.0, 300.0)
    await tab.click("#course-up")
    await picture(tab, "dive")
    await tab.click("#course-up")
    observer = node_pid(launcher, "current_observer_node")
    os.kill(observer, signal.SIGSTOP)
    await tab.until("document.querySelector('#health tr.silent')")
    await picture(tab, "lost_node")
    os.kill(observer, signal.SIGCONT)
    await tab.close()


def main() -> None:
    """Fly both missions."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--domain", type=int, default=91)
    domain = parser.parse_args().domain
    run = Background()
    with tempfile.TemporaryDirectory(prefix="console_pictures_", ignore_cleanup_errors=True) as place:
        work = Path(place)
        browser = Chromium(work / "profile")
        current = ("--current", 0.1, 0.2)
        try:
            run(browser.begin())
            words = ("--mission", "survey_wgs84", "--sea", "moderate", *current)
            with Live(domain, work, *words, "--out", work / "survey") as live:
                run(survey(browser, live.address), 900.0)
            words = ("--mission", "helix", "--vehicle", "remus100_6dof", "--speed", 3, *current)
            with Live(domain + 1, work, *words, "--out", work / "dive") as live:
                run(dive(browser, live.address, live.mission.pid), 900.0)
        finally:
            print((work / "log").read_text())
            run(browser.end())
            run.close()


if __name__ == "__main__":
    main()
