"""Times of a vehicle whose clock, delays and drift are known here and not to the code under test."""

from __future__ import annotations

import itertools
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.nodes.mavlink.vehicle_time import ComponentTime, FollowedClock, OffsetEstimate

MS, SECOND = 1_000_000, 1_000_000_000
#: ROS time at the vehicle's boot.
BOOT_AT = 1_700_000_000 * SECOND


class Vehicle:
    """Sends a time every 20 ms; its messages take `least` to `most` ms, and its clock drifts."""

    def __init__(self, least: float, most: float, drift: float = 0.0) -> None:
        self.estimate = OffsetEstimate()
        self.boot = 5 * SECOND
        dice = random.Random(3)
        self._delay = lambda: dice.uniform(least, most) * MS
        self._drift = drift

    def ros(self, boot: int) -> int:
        return BOOT_AT + round(boot * (1.0 + self._drift))

    def live(self, seconds: float, timesync: bool) -> list[int]:
        """The errors of the stamps, ns."""
        errors = []
        for k in range(round(seconds * 50)):
            self.boot += 20 * MS
            arrived = self.ros(self.boot) + round(self._delay())
            self.estimate.heard(self.boot, arrived)
            errors.append(self.estimate.stamp(self.boot) - self.ros(self.boot))
            if timesync and k % 25 == 0:
                up, down = round(self._delay()), round(self._delay())
                self.estimate.exchanged(self.ros(self.boot) - up, self.boot, self.ros(self.boot) + down)
        return errors


def test_without_timesync_the_error_is_the_shortest_delay() -> None:
    errors = Vehicle(20.0, 60.0).live(20.0, timesync=False)
    assert 20.0 * MS <= errors[-1] < 23.0 * MS


def test_with_timesync_the_delay_is_taken_out() -> None:
    errors = Vehicle(20.0, 60.0).live(60.0, timesync=True)
    assert abs(errors[-1]) < 8.0 * MS  # the two ways of the best exchange differ by at most a little


def test_a_drifting_clock_is_followed() -> None:
    errors = Vehicle(20.0, 25.0, drift=100e-6).live(200.0, timesync=False)
    assert max(errors[500:]) < 30.0 * MS  # 200 s of drift are 20 ms


def test_the_correction_never_bends_dt_by_more_than_its_share() -> None:
    vehicle = Vehicle(20.0, 200.0)
    stamps = []
    for _ in range(500):
        vehicle.live(0.02, timesync=True)
        stamps.append(vehicle.estimate.stamp(vehicle.boot))
    # The first second settles; the estimate goes on getting better, and dt stays true all the same.
    steps = [later - earlier for earlier, later in itertools.pairwise(stamps)]
    assert all(abs(step - 20 * MS) <= 0.05 * 20 * MS + 1 for step in steps[55:])


def test_a_restart_is_noticed_and_ros_time_goes_on() -> None:
    vehicle = Vehicle(10.0, 30.0)
    vehicle.live(10.0, timesync=True)
    before = vehicle.estimate.stamp(vehicle.boot)
    later = vehicle.ros(vehicle.boot) + 5 * SECOND
    assert vehicle.estimate.heard(100 * MS, later)
    assert before < vehicle.estimate.stamp(100 * MS) <= later
    assert vehicle.estimate.restarts == 1


def test_an_overtaken_message_is_no_restart() -> None:
    vehicle = Vehicle(10.0, 30.0)
    vehicle.live(5.0, timesync=False)
    assert not vehicle.estimate.heard(vehicle.boot - 60 * MS, vehicle.ros(vehicle.boot) + 20 * MS)


def test_a_timesync_by_another_clock_is_not_used() -> None:
    vehicle = Vehicle(20.0, 20.0)
    vehicle.live(1.0, timesync=False)
    now = vehicle.ros(vehicle.boot)
    vehicle.estimate.exchanged(now - 5 * MS, now, now + 5 * MS)  # it answers with the time of day
    assert vehicle.estimate.round_trip is None


def test_a_jump_of_the_ros_clock_is_taken_at_once() -> None:
    vehicle = Vehicle(20.0, 20.0)
    vehicle.live(5.0, timesync=True)
    boot = vehicle.boot + 20 * MS
    now = vehicle.ros(boot) - 10 * SECOND  # somebody set the clock
    vehicle.estimate.heard(boot, now)
    assert vehicle.estimate.stamp(boot) == now
    assert vehicle.estimate.steps == 1


