"""What an operator does on the console's page, by mouse and keyboard in a real Chromium."""

from __future__ import annotations

import time
from collections.abc import Awaitable, Callable, Iterator

import pytest

from chromium import Tab
from console_fake import FakeConsole
from console_stage import Stage, on_page, settled, stages


@pytest.fixture(scope="module")
def stage() -> Iterator[Stage]:
    yield from stages()


async def done(fake: FakeConsole) -> list[str]:
    """Return the commands that the page has sent."""
    return [request["do"] for request in await fake.requests("start", "hold", "resume", "abort")]


async def text(tab: Tab, name: str) -> str:
    found = await tab.value(f"document.getElementById({name!r}).textContent")
    return str(found)


async def state(tab: Tab, expected: str) -> None:
    await tab.until(f"document.getElementById('state').dataset.state === {expected!r}")


@on_page()
async def test_start_is_pressed_for_a_second(tab: Tab, fake: FakeConsole) -> None:
    await tab.until("document.getElementById('start').getAttribute('aria-disabled') !== 'true'")
    before = await sends_nothing(tab, fake, lambda: tab.click("#start"))
    await tab.until("document.getElementById('answer').textContent.includes('one second')")
    turned = "parseFloat(getComputedStyle(document.querySelector('.ring')).getPropertyValue('--turned'))"
    look = f"most = Math.max(most, {turned}); requestAnimationFrame(look)"
    await tab.value(f"window.most = 0; window.look = () => {{ {look} }}; look()")
    for presses in range(1, 20):  # a page that is drawn too rarely may not show the turn
        begun = time.monotonic()
        at = await tab.press("#start")
        await state(tab, "running")
        assert time.monotonic() - begun >= 1.0
        await tab.mouse("Released", *at)
        assert await done(fake) == before + ["start"] * presses
        if await tab.value("most > 90"):
            break
        await anew(tab, fake)
    assert await tab.value("most") > 90
    assert (await fake.requests())[-1]["digest"] == fake.course["mission"]["digest"]
    await tab.until("document.getElementById('answer').textContent === 'Start: running'")


async def sends_nothing(tab: Tab, fake: FakeConsole, press: Callable[[], Awaitable[float]]) -> list[str]:
    """Press Start for less than a second; return what was sent before.

    A browser that is paused between press and release makes the press longer: it counts from the next.
    """
    for _ in range(20):
        before, lasted = await done(fake), await press()
        await tab.pause(1.1)
        if lasted < 0.9:
            assert await done(fake) == before
            return before
        await anew(tab, fake)
    raise AssertionError("every press was a long one")


async def anew(tab: Tab, fake: FakeConsole) -> None:
    """Make the mission wait for its start once more."""
    await fake.requests()
    fake.state = "idle"
    await fake.publish()
    await settled(tab, fake)
    assert await tab.value("document.getElementById('start').getAttribute('aria-disabled')") == "false"


@on_page()
async def test_start_is_pressed_for_a_second_on_the_keyboard(tab: Tab, fake: FakeConsole) -> None:
    await tab.value("document.getElementById('start').focus()")
    before = await sends_nothing(tab, fake, lambda: tab.stroke("Enter"))
    await tab.key("Down", "Enter")
    await state(tab, "running")
    await tab.key("Up", "Enter")
    assert await done(fake) == [*before, "start"]


@on_page()
async def test_the_preflight_line_locks_start(tab: Tab, fake: FakeConsole) -> None:
    fake.ready = False
    await fake.publish()
    await tab.until("document.getElementById('preflight').dataset.ready === 'false'")
    assert "2.4 s old" in await text(tab, "preflight-items")
    await tab.click("#start", 1.2)
    assert await done(fake) == []
    fake.ready = True
    await fake.publish()
    await tab.until("document.getElementById('start').getAttribute('aria-disabled') === 'false'")
    at = await tab.press("#start")
    await state(tab, "running")
    await tab.mouse("Released", *at)
    assert await done(fake) == ["start"]


@on_page()
async def test_hold_resume_and_abort_take_one_click(tab: Tab, fake: FakeConsole) -> None:
    fake.state = "running"
    await fake.publish()
    await state(tab, "running")
    assert "drifts with the current" in await text(tab, "meanwhile")
    await tab.click("#hold")
    await state(tab, "holding")
    assert "Resume" in await text(tab, "meanwhile")
    await tab.click("#resume")
    await state(tab, "running")
    await tab.click("#open-gains")
    await tab.click("#abort")
    await state(tab, "aborted")
    await tab.click("#abort")
    await tab.key("Down", "Escape", modifiers=8)
    assert await done(fake) == ["hold", "resume", "abort", "abort", "abort"]
    await tab.until("document.getElementById('events').textContent.includes('browser 1: abort')")


