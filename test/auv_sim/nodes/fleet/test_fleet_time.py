"""The time of /clock for several vehicles, without ROS."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.contract import topics
from auv_sim.nodes.fleet.fleet_time import FleetTime

FIRST = topics.FIRST_STAMP_NS
VEHICLES = ("/auv1", "/auv2")


def under_way() -> FleetTime:
    time = FleetTime(VEHICLES)
    for name in VEHICLES:
        time.enter(name, "running")
    return time


def test_time_stands_where_the_last_vehicle_is() -> None:
    time = under_way()
    time.reach("/auv1", FIRST + 900)
    assert not time.advance()
    time.reach("/auv2", FIRST + 400)
    assert time.advance()
    assert time.now == FIRST + 400
    assert not time.advance()


def test_one_that_has_not_begun_holds_the_others() -> None:
    time = FleetTime(VEHICLES)
    time.enter("/auv1", "running")
    time.enter("/auv2", "idle")
    time.reach("/auv1", FIRST + 900)
    assert not time.advance()
    assert not time.has_begun
    time.enter("/auv2", "running")
    assert time.has_begun


def test_one_that_has_ended_or_holds_is_not_waited_for() -> None:
    for state in ("complete", "aborted", "holding"):
        time = under_way()
        time.reach("/auv1", FIRST + 900)
        time.enter("/auv2", state)
        assert time.advance()
        assert time.now == FIRST + 900
        # It begins again at its own time: /clock does not go back, and waits for it.
        time.enter("/auv2", "running")
        time.reach("/auv2", FIRST + 100)
        time.reach("/auv1", FIRST + 1900)
        assert not time.advance()
        assert time.now == FIRST + 900


@given(st.lists(st.tuples(st.sampled_from(VEHICLES), st.integers(0, 10**9)), max_size=30))
def test_time_never_goes_back_and_never_passes_the_last_vehicle(reports: list[tuple[str, int]]) -> None:
    time, before = under_way(), FIRST
    latest = dict.fromkeys(VEHICLES, FIRST)
    for name, ahead in reports:
        latest[name] = max(latest[name], FIRST + ahead)
        time.reach(name, latest[name])
        time.advance()
        assert before <= time.now <= min(latest.values())
        before = time.now
