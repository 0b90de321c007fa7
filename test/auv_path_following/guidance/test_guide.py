"""Guidance of a mission as a step: holds, rejoining, limits and the end, in their order."""

from __future__ import annotations

import math
from typing import NamedTuple

import pytest

from auv_msgs_py.values.types import NO_CURRENT, Navigation, WaterVelocity
from auv_path_following import vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance import guide as guidance
from auv_path_following.guidance.approach import agility_of, empty_approach
from auv_path_following.guidance.follow import GuidanceOutput
from auv_path_following.guidance.guide import guide, start
from auv_path_following.guidance.measured import Measured
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.missions import limits as bounds
from auv_path_following.missions import mission_state as m
from auv_path_following.missions.limits import LimitsConfig

REMUS = vehicle.load("remus100")
NORTH = CompositePath([Line(0.0, 0.0, 100.0, 0.0)])
THRUST, DT = 6.0, 0.1


class Answer(NamedTuple):
    guidance: GuidanceOutput
    thrust: float
    has_resumed: bool


class Flight:
    """A mission northwards, flown at 2 m/s."""

    def __init__(self, limits=None, hold_after=1.0):
        config = LimitsConfig(**limits) if limits else LimitsConfig()
        agility = agility_of(REMUS, THRUST)
        self.config = guidance.prepare(
            PathFollowerConfig(), agility, THRUST, hold_after, bounds.prepare(config)
        )
        self.state = guidance.first_state(self.config, empty_approach())
        self.now = 0.0

    def step(self, north, east=0.0, dt=DT, has_water=True, moved=False):
        self.now += dt
        navigation = Navigation(north, east, 0.0, 0.0)
        inputs = Measured(navigation, WaterVelocity(2.0, 0.0), has_water, moved, 100.0 - north, self.now)
        self.state, *output = guide(self.config, NORTH.rows, self.state, inputs, NO_CURRENT, dt)
        return Answer(*output)

    def start(self, metres=5.0):
        self.state = start(self.config, self.state)
        for k in range(round(metres / 0.2) + 1):
            output = self.step(0.2 * k)
        return output

    @property
    def mission(self):
        return self.state.mission.state


def test_before_the_start_there_is_no_thrust_and_the_own_heading_is_desired():
    flight = Flight()
    output = flight.step(3.0, 4.0)
    assert (flight.mission, output.thrust, output.guidance.psi_d) == (m.IDLE, 0.0, 0.0)
    assert output.guidance.ye == 4.0


def test_it_runs_to_the_end_and_stops():
    flight = Flight()
    assert flight.start().thrust == THRUST
    output = flight.start(100.0)
    for k in range(20):
        output = flight.step(100.0 + 0.2 * k)
    assert flight.mission == m.COMPLETE
    assert output.thrust == 0.0 and output.guidance.s == 1.0


def test_a_start_begins_the_path_anew_and_one_under_way_is_refused():
    flight = Flight()
    flight.start()
    before = flight.state
    assert start(flight.config, before) is before
    flight.state = before._replace(mission=m.aborted(before.mission, m.Reason(m.ABORT_CALLED)))
    assert start(flight.config, flight.state).follower.progress.point.t == 0.0


@pytest.mark.parametrize("noticed", ["by stamps", "in time"])
def test_after_a_gap_it_rejoins_ahead_beside_the_vehicle(noticed):
    flight = Flight()
    flight.start()
    if noticed == "in time":
        flight.state = flight.state._replace(mission=m.navigation_lost(flight.state.mission, 1.0, flight.now))
    output = flight.step(12.0, 1.0, dt=16.0)  # at its last speed P would be at 37 m
    assert output.has_resumed and flight.mission == m.RUNNING and output.thrust == THRUST
    assert output.guidance.s == pytest.approx(0.12, abs=1e-4)


def test_in_lockstep_a_gap_is_no_hold():
    flight = Flight(hold_after=math.inf)
    flight.start()
    assert not flight.step(5.2, dt=16.0).has_resumed


def test_without_velocity_through_water_it_keeps_its_place_and_holds_in_the_end():
    flight = Flight()
    flight.start()
    before = flight.state.follower.progress.point
    for k in range(12):
        output = flight.step(5.0 + 0.2 * k, has_water=False)
    assert flight.mission == m.HOLDING and output.thrust == 0.0
    assert (flight.state.follower.progress.point.i, flight.state.follower.progress.point.t) == (
        before.i,
        before.t,
    )
    assert flight.step(7.6).has_resumed


def test_a_new_place_without_velocity_through_water_is_rejoined_later():
    flight = Flight(hold_after=20.0)
    flight.start()
    flight.step(30.0, has_water=False, moved=True)
    assert flight.state.rejoins
    assert flight.step(30.2).guidance.s == pytest.approx(0.3, abs=0.01)
    assert not flight.state.rejoins


@pytest.mark.parametrize(
    ("limits", "cause", "at"),
    [({"duration": 3.0}, m.DURATION, (5.0, 0.0)), ({"path_distance": 5.0}, m.PATH_DISTANCE, (5.2, 20.0))],
)
def test_a_broken_limit_aborts_and_keeps_its_reason(limits, cause, at):
    flight = Flight(limits)
    flight.start()
    for _ in range(15):
        output = flight.step(*at)
    assert flight.mission == m.ABORTED and flight.state.mission.reason.cause == cause
    assert output.thrust == 0.0


def test_time_that_is_held_counts_for_the_duration():
    flight = Flight({"duration": 10.0})
    flight.start()
    for _ in range(30):
        flight.step(5.0, has_water=False, dt=0.5)
    assert flight.state.mission.reason.cause == m.DURATION


def test_the_way_of_the_last_mission_does_not_arm_the_speed_along_the_path():
    """Aborted in an approach and started anew beside the start: P has not advanced since."""
    flight = Flight({"path_speed": 1.0, "path_speed_window": 10.0})
    flight.state = start(flight.config, flight.state)
    flight.step(-500.0)
    flight.state = flight.state._replace(mission=m.aborted(flight.state.mission, m.Reason(m.ABORT_CALLED)))
    flight.state = start(flight.config, flight.state)
    flight.step(-500.0)  # as of the last mission's last step, the way to go was 600 m
    for _ in range(300):
        flight.step(0.0)
    assert flight.mission == m.RUNNING


def test_a_vehicle_away_from_the_start_is_led_there_first():
    flight = Flight()
    flight.state = start(flight.config, flight.state)
    output = flight.step(-50.0, 0.0)
    assert output.guidance.approach == pytest.approx(50.0) and output.guidance.s == 0.0
    # A new beginning of time plans the approach anew.
    flight.state = guidance.at_the_beginning(flight.config, flight.state.mission, empty_approach())
    assert flight.step(-20.0, 0.0).guidance.approach == pytest.approx(20.0)