@given(st.lists(st.tuples(st.integers(-60, 200), st.integers(0, 50)), min_size=1, max_size=60))
def test_the_followed_clock_never_goes_back_and_never_lags_behind_a_message(
    events: list[tuple[int, int]],
) -> None:
    clock = FollowedClock(SECOND, 10.0)
    boot, wall, newest = 1000 * SECOND, 0, 0
    for moved, passed in events:
        boot, wall, before = boot + moved * MS, wall + passed * MS, clock.now
        clock.heard(boot, wall)
        newest = max(newest, boot)
        assert clock.now >= before
        assert clock.now == clock.stamp(newest)


def test_the_followed_clock_goes_on_in_silence_and_not_before() -> None:
    clock = FollowedClock(SECOND, speed=10.0, patience=2 * SECOND)
    clock.heard(7 * SECOND, 0)
    assert not clock.pass_silence(1_900 * MS)
    assert clock.now == SECOND
    for wall in range(2_000, 3_000, 5):
        clock.pass_silence(wall * MS)
    assert clock.now == pytest.approx(SECOND + 10 * SECOND, rel=0.01)


def test_a_machine_that_was_held_up_makes_no_jump() -> None:
    clock = FollowedClock(SECOND, speed=10.0, patience=2 * SECOND)
    clock.heard(7 * SECOND, 0)
    clock.pass_silence(60 * SECOND)
    assert clock.now <= SECOND + 100 * MS


def test_a_vehicle_that_stood_still_is_followed_again() -> None:
    clock = FollowedClock(SECOND, speed=10.0, patience=2 * SECOND)
    clock.heard(7 * SECOND, 0)
    for wall in range(0, 10_000, 5):
        clock.pass_silence(wall * MS)
    now = clock.now
    assert not clock.heard(7 * SECOND + 20 * MS, 10_000 * MS)  # it had been stopped: no restart
    assert clock.now == now == clock.stamp(7 * SECOND + 20 * MS)
    assert clock.heard(100 * MS, 10_001 * MS)
    assert clock.stamp(100 * MS) == clock.now == now


def log_and_autopilot(ahead: int, delay: int = 60 * MS) -> tuple[ComponentTime, int]:
    """A log whose clock is `ahead` of the autopilot's; its time, and the error of its last stamp (ns)."""
    autopilot = OffsetEstimate()
    log = ComponentTime(autopilot)
    now = boot = 0
    for boot in range(0, 5 * SECOND, 50 * MS):
        autopilot.heard(boot, boot + BOOT_AT + 20 * MS)
        autopilot.exchanged(boot + BOOT_AT, boot + 20 * MS, boot + BOOT_AT + 40 * MS)
        now = boot + BOOT_AT + delay
        log.heard(boot + ahead, now)
    assert log.settled
    return log, log.stamp(boot + ahead) - (boot + BOOT_AT)


def test_a_log_on_the_autopilots_clock_is_stamped_as_well_as_the_autopilot() -> None:
    assert abs(log_and_autopilot(0)[1]) <= 1 * MS


@pytest.mark.parametrize("ahead", [-3 * SECOND, 3 * SECOND, -200 * MS, 1_790_000_000 * SECOND])
def test_a_log_with_a_clock_of_its_own_is_late_by_its_delay_at_most(ahead: int) -> None:
    log, error = log_and_autopilot(ahead)
    assert 0 <= error <= 60 * MS
    assert log.restarts == 0


def test_a_log_is_not_believed_before_the_autopilot_has_settled_again() -> None:
    autopilot = OffsetEstimate()
    log = ComponentTime(autopilot)
    for boot in range(0, 5 * SECOND, 50 * MS):
        autopilot.heard(boot, boot + BOOT_AT)
        log.heard(boot, boot + BOOT_AT)
    assert log.settled
    later = 5 * SECOND  # the autopilot is started anew, the log is not
    autopilot.heard(0, later + BOOT_AT)
    log.heard(later, later + BOOT_AT)
    assert not log.settled
    for boot in range(50 * MS, 2 * SECOND, 50 * MS):
        autopilot.heard(boot, later + boot + BOOT_AT)
        log.heard(later + boot, later + boot + BOOT_AT)
    assert log.settled
    assert abs(log.stamp(later) - later - BOOT_AT) <= 1 * MS
