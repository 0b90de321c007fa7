"""What the console's page draws, when it draws, and that its link comes back, in a real Chromium."""

from __future__ import annotations

import asyncio
import json
import math
from collections.abc import Iterator

import pytest

from auv_path_following.missions import geodesy
from auv_path_following.missions.geodesy import Origin
from chromium import Tab
from console_fake import FakeConsole
from console_flight import COLUMNS
from console_stage import Stage, by_day, on_page, pixels, settled, stages

ROWS = "(await import('/page/flights.js')).flights.vehicles[0].table.n"
PAINTS = "import('/page/painting.js').then(m => m.painting.count)"


@pytest.fixture(scope="module")
def stage() -> Iterator[Stage]:
    yield from stages()


def degrees(fake: FakeConsole, north: float, east: float) -> tuple[float, float]:
    """Return the latitude and longitude of a place."""
    at = fake.course["origin"]
    origin = Origin(latitude_deg=at["latitude"], longitude_deg=at["longitude"])
    latitude, longitude = geodesy.to_geodetic(origin, north, east)
    return float(latitude), float(longitude)


@on_page()
async def test_path_track_fence_and_vehicle_are_where_they_are(tab: Tab, fake: FakeConsole) -> None:
    colours, column = by_day(), list(COLUMNS).index
    fake.state = "running"
    await fake.advance(5)
    await settled(tab, fake)
    x, y = fake.rows[600, column("x")], fake.rows[600, column("y")]
    assert colours["blue"] in await pixels(tab, float(y), float(x), 1)
    ahead = fake.rows[2000]
    assert await pixels(tab, float(ahead[column("y")]), float(ahead[column("x")])) == [colours["path"]]
    row = fake.rows[fake.flown - 1]
    assert await pixels(tab, float(row[column("y")]), float(row[column("x")])) == [colours["orange"]]
    (x0, y0), (x1, _), *_ = fake.course["fence"]
    along = [p for k in range(30) for p in await pixels(tab, y0, x0 + (0.3 + 0.002 * k) * (x1 - x0), 1)]
    assert colours["red"] in along
    assert await pixels(tab, y0 - 30.0, x0 - 10.0) in ([(0, 0, 0)], [colours["grid"]])


@on_page()
async def test_the_pointer_reads_degrees_range_and_bearing(tab: Tab, fake: FakeConsole) -> None:
    place = await tab.value(
        "import('/page/chart.js').then(async m => {"
        " const r = document.getElementById('chart').getBoundingClientRect();"
        " const [x, y] = [Math.round(r.x) + 100, Math.round(r.y) + 120];"
        " const { placeAt } = await import('/page/map_drawing.js');"
        " return [x, y, ...placeAt(m.view, r.width, r.height, x - r.x, y - r.y)]; })"
    )
    await tab.mouse("Moved", place[0], place[1])
    await settled(tab, fake)
    said = await tab.value("document.getElementById('pointer').textContent")
    latitude, longitude = degrees(fake, place[2], place[3])
    found = [float(word) for word in said.rpartition("·")[2].split(",")]
    assert found == pytest.approx([latitude, longitude], abs=6e-6)
    row = dict(zip(COLUMNS, fake.rows[fake.flown - 1].tolist(), strict=True))
    north, east = place[2] - row["y"], place[3] - row["x"]
    words = said.partition("from vehicle")[2].split()
    assert float(words[0]) == pytest.approx(math.hypot(north, east), abs=0.06)
    assert float(words[2][:-1]) == pytest.approx(math.degrees(math.atan2(east, north)) % 360, abs=0.51)


@on_page()
async def test_follow_course_up_and_the_ruler(tab: Tab, fake: FakeConsole) -> None:
    for name in ("follow", "course-up", "ruler"):
        await tab.click(f"#{name}")
    await fake.advance(3)
    await settled(tab, fake)
    row = dict(zip(COLUMNS, fake.rows[fake.flown - 1].tolist(), strict=True))
    view = await tab.value("import('/page/chart.js').then(m => m.view)")
    assert (view["x"], view["y"]) == pytest.approx((row["y"], row["x"]))
    assert view["up"] == pytest.approx(math.pi / 2 - row["yaw"])
    at = await tab.middle("#chart")
    for dx in (0.0, 80.0):
        await tab.mouse("Moved", at[0] + dx, at[1])
        await tab.mouse("Pressed", at[0] + dx, at[1])
        await tab.mouse("Released", at[0] + dx, at[1])
    ends = await tab.value("import('/page/chart.js').then(m => m.measure)")
    north, east = (b - a for a, b in zip(ends["from"], ends["to"], strict=True))
    assert math.hypot(north, east) == pytest.approx(80.0 / view["scale"], rel=1e-6)
    # To the right of what is up: starboard of the heading.
    assert math.remainder(math.atan2(east, north) - view["up"], 2 * math.pi) == pytest.approx(math.pi / 2)


