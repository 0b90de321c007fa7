"""A fleet that waits for its operators, with monitors that hear what the test says."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from auv_sim.launch.fleet.fleet_stand_by import FleetStandBy
from auv_sim.launch.operation.flown_missions import FlownMissions
from auv_sim.launch.outcome import MissionFailed


class Heard:
    """A vehicle's monitor: it hears of a mission when it is looked at, and can be aborted."""

    def __init__(self, digest: str, *states: str) -> None:
        self.missions, self.s, self.to_go, self.state = FlownMissions(), 0.5, 40.0, "idle"
        self.is_aborted = False
        self._digest, self._states = digest, list(states)

    def look(self, _: float) -> None:
        if self._states:
            self.state = self._states.pop(0)
            self.missions.hear(
                {
                    "state": self.state, "mission": f"mission {self._digest}", "digest": self._digest,
                    "length [m]": "100", "begun at [s]": "1.0", "flown share": "0.5", "reason": "why",
                },
                5.0,
                0.0,
            )  # fmt: skip

    def abort(self) -> str:
        self.is_aborted = True
        return ""


def test_each_vehicle_has_the_outcome_of_its_last_mission() -> None:
    monitors = {
        "one": Heard("a", "running", "complete"),
        "two": Heard("b", "running"),
        "three": Heard("other", "running", "aborted"),
        "four": Heard("d"),
    }
    interrupt = SimpleNamespace(requested=False)
    said: list[str] = []
    shown: dict[str, str] = {}
    others: dict[str, Any] = {}
    progress: Any = SimpleNamespace(
        say=said.append,
        update=lambda label, s, time, wall, state: shown.update({label: state}),
        update_other=lambda label, *other: others.update({label: other}),
    )
    members = {
        label: SimpleNamespace(mission=SimpleNamespace(digest=digest))
        for label, digest in zip(monitors, "abcd", strict=True)
    }
    looks = iter(range(3))

    def look(_: float) -> None:
        for monitor in monitors.values():
            monitor.look(0.0)
        interrupt.requested = next(looks) == 2

    plan: Any = SimpleNamespace(members=members, lockstep=True)
    outcomes = FleetStandBy(plan, monitors, progress, interrupt, look).run()  # type: ignore[arg-type]
    assert {label: outcome.state for label, outcome in outcomes.items()} == {
        "one": "complete", "two": "interrupted", "three": "aborted", "four": "idle",
    }  # fmt: skip
    assert outcomes["three"].other == "mission other"
    assert all(monitor.is_aborted for monitor in monitors.values())
    assert shown == {"one": "complete", "two": "running", "four": "idle"}
    assert others == {"three": ("mission other", 100.0, 40.0, 4.0, "aborted")}
    assert "one: mission a: complete, flown 50.0 % of 100.0 m in 4.0 s" in said
    assert any("one clock" in line for line in said)


def test_flown_missions_are_reported_when_a_process_has_ended() -> None:
    said: list[str] = []
    monitor = Heard("a", "running", "complete")
    progress: Any = SimpleNamespace(say=said.append, update=lambda *_: None)
    looks = iter(range(3))

    def look(_: float) -> None:
        monitor.look(0.0)
        if next(looks) == 2:
            raise MissionFailed("a node has ended")

    members = {"one": SimpleNamespace(mission=SimpleNamespace(digest="a"))}
    plan: Any = SimpleNamespace(members=members, lockstep=False)
    interrupt: Any = SimpleNamespace(requested=False)
    with pytest.raises(MissionFailed):
        FleetStandBy(plan, {"one": monitor}, progress, interrupt, look).run()
    assert said[-1] == "one: mission a: complete, flown 50.0 % of 100.0 m in 4.0 s"
