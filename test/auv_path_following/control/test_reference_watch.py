"""Whether what guidance asked for may still be obeyed."""

from __future__ import annotations

import pytest

from auv_msgs_py.values.types import Reference
from auv_path_following.control.reference_watch import ReferenceWatch

DRIVE, REST = Reference(0.1, 0.0, 6.0), Reference(0.1, 0.0, 0.0)


def test_before_guidance_spoke_there_is_nothing_to_obey():
    assert ReferenceWatch().allowed(5.0, "running", 0.5) is None


def test_a_reference_holds_for_its_time_and_no_longer():
    watch = ReferenceWatch()
    watch.put(DRIVE, 10.0)
    assert [watch.allowed(t, "running", 0.5) for t in (10.0, 10.5, 10.6)] == [DRIVE, DRIVE, None]
    assert watch.silent
    watch.put(DRIVE, 11.0)
    assert watch.allowed(11.0, "running", 0.5) == DRIVE
    assert not watch.silent


def test_a_reference_from_the_future_is_silence():
    watch = ReferenceWatch()
    watch.put(DRIVE, 100.0)
    assert watch.allowed(5.0, "running", 0.5) is None


@pytest.mark.parametrize("state", ["idle", "holding", "complete", "aborted"])
def test_thrust_without_a_running_mission_is_borne_for_a_moment(state):
    watch, obeyed = ReferenceWatch(), []
    for k in range(10):
        watch.put(DRIVE, 0.1 * k)
        obeyed.append(watch.allowed(0.1 * k, state, 0.45) is not None)
    assert obeyed == [True] * 5 + [False] * 5
    assert watch.contradiction == f"is 6 though the mission is {state}"
    watch.put(DRIVE, 1.0)
    assert watch.allowed(1.0, "running", 0.45) == DRIVE
    assert watch.contradiction == ""


def test_rest_is_always_allowed():
    watch = ReferenceWatch()
    for k in range(20):
        watch.put(REST, 0.1 * k)
        assert watch.allowed(0.1 * k, "aborted", 0.45) == REST


def test_a_foreign_guidance_without_a_state_is_obeyed():
    watch = ReferenceWatch()
    for k in range(20):
        watch.put(DRIVE, 0.1 * k)
        assert watch.allowed(0.1 * k, "", 0.45) == DRIVE