@on_page()
async def test_an_overlay_of_degrees_is_placed_by_the_origin(tab: Tab, fake: FakeConsole) -> None:
    places = [degrees(fake, 300.0, east) for east in (60.0, 480.0)]
    line = {"type": "LineString", "coordinates": [[lon, lat] for lat, lon in places]}
    await choose(tab, json.dumps({"type": "Feature", "geometry": line}))
    await tab.until("document.getElementById('overlay-words').textContent.includes('1 lines')")
    await settled(tab, fake)
    # Between two legs, where nothing else is drawn.
    assert by_day()["brown"] in [p for k in range(-2, 3) for p in await pixels(tab, 300.0, 250.0 + k, 2)]
    await choose(tab, '{"type": "Point", "coordinates": [630000, 103000]}')
    await tab.until("document.getElementById('overlay-words').textContent.includes('expected [longitude')")


async def choose(tab: Tab, text: str) -> None:
    """Choose a file of this text as the overlay."""
    await tab.value(
        f"(() => {{ const t = new DataTransfer(); t.items.add(new File([{text!r}], 'coast.geojson'));"
        " const i = document.getElementById('overlay'); i.files = t.files;"
        " i.dispatchEvent(new Event('change')); })()"
    )


@on_page()
async def test_all_strips_share_one_cursor(tab: Tab, fake: FakeConsole) -> None:
    titles = await tab.value(
        "[...document.querySelectorAll('.strip:not([hidden]) strong')].map(e => e.textContent)"
    )
    assert titles[0] == "Cross-track ye (m)"
    assert "Planes (°)" not in titles
    x, y = await tab.middle(".strip:not([hidden]) canvas")
    await tab.mouse("Moved", x, y)
    await settled(tab, fake)
    time = await tab.value("import('/page/strips.js').then(m => m.cursor.at)")
    assert await tab.value("document.getElementById('cursor-time').textContent") == f"at {time:.1f} s"
    row = fake.rows[fake.rows[:, 0] <= time][-1]
    shown = await tab.value("document.querySelector('.strip:not([hidden]) b').textContent")
    assert float(shown) == pytest.approx(row[list(COLUMNS).index("ye")], abs=0.0051)


@on_page(mission="helix")
async def test_a_dive_has_depth_and_planes(tab: Tab, fake: FakeConsole) -> None:
    titles = await tab.value(
        "[...document.querySelectorAll('.strip:not([hidden]) strong')].map(e => e.textContent)"
    )
    assert titles[0] == "Depth (m)"
    assert {"Vertical ze (m)", "Planes (°)"} < set(titles)
    shown = await tab.value("document.getElementById('now-depth').textContent")
    assert float(shown.split()[0]) == pytest.approx(-fake.rows[fake.flown - 1, 3], abs=0.06)


@on_page(vehicles=2)
async def test_two_vehicles_share_the_chart(tab: Tab, fake: FakeConsole) -> None:
    column = list(COLUMNS).index
    x, y = float(fake.rows[600, column("x")]), float(fake.rows[600, column("y")])
    assert by_day()["orange"] in await pixels(tab, y, x + 90.0, 1)
    await tab.click("#vehicles button:nth-child(2)")
    await tab.click("#abort")
    assert [(one["vehicle"], one["namespace"]) for one in await fake.requests()] == [(1, "/auv2")]
    await settled(tab, fake)
    pressed = "[...document.querySelectorAll('#vehicles button')].map(e => e.getAttribute('aria-pressed'))"
    assert await tab.value(pressed) == ["false", "true"]
    await vehicles_do_not_share_what_is_prepared(tab, fake)


