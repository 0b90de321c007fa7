"""The console as a child of the launcher; the mission does not depend on it."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable

from auv_msgs_py.contract.topics import CONSOLE
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.launch.processes.process_group import Child, Children
from auv_sim.views.console.listening import INSTALL

_MODULE = "auv_sim.cli.console"
#: Words with which the console prints its addresses.
_ADDRESSES = ("console: ", "to look only: ", "warning ")
#: Longest wall time until it prints them, s, in looks of `_LOOK` s.
_PATIENCE, _LOOK = 60.0, 0.1


def require_library() -> None:
    """Refuse a console without its library, before anything has started.

    Raises:
        ConfigurationError: aiohttp is not installed.
    """
    if importlib.util.find_spec("aiohttp") is None:
        raise ConfigurationError("aiohttp", "not installed", INSTALL)


def start(children: Children, domain: int) -> None:
    """Start the console of a domain; call it before this process has DDS threads, as it forks."""
    children.start(CONSOLE, _MODULE, ["--domain", str(domain)], is_log_secret=True)  # it has the token


def addresses(children: Children, look: Callable[[float], None]) -> str:
    """Return the lines with the console's addresses, or the line with which it ended.

    Args:
        children: of the mission.
        look: waits for some seconds.
    """
    child = _child(children)
    for _ in range(round(_PATIENCE / _LOOK)) if child is not None else ():
        lines = [line for line in child.last_lines(20) if line.startswith(_ADDRESSES)]  # type: ignore[union-attr]
        if any(line.startswith(_ADDRESSES[1]) for line in lines):
            return "\n".join(lines)
        if child is not None and child.exit_code is not None:
            return f"no console: {' '.join(child.last_lines(1))}"
        look(_LOOK)
    return "no console yet: its addresses will stand in log/console.log"


def _child(children: Children) -> Child | None:
    return next((child for child in children if child.name == CONSOLE), None)
