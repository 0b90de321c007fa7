"""The cookies of open pages: they outlive a restart of the console, so that a page finds it again."""

from __future__ import annotations

import hashlib
import json
import os
import secrets
from collections.abc import Callable
from pathlib import Path

#: A cookie counts for this long after the page was last opened or connected, s.
LIFETIME = 12 * 3600.0
#: Most cookies in force; the oldest one gives way.
_MOST = 200


class PageSessions:
    """Cookies by their SHA-256, so that no reader of the file can use them.

    Args:
        file: where they are kept, readable by its owner alone; None keeps them in memory.
        clock: returns the machine's time, s.
    """

    def __init__(self, file: Path | None, clock: Callable[[], float]) -> None:
        self._file, self._clock = file, clock
        self._known = _read(file) if file is not None else {}

    def begin(self, may_command: bool) -> str:
        """Return a new cookie."""
        cookie = secrets.token_urlsafe(32)
        now = self._clock()
        in_force = [(key, value) for key, value in self._known.items() if value[1] > now]
        self._known = dict(in_force[1 - _MOST :])
        self._known[_digest(cookie)] = may_command, now + LIFETIME
        self._write()
        return cookie

    def find(self, cookie: str) -> bool | None:
        """Return whether a cookie may command; None if it is not in force."""
        may_command, until = self._known.get(_digest(cookie), (False, 0.0))
        return may_command if until > self._clock() else None

    def renew(self, cookie: str) -> None:
        """Let a cookie in force count for `LIFETIME` from now."""
        may_command = self.find(cookie)
        if may_command is not None:
            key = _digest(cookie)
            del self._known[key]  # the newest ones stand last
            self._known[key] = may_command, self._clock() + LIFETIME
            self._write()

    def _write(self) -> None:
        if self._file is None:
            return
        try:
            descriptor = os.open(self._file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
            with os.fdopen(descriptor, "w", encoding="utf-8") as stream:
                json.dump(self._known, stream)
        except OSError:
            self._file = None  # they are in force until the console ends


def _digest(cookie: str) -> str:
    return hashlib.sha256(cookie.encode("utf-8", "replace")).hexdigest()


def _read(file: Path) -> dict[str, tuple[bool, float]]:
    try:
        content = json.loads(file.read_text(encoding="utf-8"))
        return {str(key): (bool(may), float(until)) for key, (may, until) in content.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}
