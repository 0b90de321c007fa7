"""A press on the console's page counts, whatever arrives between press and release."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from chromium import Tab
from console_fake import FakeConsole
from console_stage import Stage, on_page, settled, stages

FOCUS = "document.activeElement.textContent"


@pytest.fixture(scope="module")
def stage() -> Iterator[Stage]:
    yield from stages()


def alarm(number: int) -> dict[str, Any]:
    """Return an alarm as in the protocol."""
    text = f"node {number} is silent"
    return {"id": number, "text": text, "since": 81.0, "active": True, "acknowledged": False}


async def raise_alarms(tab: Tab, fake: FakeConsole, *numbers: int) -> None:
    """Raise alarms and wait until they are in sight."""
    fake.alarms += [alarm(number) for number in numbers]
    await fake.publish()
    await settled(tab, fake)


async def places(tab: Tab) -> list[Any]:
    """Return where the commands are in windows of three widths."""
    found = []
    for width, height in ((1280, 800), (1000, 700), (390, 844)):
        await tab.size(width, height, mobile=width < 700)
        await tab.calm()
        found.append(
            await tab.value(
                "[...document.querySelectorAll('#commands button')]"
                ".map(e => e.getBoundingClientRect().toJSON())"
            )
        )
    return found


@on_page()
async def test_abort_is_sent_with_the_press_and_once(tab: Tab, fake: FakeConsole) -> None:
    at = await tab.press("#abort")
    assert len(await fake.requests()) == 1
    await raise_alarms(tab, fake, 1, 2)
    await tab.mouse("Moved", at[0], at[1] + 300.0)
    await tab.mouse("Released", at[0], at[1] + 300.0)
    assert [one["do"] for one in await fake.requests()] == ["abort"]
    await tab.value("document.getElementById('abort').focus()")
    for key, text in (("Enter", "\r"), (" ", " ")):
        await tab.key("Down", key, text=text, windowsVirtualKeyCode=ord(text))
        await tab.key("Up", key, windowsVirtualKeyCode=ord(text))
    assert [one["do"] for one in await fake.requests()] == ["abort"] * 3
    for kind in ("mousePressed", "mouseReleased"):
        await tab.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="right")
    assert len(await fake.requests()) == 3


async def button(tab: Tab, kind: str, at: tuple[float, float], name: str, held: int) -> None:
    """Press or release a button of the mouse; `held` is the sum of those held after it: left 1, right 2."""
    more = {"x": at[0], "y": at[1], "button": name, "buttons": held, "clickCount": 1}
    await tab.call("Input.dispatchMouseEvent", type=f"mouse{kind}", **more)


@on_page()
async def test_abort_is_sent_once_while_another_button_is_held(tab: Tab, fake: FakeConsole) -> None:
    at = await tab.aim("#abort")
    away = (at[0], at[1] + 300.0)
    await button(tab, "Pressed", at, "right", 2)
    for count, end in enumerate((at, away, at), 1):
        await button(tab, "Pressed", at, "left", 3)
        assert len(await fake.requests()) == count
        await button(tab, "Moved", end, "none", 3)
        await button(tab, "Released", end, "left", 2)
        assert len(await fake.requests()) == count
    await button(tab, "Released", at, "right", 0)
    await button(tab, "Pressed", at, "left", 1)
    await button(tab, "Pressed", at, "right", 3)
    await button(tab, "Moved", away, "none", 3)
    await button(tab, "Released", away, "left", 2)
    await button(tab, "Pressed", at, "left", 3)
    await button(tab, "Released", at, "left", 2)
    await button(tab, "Released", at, "right", 0)
    assert [one["do"] for one in await fake.requests()] == ["abort"] * 5


@on_page()
async def test_abort_is_sent_once_for_a_press_however_it_is_made(tab: Tab, fake: FakeConsole) -> None:
    await tab.click("#abort")
    assert len(await fake.requests()) == 1
    at = await tab.press("#abort")
    await tab.mouse("Moved", at[0], at[1] + 300.0, is_held=True)
    await tab.mouse("Released", at[0], at[1] + 300.0)
    assert len(await fake.requests()) == 2
    await tab.key("Down", "Enter", text="\r", windowsVirtualKeyCode=13)
    await tab.key("Up", "Enter", windowsVirtualKeyCode=13)
    assert len(await fake.requests()) == 3
    presses = [[], ["Pointer pointerdown", "Pointer pointerup"], ["Mouse mousedown"]]
    ways = [[*press, f"Mouse click {detail}"] for press in presses for detail in (0, 1)]
    ways += [["Pointer pointerdown", "Pointer pointercancel"], ["Mouse click 0"]]
    for count, way in enumerate(ways, 4):
        for event in way:
            kind, name, detail = f"{event} 0".split()[:3]
            options = f"{{ bubbles: true, detail: {detail} }}"
            made = f"new {kind}Event({name!r}, {options})"
            await tab.value(f"document.getElementById('abort').dispatchEvent({made})")
        assert len(await fake.requests()) == count, way


@on_page()
async def test_commands_stay_where_they_are(tab: Tab, fake: FakeConsole) -> None:
    before = await places(tab)
    fake.state, fake.reason = "running", "a reason of many words, " * 9
    await raise_alarms(tab, fake, 1, 2, 3)
    assert await places(tab) == before
    tab.expected += ["ERR_CONNECTION_", "ERR_EMPTY_RESPONSE", "WebSocket connection to"]
    port = fake.port
    await fake.stop()
    await tab.until("!document.getElementById('banner').hidden")
    assert await places(tab) == before
    await fake.start(port)


@on_page(vehicles=2)
async def test_a_vehicle_is_chosen_though_its_state_changes(tab: Tab, fake: FakeConsole) -> None:
    second = "#vehicles button:nth-child(2)"
    at = await tab.press(second)
    fake.state = "running"
    await raise_alarms(tab, fake, 1)
    assert "running" in await tab.value(f"document.querySelector({second!r}).textContent")
    await tab.mouse("Released", *at)
    await tab.click("#abort")
    assert [one["namespace"] for one in await fake.requests()] == ["/auv2"]
    await tab.value(f"document.querySelector({second!r}).focus()")
    fake.state = "holding"
    await fake.publish()
    await settled(tab, fake)
    assert "holding" in await tab.value(FOCUS), "the button keeps the focus"


@on_page()
async def test_an_alarm_is_acknowledged_though_others_come_and_go(tab: Tab, fake: FakeConsole) -> None:
    await raise_alarms(tab, fake, 6, 7)
    second = ".alarm:nth-child(2) button"
    at = await tab.press(second)
    await raise_alarms(tab, fake, 8, 9)
    del fake.alarms[0]  # by another browser
    await fake.publish()
    await settled(tab, fake)
    await tab.mouse("Released", *at)
    assert [one["alarm"] for one in await fake.requests()] == [7]


@on_page()
async def test_a_third_alarm_puts_no_other_button_below_the_pointer(tab: Tab, fake: FakeConsole) -> None:
    await raise_alarms(tab, fake, 6, 7)
    at = await tab.aim(".alarm button")
    await raise_alarms(tab, fake, 8)
    await tab.mouse("Pressed", *at)
    await tab.mouse("Released", *at)
    assert [one["alarm"] for one in await fake.requests()] == [6]
    await raise_alarms(tab, fake, 9, 10)
    await tab.click(".alarm.all button")
    assert sorted(one["alarm"] for one in (await fake.requests())[1:]) == [7, 8, 9, 10]


@on_page()
async def test_a_press_that_is_released_elsewhere_makes_no_click(tab: Tab, fake: FakeConsole) -> None:
    at = await tab.press("#light")
    await tab.mouse("Moved", at[0] - 90.0, at[1] - 90.0, is_held=True)
    await tab.mouse("Released", at[0] - 90.0, at[1] - 90.0)
    assert await tab.value("document.getElementById('light').textContent") == "Auto"
    await tab.click("#light")
    assert await tab.value("document.getElementById('light').textContent") == "Day"
    at = await tab.press("#light")
    await tab.mouse("Moved", at[0] - 90.0, at[1] - 90.0, is_held=True)
    await tab.mouse("Moved", *at, is_held=True)
    await tab.mouse("Released", *at)
    assert await tab.value("document.getElementById('light').textContent") == "Night"
