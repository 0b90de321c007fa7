"""The requests of browsers: each gets an answer with its number, also one that is not understood."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Mapping
from typing import Any, NamedTuple

from auv_msgs_py.values.errors import SuiteError, printable, shortened
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.record.wire_messages import text_of
from auv_sim.views.console.web.viewer import MOST_PENDING, Viewer

#: Longest request, bytes: a mission's text and more.
LONGEST = 512_000
_VIEW_ONLY = "view only: commands need the control address"


class Answer(NamedTuple):
    """The answer to a request.

    Attributes:
        ok: whether it was done.
        message: one line, or several of a check.
        more: further fields.
    """

    ok: bool
    message: str = ""
    more: Mapping[str, Any] = {}


#: Takes vehicle, viewer and request; returns the answer. Raises `SuiteError` for input that cannot be used.
Deed = Callable[[VehicleRecord, int, Mapping[str, Any]], Awaitable[Answer]]


class OperatorDesk:
    """Takes the requests of all browsers.

    Args:
        vehicles: all of them; grows as they are discovered.
        looks: requests that change nothing, by name.
        commands: requests that reach the vehicle, by name.
    """

    def __init__(
        self, vehicles: list[VehicleRecord], looks: Mapping[str, Deed], commands: Mapping[str, Deed]
    ) -> None:
        self._vehicles, self._looks, self._commands = vehicles, looks, commands

    async def answer(self, text: str, viewer: Viewer) -> str:
        """Return the answer to a message of a browser."""
        number: Any = None
        try:
            request = _parsed(text)
            number = request.get("id")
            answer = await self._done(request, viewer)
        except SuiteError as error:
            answer = Answer(False, str(error))
        except Exception as error:  # a fault of the console: the page has its answer all the same
            answer = Answer(False, printable(f"the console failed: {type(error).__name__}: {error}"))
        return text_of("answer", **{**answer.more, "id": number, "ok": answer.ok, "message": answer.message})

    async def _done(self, request: Mapping[str, Any], viewer: Viewer) -> Answer:
        name, index = request.get("do"), request.get("vehicle", 0)
        deed = self._looks.get(name) if isinstance(name, str) else None
        is_command = deed is None
        if deed is None:
            deed = self._commands.get(name) if isinstance(name, str) else None
            if deed is None:
                return Answer(False, f"unknown request {name!r}"[:200])
            if not viewer.may_command:
                return Answer(False, _VIEW_ONLY)
        if type(index) is not int or not 0 <= index < len(self._vehicles):
            return Answer(False, f"no vehicle {index!r}"[:200])
        needs_namespace = is_command and not (name == "abort" and len(self._vehicles) == 1)
        self._require_namespace(index, request.get("namespace"), needs_namespace)
        if viewer.pending >= MOST_PENDING and name != "abort":
            return Answer(False, f"{viewer.pending} requests are not answered yet: try again")
        viewer.pending += 1
        try:
            return await deed(self._vehicles[index], viewer.number, request)
        finally:
            viewer.pending -= 1

    def _require_namespace(self, index: int, namespace: Any, is_needed: bool) -> None:
        """Refuse a request for another vehicle: a restarted console may number the vehicles anew."""
        if namespace is None and not is_needed:
            return
        own = self._vehicles[index].namespace
        if namespace != own:
            raise RequestRefused(f"vehicle {index}: found namespace {namespace!r}, expected {own!r}"[:300])


class RequestRefused(SuiteError):
    """A request that cannot be used."""


def _parsed(text: str) -> dict[str, Any]:
    try:
        request = json.loads(text)
    except (ValueError, RecursionError):
        raise RequestRefused("found no JSON, expected a JSON object") from None
    if not isinstance(request, dict):
        raise RequestRefused(f"found {shortened(text, 80)}, expected a JSON object")
    return request


def text_in(request: Mapping[str, Any], name: str) -> str:
    """Return a text of a request.

    Raises:
        RequestRefused: there is none.
    """
    value = request.get(name)
    if not isinstance(value, str):
        raise RequestRefused(f"{name}: found {value!r}, expected a text"[:300])
    return value


def number_in(request: Mapping[str, Any], name: str) -> float:
    """Return a finite number of a request.

    Raises:
        RequestRefused: there is none.
    """
    value = request.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e300:
        raise RequestRefused(f"{name}: found {value!r}, expected a number"[:300])
    return float(value)
