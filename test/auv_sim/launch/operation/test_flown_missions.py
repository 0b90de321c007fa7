"""The log of the missions that were flown, from what guidance reports."""

from __future__ import annotations

import pytest

from auv_sim.launch.operation.flown_missions import FlownMissions


class Guidance:
    """Reports as guidance does, one a second."""

    def __init__(self) -> None:
        self.missions, self.now = FlownMissions(), 0.0

    def report(
        self, state: str, begun: str = "", share: float = 0.0, name: str = "a", reason: str = ""
    ) -> None:
        self.now += 1.0
        values = {"state": state, "reason": reason, "mission": name, "digest": f"of {name}"}
        values |= {"length [m]": "50.000", "begun at [s]": begun, "flown share": f"{share:.6f}"}
        self.missions.hear(values, 100.0 + self.now, self.now)

    @property
    def lines(self) -> list[str]:
        return [mission.line for mission in self.missions.flown]


def test_what_is_set_and_not_started_is_not_flown() -> None:
    guidance = Guidance()
    guidance.report("idle")
    guidance.report("running")  # started; no odometry yet
    guidance.report("aborted")
    assert guidance.missions.last is None
    assert guidance.missions.chosen["mission"] == "a"


def test_each_mission_has_a_line() -> None:
    guidance = Guidance()
    guidance.report("running", "101.0", 0.0)
    guidance.report("holding", "101.0", 0.4)
    guidance.report("running", "101.0", 0.4)
    guidance.report("complete", "101.0", 1.0, reason="the end of the path was reached")
    guidance.report("complete", "101.0", 1.0)
    guidance.report("complete", name="b")  # set, not begun
    guidance.report("running", "107.0", 0.1, name="b")
    guidance.report("aborted", "107.0", 0.25, name="b", reason="left the geofence")
    assert guidance.lines == [
        "a: complete, flown 100.0 % of 50.0 m in 3.0 s",
        "b: aborted (left the geofence), flown 25.0 % of 50.0 m in 1.0 s",
    ]
    last = guidance.missions.last
    assert last is not None
    assert (last.wall_time, last.digest) == (1.0, "of b")


def test_a_mission_that_takes_the_place_of_a_held_one_ends_it() -> None:
    guidance = Guidance()
    guidance.report("running", "101.0", 0.1)
    guidance.report("holding", "101.0", 0.2)
    guidance.report("holding", name="b")
    guidance.report("running", "104.0", 0.1, name="b")
    guidance.missions.interrupt("stopped by a signal")
    assert guidance.lines == [
        "a: ended (another mission took its place), flown 20.0 % of 50.0 m in 1.0 s",
        "b: interrupted (stopped by a signal), flown 10.0 % of 50.0 m in 0.0 s",
    ]


def test_a_clock_that_goes_back_to_the_same_stamp_begins_another() -> None:
    guidance = Guidance()
    for state in ("running", "complete", "running", "complete"):
        guidance.report(state, "10.0", 1.0)
    assert len(guidance.lines) == 2


@pytest.mark.parametrize(("begun", "share"), [("nan", 0.5), ("soon", 0.5), ("101.0", float("inf"))])
def test_numbers_that_mean_nothing_begin_nothing(begun: str, share: float) -> None:
    guidance = Guidance()
    guidance.report("running", begun, share)
    assert guidance.lines == []
