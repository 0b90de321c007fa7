"""A vehicle that sinks while no thrust is requested is reported."""

from __future__ import annotations

from auv_path_following.guidance.failsafe.descent import DescentWatch
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig

CONFIG = DiveLimitsConfig(hold_sink=4.0)


def reports(steps: list[tuple[float, float]]) -> list[bool]:
    """Whether something is reported, for (depth, thrust) of each step."""
    watch = DescentWatch()
    return [bool(watch.update(CONFIG, z, thrust)) for z, thrust in steps]


def test_sinking_after_a_mission_is_reported_until_it_is_driven_again() -> None:
    found = reports(
        [(10.0, 6.5), (12.0, 0.0), (15.9, 0.0), (16.1, 0.0), (30.0, 0.0), (30.0, 6.5), (31.0, 0.0)]
    )
    assert found == [False, False, False, True, True, False, False]


def test_rising_and_a_vehicle_that_was_never_driven_are_not_reported() -> None:
    assert not any(reports([(10.0, 6.5), (12.9, 0.0), (5.0, 0.0), (0.1, 0.0)]))
    assert not any(reports([(0.0, 0.0), (20.0, 0.0)]))


def test_the_text_names_the_bound() -> None:
    watch = DescentWatch()
    watch.update(CONFIG, 1.0, 6.5)
    watch.update(CONFIG, 1.0, 0.0)
    assert watch.update(CONFIG, 6.0, 0.0) == "the vehicle sinks with thrust 0: more than 4 m"
