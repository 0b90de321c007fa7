"""Every request that the console refuses, and the few that it does not."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest
from aiohttp import WSServerHandshakeError

from auv_sim.views.console.web.page_guard import PageGuard, Tokens, new_tokens
from auv_sim.views.console.web.page_sessions import LIFETIME, PageSessions
from page_bench import PageBench, page_bench


def on_bench(test: Callable[[PageBench], Awaitable[None]], **options: Any) -> None:
    async def run() -> None:
        async with page_bench(**options) as bench:
            await test(bench)

    asyncio.run(run())


@pytest.mark.parametrize(
    ("method", "path", "headers", "has_cookie", "status"),
    [
        ("GET", "/", {}, False, 403),
        ("GET", "/page/console.js", {}, False, 403),
        ("GET", "/?token=wrong", {}, False, 403),
        ("GET", "/?token=", {}, False, 403),
        ("GET", "/?token=%C3%A9", {}, False, 403),
        ("GET", "/", {"Host": "evil.example"}, True, 421),
        ("GET", "/", {"Host": "127.0.0.1.evil.example:80"}, True, 421),
        ("GET", "/", {"Host": "evil.example:127"}, True, 421),
        ("GET", "/", {"Host": ""}, True, 421),
        ("POST", "/", {}, True, 405),
        ("PUT", "/socket", {}, True, 405),
        ("DELETE", "/page/console.html", {}, True, 405),
        ("OPTIONS", "/socket", {}, True, 405),
        ("GET", "/nothing", {}, True, 404),
        ("GET", "/page/nothing.js", {}, True, 404),
        ("GET", "/page/../web/page_guard.py", {}, True, 404),
        ("GET", "/page/%2e%2e/%2e%2e/__init__.py", {}, True, 404),
        ("GET", "/page/..%2f..%2f__init__.py", {}, True, 404),
        ("GET", "/page//etc/passwd", {}, True, 404),
        ("GET", "/socket", {}, True, 403),
        ("GET", "/socket", {"Origin": "http://evil.example"}, True, 403),
        ("GET", "/socket", {"Origin": "null"}, True, 403),
    ],
)
def test_what_is_refused(
    method: str, path: str, headers: dict[str, str], has_cookie: bool, status: int
) -> None:
    async def check(bench: PageBench) -> None:
        cookie = await bench.cookie(bench.tokens.control) if has_cookie else {}
        own = bench.client.make_url("/")
        url = type(own)(bench.origin + path, encoded=True)  # as it is, dots and all
        response = await bench.client.session.request(
            method, url, headers={**cookie, **headers}, allow_redirects=False
        )
        assert response.status == status
        assert "no-referrer" in response.headers["Referrer-Policy"]

    on_bench(check)


def test_a_token_becomes_a_cookie_and_leaves_the_address() -> None:
    async def check(bench: PageBench) -> None:
        response = await bench.client.get("/", params={"token": bench.tokens.control}, allow_redirects=False)
        assert (response.status, response.headers["Location"]) == (303, "/")
        cookie = response.cookies[bench.cookie_name]
        assert (cookie["httponly"], cookie["samesite"], cookie["path"]) == (True, "Strict", "/")
        assert cookie.value not in bench.tokens
        headers = await bench.cookie(bench.tokens.control)
        page = await bench.client.get("/", headers=headers)
        assert page.status == 200
        assert page.content_type == "text/html"
        policy = page.headers["Content-Security-Policy"].split("; ")
        assert {"default-src 'none'", "script-src 'self'", "style-src 'self'", "frame-ancestors 'none'"} <= {
            *policy
        }
        assert "unsafe" not in page.headers["Content-Security-Policy"]
        assert page.headers["X-Content-Type-Options"] == "nosniff"
        wrong = {"Cookie": f"{bench.cookie_name}={cookie.value[:-1]}"}
        assert (await bench.client.get("/", headers=wrong)).status == 403

    on_bench(check)


def test_a_page_of_another_origin_gets_no_socket() -> None:
    async def check(bench: PageBench) -> None:
        cookie = await bench.cookie(bench.tokens.control)
        for origin in (
            "http://evil.example",
            "https" + bench.origin.removeprefix("http"),
            bench.origin + "0",
        ):
            with pytest.raises(WSServerHandshakeError) as refused:
                await bench.client.ws_connect("/socket", headers={**cookie, "Origin": origin})
            assert refused.value.status == 403
        with pytest.raises(WSServerHandshakeError) as refused:
            await bench.client.ws_connect("/socket", headers={"Origin": bench.origin})
        assert refused.value.status == 403, "no cookie"

    on_bench(check)


@pytest.mark.parametrize(
    ("names", "host", "is_own"),
    [
        ((), "127.0.0.1:8642", True),
        ((), "LocalHost:9000", True),
        ((), "[::1]:8642", True),
        ((), "[::1]", True),
        ((), "192.168.7.5:8642", False),
        (("192.168.7.5",), "192.168.7.5:8642", True),
        (("0.0.0.0",), "192.168.7.5:8642", True),  # noqa: S104
        (("0.0.0.0",), "boat.example:8642", False),  # noqa: S104
        (("[::]",), "[fe80::1]:8642", True),
        ((), "localhost:8642:80", False),
        ((), "localhost.", False),
    ],
)
def test_hosts(names: tuple[str, ...], host: str, is_own: bool) -> None:
    guard = PageGuard(new_tokens(False), names, PageSessions(None, lambda: 0.0))
    assert guard.is_own_host(host) is is_own


def test_view_only_takes_commands_from_no_one() -> None:
    sessions = PageSessions(None, lambda: 0.0)
    with_control = PageGuard(Tokens("secret", "look"), (), sessions)
    cookie = with_control.session_of("secret")
    assert with_control.may_command(cookie) is True
    assert with_control.may_command(with_control.session_of("look")) is False
    assert with_control.may_command("other") is None
    view_only = PageGuard(Tokens("", "look"), (), sessions)
    assert view_only.session_of("") is None
    assert view_only.session_of("secret") is None
    assert view_only.may_command(cookie) is False, "of a start that allowed it"


def test_cookies_outlive_a_restart_but_not_their_time(tmp_path: Path) -> None:
    now, file = [1000.0], tmp_path / "cookies.json"
    cookie = PageSessions(file, lambda: now[0]).begin(may_command=True)
    assert cookie not in file.read_text()
    assert file.stat().st_mode & 0o077 == 0
    again = PageSessions(file, lambda: now[0])
    assert again.find(cookie) is True
    look = again.begin(may_command=False)
    now[0] += LIFETIME - 1.0
    assert PageSessions(file, lambda: now[0]).find(look) is False
    now[0] += 2.0
    assert PageSessions(file, lambda: now[0]).find(cookie) is None
    file.write_text("[1, 2]")
    assert PageSessions(file, lambda: now[0]).find(cookie) is None


def test_two_tunnels_to_two_consoles_have_two_cookies() -> None:
    async def check(bench: PageBench) -> None:
        url, token = bench.client.make_url("/"), {"token": bench.tokens.control}
        found = []
        for host in ("localhost:9001", "localhost:9002", "[::1]:9003", "localhost"):
            response = await bench.client.session.get(
                url, params=token, headers={"Host": host}, allow_redirects=False
            )
            found += response.cookies
        assert found == [f"auv_console_{port}" for port in (9001, 9002, 9003, 80)]

    on_bench(check)


def test_the_address_to_look_takes_no_control_away() -> None:
    async def check(bench: PageBench) -> None:
        look = {"token": bench.tokens.view}
        for token, cookies in ((bench.tokens.control, 0), (bench.tokens.view, 1)):
            headers = await bench.cookie(token)
            response = await bench.client.get("/", params=look, headers=headers, allow_redirects=False)
            assert (response.status, len(response.cookies)) == (303, cookies)

    on_bench(check)


def test_a_cookie_counts_anew_when_the_page_is_opened_or_connects() -> None:
    async def check(bench: PageBench) -> None:
        headers = await bench.cookie(bench.tokens.control)
        bench.now += 0.9 * LIFETIME
        page = await bench.client.get("/", headers=headers)
        assert int(page.cookies[bench.cookie_name]["max-age"]) == LIFETIME
        bench.now += 0.9 * LIFETIME
        socket = await bench.client.ws_connect("/socket", headers={**headers, "Origin": bench.origin})
        bench.now += 0.9 * LIFETIME
        assert (await bench.client.get("/page/console.html", headers=headers)).status == 200
        await socket.close()
        bench.now += 0.2 * LIFETIME
        assert (await bench.client.get("/", headers=headers)).status == 403

    on_bench(check)