async def vehicles_do_not_share_what_is_prepared(tab: Tab, fake: FakeConsole) -> None:
    """Leave a vehicle during a press of Start, with a checked mission, and with its gains in sight."""
    is_pressed = "document.getElementById('start').classList.contains('pressed')"
    at = await tab.press("#start")
    assert await tab.value(is_pressed)
    await tab.key("Down", "1")
    assert not await tab.value(is_pressed)
    await tab.pause(1.1)
    await tab.mouse("Released", *at)
    await tab.click("#open-mission")
    await tab.type("#mission-text", "version: 1\nthrust: 5\n")
    await tab.click("#check")
    await tab.until("!document.getElementById('load').disabled")
    draft = "import('/page/chart.js').then(m => m.view.draft !== null)"
    assert await tab.value(draft)
    await tab.click("#vehicles button:nth-child(2)")
    assert await tab.value("document.getElementById('load').disabled")
    assert not await tab.value(draft)
    await tab.click("#open-gains")
    field = "[data-name='autopilot.nism.k1'] input"
    await tab.until(f"document.querySelector({field!r})")
    await tab.click("#vehicles button:nth-child(1)")
    await tab.until(f"document.querySelector({field!r})")
    await tab.type(field, "0.5")
    sent = await fake.requests("start", "check", "parameters", "set")
    found = [(one["do"], one["namespace"]) for one in sent]
    assert found == [("check", "/auv1"), ("parameters", "/auv2"), ("parameters", "/auv1"), ("set", "/auv1")]


@on_page()
async def test_it_paints_ten_times_a_second_on_new_data_only(tab: Tab, fake: FakeConsole) -> None:
    before = await tab.value(PAINTS)
    await tab.pause(0.7)
    assert await tab.value(PAINTS) == before
    begun = await tab.value("performance.now()")
    for _ in range(60):
        await fake.advance(1)
        await asyncio.sleep(0.01)  # so that the page sees new data many times
    await settled(tab, fake)
    await fake.advance(1)
    await settled(tab, fake)
    seconds = (await tab.value("performance.now()") - begun) / 1000
    assert 2 <= await tab.value(PAINTS) - before <= 10 * seconds + 1


@on_page()
async def test_a_hidden_page_paints_nothing_and_misses_nothing(tab: Tab, fake: FakeConsole) -> None:
    await tab.window("minimized")
    await tab.until("document.hidden")
    before = await tab.value(PAINTS)
    for _ in range(5):
        await fake.advance(4)
    await tab.until(f"(async () => {ROWS})().then(n => n === {fake.flown})")
    await tab.pause(0.3)
    assert await tab.value(PAINTS) == before
    await tab.window("normal")
    await tab.until(f"{PAINTS}.then(n => n > {before})")


@on_page()
async def test_a_server_that_comes_back_shows_the_track_again(tab: Tab, fake: FakeConsole) -> None:
    tab.expected += ["ERR_CONNECTION_", "ERR_EMPTY_RESPONSE", "WebSocket connection to"]
    port = fake.port
    await fake.stop()
    await tab.until("!document.getElementById('banner').hidden")
    await tab.until("document.getElementById('state').dataset.state === 'silent'")
    await tab.click("#abort")
    await tab.until("document.getElementById('answer').textContent === 'Abort: no link: nothing was sent'")
    fake.started = "second"
    await fake.start(port)
    await tab.until("document.getElementById('banner').hidden")
    await tab.until(f"(async () => {ROWS})().then(n => n === {fake.flown})")
    await fake.advance(4)
    await tab.until(f"(async () => {ROWS})().then(n => n === {fake.flown})")


@on_page()
async def test_the_policy_against_foreign_code_is_in_force(tab: Tab, fake: FakeConsole) -> None:
    await tab.value("document.body.setAttribute('style', 'color: red')")
    assert not await tab.value("fetch('http://127.0.0.1:9/').then(() => true, () => false)")
    tab.expected += ["inline style violates", "'http://127.0.0.1:9/' violates", "load http://127.0.0.1:9/"]
    for words in tab.expected:
        await fake.until(lambda words=words: words in "".join(tab.complaints))  # type: ignore[misc]
    tab.requests[:] = [url for url in tab.requests if ":9/" not in url]


@on_page()
async def test_a_phone_shows_everything_in_its_width(tab: Tab, fake: FakeConsole) -> None:
    await tab.size(390, 844, mobile=True)
    await settled(tab, fake)
    assert await tab.value("document.documentElement.scrollWidth") <= 390
    for name in ("abort", "start"):
        box = await tab.value(f"document.getElementById('{name}').getBoundingClientRect().toJSON()")
        assert (box["left"] >= 0, box["right"] <= 390, box["bottom"] <= 844) == (True, True, True)
        assert box["height"] >= 44


@on_page()
async def test_night_changes_the_drawing_too(tab: Tab, fake: FakeConsole) -> None:
    column = list(COLUMNS).index
    place = float(fake.rows[2000, column("y")]), float(fake.rows[2000, column("x")])
    assert await pixels(tab, *place) == [by_day()["path"]]
    await tab.click("#light")
    await tab.click("#light")
    await settled(tab, fake)
    assert await tab.value("document.documentElement.dataset.light") == "night"
    assert await pixels(tab, *place) not in ([by_day()["path"]], [(0, 0, 0)])
    await tab.click("#light")
