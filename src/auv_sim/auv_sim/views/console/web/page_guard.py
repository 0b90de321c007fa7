"""Which requests the console answers: the right host, the right origin, a token or the cookie it became.

It listens on the loopback interface unless an address is given. That alone is no protection: any web page
that is open in the operator's browser can send requests to 127.0.0.1. So a request needs

- a Host that is one of this console's names, against names of others that resolve to 127.0.0.1;
- the token of this start in the address, once, or the cookie that it is turned into;
- on the socket, through which alone commands come, an Origin equal to the Host.
"""

from __future__ import annotations

import hmac
import ipaddress
import secrets
from collections.abc import Iterable
from typing import NamedTuple

from auv_sim.views.console.web.page_sessions import PageSessions

#: Sent with every response. Style and script come from the console alone, and nothing is inline.
HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self';"
    " img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none';"
    " frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
_LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


class Tokens(NamedTuple):
    """The secrets of one start.

    Attributes:
        control: of the address that may command; empty where none may.
        view: of the address that may not.
    """

    control: str
    view: str


def new_tokens(view_only: bool) -> Tokens:
    """Return new secrets; without one for control if `view_only`."""
    return Tokens("" if view_only else secrets.token_urlsafe(24), secrets.token_urlsafe(24))


class PageGuard:
    """Judges requests.

    Args:
        tokens: of this start.
        names: of this machine beside the loopback's, without port.
        sessions: the cookies in force.
    """

    def __init__(self, tokens: Tokens, names: Iterable[str], sessions: PageSessions) -> None:
        self._tokens, self._sessions = tokens, sessions
        self._names = {name.lower() for name in (*_LOOPBACK, *names)}
        self._takes_addresses = any(name in ("0.0.0.0", "[::]") for name in self._names)  # noqa: S104

    @staticmethod
    def cookie_name(host: str | None) -> str:
        """Return the name of the cookie under a Host header, with its port.

        Browsers send a cookie to every port of a host, and two tunnels to two consoles have one host.
        """
        port = (host or "").rpartition(":")[2]
        return f"auv_console_{port if port.isdecimal() else 80}"

    def is_own_host(self, host: str | None) -> bool:
        """Return whether a Host header names this console; the port may be that of a tunnel."""
        if not host:
            return False
        name = host.lower()
        if not name.endswith("]"):
            before, colon, port = name.rpartition(":")
            name = before if colon and port.isdecimal() else name
        return name in self._names or (self._takes_addresses and _is_address(name))

    @staticmethod
    def is_own_origin(origin: str | None, host: str | None) -> bool:
        """Return whether an Origin is the page that this console served under `host`."""
        return origin is not None and host is not None and origin.lower() == f"http://{host.lower()}"

    def session_of(self, token: str) -> str | None:
        """Return the cookie that a token becomes; None for a wrong token."""
        # Both are compared in full, so that the time shows neither how much was right nor which one was near.
        given = token.encode()
        control = hmac.compare_digest(given, self._tokens.control.encode()) and bool(self._tokens.control)
        view = hmac.compare_digest(given, self._tokens.view.encode())
        return self._sessions.begin(may_command=control) if control or view else None

    def commands_already(self, token: str, cookie: str | None) -> bool:
        """Return whether the owner of a cookie may command and gives the token to look."""
        is_view = hmac.compare_digest(token.encode(), self._tokens.view.encode())
        return is_view and self.may_command(cookie) is True

    def renew(self, cookie: str) -> None:
        """Let a cookie in force count from now."""
        self._sessions.renew(cookie)

    def may_command(self, cookie: str | None) -> bool | None:
        """Return whether the owner of a cookie may command; None for an unknown cookie."""
        found = self._sessions.find(cookie) if cookie else None
        return None if found is None else found and bool(self._tokens.control)


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name.strip("[]"))
    except ValueError:
        return False
    return True
