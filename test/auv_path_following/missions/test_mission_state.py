"""The life of a mission."""

from __future__ import annotations

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from auv_msgs_py.contract.mission_word import MissionState
from auv_path_following.missions import mission_state as m
from auv_path_following.missions.mission_state import MissionStatus, Reason, words


class Life:
    """A mission, with its state as a word and its reason as text."""

    def __init__(self, abort_after=30.0):
        self.now, self.abort_after = MissionStatus(), abort_after

    @property
    def state(self):
        return m.STATES[self.now.state]

    @property
    def reason(self):
        return words(self.now.reason)

    @property
    def running(self):
        return self.now.state == m.RUNNING

    def start(self):
        before, self.now = self.now, m.started(self.now)
        return self.now is not before

    def abort(self, cause=m.ABORT_CALLED):
        self.now = m.aborted(self.now, Reason(cause))

    def complete(self):
        self.now = m.completed(self.now)

    def navigation_lost(self, now, hold_after=1.0):
        self.now = m.navigation_lost(self.now, hold_after, now)

    def navigation_back(self):
        self.now = m.navigation_back(self.now)

    def tick(self, now):
        self.now = m.waited(self.now, self.abort_after, now)


@pytest.fixture
def mission():
    return Life()


def test_the_words_on_the_wire():
    assert [state.value for state in MissionState] == ["idle", "running", "holding", "complete", "aborted"]


def test_it_waits_runs_and_ends(mission):
    assert (mission.state, mission.running) == (MissionState.IDLE, False)
    assert mission.start()
    assert (mission.state, mission.running) == (MissionState.RUNNING, True)
    mission.complete()
    assert (mission.state, mission.running) == (MissionState.COMPLETE, False)


def test_it_can_be_flown_again_after_the_end_and_after_an_abort(mission):
    mission.start()
    mission.complete()
    assert mission.start()
    mission.abort()
    assert (mission.state, mission.reason) == (MissionState.ABORTED, "abort was called")
    assert mission.start()
    assert mission.running


@pytest.mark.parametrize("holding", [False, True])
def test_a_mission_under_way_is_not_started_twice(mission, holding):
    mission.start()
    if holding:
        mission.navigation_lost(5.0)
    before = mission.state, mission.reason
    assert not mission.start()
    assert (mission.state, mission.reason) == before


def test_it_holds_while_navigation_is_missing_and_goes_on_afterwards(mission):
    mission.start()
    mission.navigation_lost(10.0)
    assert (mission.state, mission.reason, mission.running) == (
        MissionState.HOLDING,
        "no usable navigation for 1 s",
        False,
    )
    mission.tick(39.9)
    assert mission.state is MissionState.HOLDING
    mission.navigation_back()
    assert mission.running
    # The time held before does not count the next time.
    mission.navigation_lost(50.0)
    mission.tick(79.9)
    assert mission.state is MissionState.HOLDING


def test_holding_for_too_long_aborts_and_says_why(mission):
    mission.start()
    mission.navigation_lost(10.0)
    mission.navigation_lost(30.0, 2.0)  # a repetition: the first one counts
    mission.tick(40.1)
    assert mission.state is MissionState.ABORTED
    assert mission.reason == "held for more than 30 s: no usable navigation for 1 s"
    mission.navigation_back()
    assert mission.state is MissionState.ABORTED


def test_a_clock_that_goes_back_while_holding_counts_from_there(mission):
    mission.start()
    mission.navigation_lost(1000.0)
    mission.tick(2.0)
    mission.tick(31.9)
    assert mission.state is MissionState.HOLDING
    mission.tick(32.1)
    assert mission.state is MissionState.ABORTED


@pytest.mark.parametrize("end", ["complete", "abort"])
def test_what_comes_after_the_end_changes_nothing(mission, end):
    mission.start()
    mission.complete() if end == "complete" else mission.abort()
    state = mission.state
    mission.navigation_lost(1.0)
    mission.navigation_back()
    mission.tick(1e6)
    mission.complete()
    assert mission.state is state


def test_abort_leaves_a_completed_mission_complete(mission):
    mission.start()
    mission.complete()
    mission.abort()
    assert mission.state is MissionState.COMPLETE


def test_only_a_running_mission_completes(mission):
    mission.complete()
    assert mission.state is MissionState.IDLE
    mission.start()
    mission.navigation_lost(0.0)
    mission.complete()
    assert mission.state is MissionState.HOLDING


ALLOWED = {
    MissionState.IDLE: {MissionState.RUNNING, MissionState.ABORTED},
    MissionState.RUNNING: {MissionState.HOLDING, MissionState.COMPLETE, MissionState.ABORTED},
    MissionState.HOLDING: {MissionState.RUNNING, MissionState.ABORTED},
    MissionState.COMPLETE: {MissionState.RUNNING},
    MissionState.ABORTED: {MissionState.RUNNING},
}


class AnyOrder(RuleBasedStateMachine):
    """Any order of events keeps to the allowed transitions and always has a reason."""

    def __init__(self):
        super().__init__()
        self.mission = Life(abort_after=5.0)
        self.now = 0.0
        self.last = MissionState.IDLE

    @rule(event=st.sampled_from(["start", "complete", "navigation_back"]))
    def simple(self, event):
        getattr(self.mission, event)()

    @rule()
    def abort(self):
        self.mission.abort()

    @rule()
    def lose(self):
        self.mission.navigation_lost(self.now)

    @rule(seconds=st.floats(0.0, 20.0))
    def wait(self, seconds):
        self.now += seconds
        self.mission.tick(self.now)

    @invariant()
    def keeps_to_the_rules(self):
        state = self.mission.state
        assert state is self.last or state in ALLOWED[self.last]
        assert self.mission.running == (state is MissionState.RUNNING)
        assert self.mission.reason
        self.last = state


TestAnyOrder = AnyOrder.TestCase
TestAnyOrder.settings = settings(max_examples=30, stateful_step_count=20)


def test_the_first_reason_of_an_abort_stays(mission):
    mission.start()
    mission.abort(m.GEOFENCE)
    mission.abort()
    assert mission.reason.startswith("limit geofence: left at north")


def test_every_cause_has_its_words():
    causes = range(m.WAITS, m.PATH_SPEED + 1)
    texts = [words(Reason(cause, 1.0, 2.0, 3.0), "odom is late") for cause in causes]
    assert len(set(texts)) == len(texts) and all(texts)
    assert sum("odom is late" in text for text in texts) == 2  # where navigation was lost
