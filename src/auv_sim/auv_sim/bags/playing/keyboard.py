"""Single keys from a terminal, without waiting."""

from __future__ import annotations

import select
import sys
import termios
import tty
from types import TracebackType


class Keyboard:
    """Delivers single keys within `with`; none without a terminal."""

    def __enter__(self) -> Keyboard:
        self._before = None
        if sys.stdin.isatty():
            self._before = termios.tcgetattr(sys.stdin)
            tty.setcbreak(sys.stdin)
        return self

    @property
    def there(self) -> bool:
        """Whether there is a terminal."""
        return self._before is not None

    def pressed(self) -> str:
        """Return the key pressed since the last call; empty for none."""
        if self._before is None or not select.select([sys.stdin], [], [], 0.0)[0]:
            return ""
        return sys.stdin.read(1)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._before is not None:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._before)
