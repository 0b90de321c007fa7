"""Calls that run out of time, or for which nothing waits any more; the clock is the test's."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from types import SimpleNamespace
from typing import Any

import pytest

from auv_msgs_py.contract import topics
from auv_sim.nodes.console import operator_deeds, vehicle_calls
from auv_sim.nodes.console.operator_deeds import OperatorDeeds
from auv_sim.nodes.console.vehicle_calls import PATIENCE, CallFailed, ServiceCaller
from auv_sim.views.console.record.health_board import OK
from auv_sim.views.console.record.readiness import CHAIN, NAVIGATION, PlanLines
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.web.operator_desk import Answer


class Services:
    """A node whose services are matched at a given time; they answer, or never do."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, ready_at: float, answers: bool = True) -> None:
        self.now, self.ready_at, self.answers = 100.0, 100.0 + ready_at, answers
        self.sent: list[str] = []
        executor = SimpleNamespace(add_node=lambda _: None, spin_once=lambda **_: None)
        monkeypatch.setattr(vehicle_calls, "SingleThreadedExecutor", lambda: executor)
        sleep = asyncio.sleep

        async def pass_time(seconds: float) -> None:
            self.now += seconds
            await sleep(0)

        monkeypatch.setattr(asyncio, "sleep", pass_time)
        clock = SimpleNamespace(monotonic=lambda: 0.0, time=lambda: 0.0)
        monkeypatch.setattr(operator_deeds, "time", clock)

    def run(self, work: Coroutine[Any, Any, Any]) -> Any:
        async def on_own_clock() -> Any:
            asyncio.get_running_loop().time = lambda: self.now  # type: ignore[method-assign]
            return await work

        return asyncio.run(on_own_clock())

    def create_client(self, _: Any, name: str) -> Any:
        def call(_: Any) -> Any:
            self.sent.append(name)
            response = SimpleNamespace(success=True, message="")
            return SimpleNamespace(done=lambda: self.answers, result=lambda: response)

        return SimpleNamespace(
            service_is_ready=lambda: self.now >= self.ready_at, call_async=call,
            remove_pending_request=lambda _: None,
        )  # fmt: skip

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        return [(f"/auv/{name}", []) for name in (topics.START_SERVICE, topics.ABORT_SERVICE)]

    def get_logger(self) -> Any:
        return SimpleNamespace(info=lambda _: None)

    def get_name(self) -> str:
        return topics.CONSOLE


def ready_vehicle() -> VehicleRecord:
    record = VehicleRecord(0, "/auv")
    record.progress.state = "idle"
    record.set_course({}, PlanLines(True, ()))
    for name in (*CHAIN, NAVIGATION):
        record.health.hear(name, OK, "", 0.0)
    return record


def test_match_and_answer_have_one_deadline(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = Services(monkeypatch, ready_at=0.9 * PATIENCE, answers=False)
    caller = ServiceCaller(graph)  # type: ignore[arg-type]
    with pytest.raises(CallFailed, match="did not answer within 4 s"):
        graph.run(caller.trigger("/auv", topics.START_SERVICE))
    assert graph.now - 100.0 == pytest.approx(PATIENCE, abs=0.1)
    assert PATIENCE < 5.0, "the page waits for 5 s"


@pytest.mark.parametrize("leaves", [False, True])
def test_a_start_that_was_not_sent_is_none_after_an_abort_or_without_its_browser(
    leaves: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    graph, here = Services(monkeypatch, ready_at=2.0), {1, 2}
    caller = ServiceCaller(graph)  # type: ignore[arg-type]
    deeds = OperatorDeeds(graph, caller, None, here.__contains__)  # type: ignore[arg-type]
    record = ready_vehicle()

    async def both() -> None:
        start = asyncio.create_task(deeds.commands["start"](record, 1, {}))  # type: ignore[arg-type]
        while graph.now < 100.5:
            await asyncio.sleep(0.01)
        if leaves:
            here.discard(1)
        else:
            assert (await deeds.commands["abort"](record, 2, {})).ok
        with pytest.raises(CallFailed, match="was not called"):
            await start

    graph.run(both())
    assert graph.sent == ([] if leaves else ["/auv/abort"])


def test_an_abort_is_sent_though_its_browser_has_left(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = Services(monkeypatch, ready_at=0.5)
    deeds = OperatorDeeds(graph, ServiceCaller(graph), None, lambda _: False)  # type: ignore[arg-type]
    answer = graph.run(deeds.commands["abort"](ready_vehicle(), 1, {}))  # type: ignore[arg-type]
    assert (answer.ok, graph.sent) == (True, ["/auv/abort"])


def test_a_start_that_the_preflight_forbids_is_not_sent(monkeypatch: pytest.MonkeyPatch) -> None:
    graph, record = Services(monkeypatch, ready_at=0.0), ready_vehicle()
    deeds = OperatorDeeds(graph, ServiceCaller(graph), None, lambda _: True)  # type: ignore[arg-type]
    record.set_course({}, PlanLines(False, ("turn too tight",)))
    answer = graph.run(deeds.commands["start"](record, 1, {}))  # type: ignore[arg-type]
    assert (answer.ok, answer.message, graph.sent) == (False, "plan: turn too tight", [])


def test_plans_are_checked_one_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = Services(monkeypatch, ready_at=0.0)
    deeds = OperatorDeeds(graph, ServiceCaller(graph), None, lambda _: True)  # type: ignore[arg-type]
    may_end = asyncio.Event()

    async def check(text: str, hull: str) -> dict[str, Any]:
        await may_end.wait()
        return {"ok": True, "lines": [f"{text} of {hull}"]}

    async def value(*_: str) -> list[str]:
        return ["remus100"]

    monkeypatch.setattr(operator_deeds.plan_apart, "checked_text", check)
    monkeypatch.setattr(deeds.desk("/auv"), "value", value)
    assert "check" not in deeds.looks, "a page that may only look starts no process"

    async def both() -> list[Answer]:
        ask = deeds.commands["check"]
        first = asyncio.create_task(ask(ready_vehicle(), 1, {"text": "a"}))  # type: ignore[arg-type]
        await asyncio.sleep(0.0)
        second = await ask(ready_vehicle(), 2, {"text": "b"})
        may_end.set()
        return [await first, second, await ask(ready_vehicle(), 2, {"text": "c"})]

    answers = graph.run(both())
    assert [answer.message for answer in answers] == ["a of remus100", "a check is running", "c of remus100"]