@on_page()
async def test_a_mission_is_checked_before_it_is_sent(tab: Tab, fake: FakeConsole) -> None:
    await tab.click("#open-mission")
    await tab.until("document.getElementById('mission-choice').options.length > 1")
    await tab.value(
        "(c => { c.value = 'helix'; c.dispatchEvent(new Event('change')); })"
        "(document.getElementById('mission-choice'))"
    )
    await tab.until("document.getElementById('mission-text').value.includes('name: helix')")
    await tab.type("#mission-text", "version: 1\nthrust: -5\n")
    assert await tab.value("document.getElementById('load').disabled")
    await tab.click("#check")
    await tab.until("document.getElementById('check-lines').className === 'bad'")
    assert "found -5, expected" in await text(tab, "check-lines")
    assert await tab.value("document.getElementById('load').disabled")
    await tab.type("#mission-text", "version: 1\nthrust: 5\n")
    await tab.click("#check")
    await tab.until("!document.getElementById('load').disabled")
    assert "radius of 12.0 m" in await text(tab, "check-lines")
    fake.state = "running"
    await tab.click("#load")
    await tab.until("document.getElementById('check-lines').className === 'bad'")
    assert "not while running" in await text(tab, "check-lines")
    fake.state = "idle"
    await tab.type("#start-at", "50 m")
    await tab.click("#load")
    await tab.until("document.getElementById('check-lines').className === 'ok'")
    assert [(one["text"], one.get("start_at")) for one in await fake.requests("load")] == [
        ("version: 1\nthrust: 5\n", None), ("version: 1\nthrust: 5\n", "50 m"),
    ]  # fmt: skip


@on_page()
async def test_gains_change_and_limits_ask_first(tab: Tab, fake: FakeConsole) -> None:
    await tab.click("#open-gains")
    field = "[data-name='autopilot.nism.k1'] input"
    await tab.until(f"document.querySelector({field!r})")

    async def values() -> list[tuple[str, float]]:
        return [(one["name"], one["value"]) for one in await fake.requests("set")]

    gain = f"document.querySelector({field!r}).closest('.gain')"
    await tab.type(field, "-3")
    await tab.until(f"{gain}.querySelector('.said').textContent.includes('out of range Min: 0.0')")
    assert await tab.value(f"document.querySelector({field!r}).value") == "0.45"
    await tab.type(field, "many")
    await tab.type(field, "0.5")
    await tab.until(f"{gain}.className === 'gain changed'")
    await tab.click("[data-name='autopilot.nism.k1'] .back")
    await tab.until(f"{gain}.className === 'gain'")
    await tab.value("document.getElementById('limits-box').open = true")
    await tab.type("#p-heading_autopilot-odometry_timeout", "2")
    limit = "[data-name='odometry_timeout']"
    await tab.until(f"!document.querySelector({limit + ' .confirm'!r}).hidden")
    assert await values() == [
        ("autopilot.nism.k1", -3),
        ("autopilot.nism.k1", 0.5),
        ("autopilot.nism.k1", 0.45),
    ]
    await tab.click(f"{limit} .yes")
    assert (await values())[3:] == [("odometry_timeout", 2)]
    assert fake.gains[2]["value"] == 2
    changed = {"vehicle": 0, "node": "heading_autopilot", "name": "autopilot.nism.k1", "value": 0.7}
    await fake.send({"kind": "parameters_changed", **changed})
    await tab.until(f"document.querySelector({field!r}).value === '0.7'")
    await tab.click("#save-gains")
    await tab.until("document.getElementById('answer').textContent.includes('console.yaml')")
    assert "autopilot.nism.k3: 1.4" in await tab.downloaded("console.yaml")


@on_page()
async def test_an_alarm_stays_until_it_is_acknowledged(tab: Tab, fake: FakeConsole) -> None:
    fake.alarms = [{"id": 7, "text": "no odometry", "since": 81.0, "active": True, "acknowledged": False}]
    await fake.publish()
    await tab.until("document.querySelector('.alarm')?.textContent.includes('no odometry')")
    fake.alarms[0]["active"] = False
    await fake.publish()
    await tab.until("document.querySelector('.alarm')?.textContent.includes('(over)')")
    assert await text(tab, "mute") == "Sound waits"
    await tab.click(".alarm button")
    await tab.until("document.getElementById('alarms').hidden")
    assert [one["alarm"] for one in await fake.requests()] == [7]
    await tab.click("#mute")
    await tab.until("document.getElementById('mute').textContent === 'Sound off'")


@on_page()
async def test_a_silent_guidance_makes_the_state_grey(tab: Tab, fake: FakeConsole) -> None:
    fake.state, fake.silent = "running", "guidance"
    await fake.publish()
    await tab.until("document.getElementById('state-reason').textContent.includes('silent')")
    await state(tab, "silent")
    assert await tab.value("document.querySelectorAll('#health tr.silent').length") == 1
    assert not await tab.value("document.getElementById('abort').disabled")


@on_page()
async def test_a_viewer_has_no_commands(tab: Tab, fake: FakeConsole) -> None:
    assert await tab.value("document.getElementById('commands').offsetParent !== null")
    fake.may_command = False
    await tab.open(f"http://127.0.0.1:{fake.port}/")
    await tab.until("document.getElementById('commands').hidden")
    assert await tab.value("document.getElementById('view-only').offsetParent !== null")
    await tab.click("#open-mission")
    await tab.type("#mission-text", "version: 1\nthrust: 5\n")
    assert await tab.value("document.getElementById('check').disabled")


@on_page()
async def test_everything_has_a_name_for_a_screen_reader(tab: Tab, fake: FakeConsole) -> None:
    for name in ("open-gains", "open-mission", "open-watch"):
        await tab.click(f"#{name}")
        await settled(tab, fake)
        tree = await tab.call("Accessibility.getFullAXTree")
        roles = {"button", "textbox", "searchbox", "combobox", "checkbox", "tab", "progressbar", "image"}
        used = [node for node in tree["nodes"] if node.get("role", {}).get("value") in roles]
        assert len(used) > 20
        assert [node["role"]["value"] for node in used if not node.get("name", {}).get("value")] == []
