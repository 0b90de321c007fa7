"""One odometry out of two messages that come when they like."""

from __future__ import annotations

import math

import pytest

from auv_msgs_py.values.attitude import quaternion_of
from auv_msgs_py.values.types import SpatialNavigation
from auv_sim.nodes.mavlink.navigation import Assembly, Attitude, Position, fuse_in_space
from auv_sim.vehicle.hulls.rigid_body import to_world

#: Southward at 2 m/s, drifting east at 0.1 m/s, turning to starboard.
SPEED, DRIFT, RATE = 2.0, 0.1, 0.2


def attitude(boot_ms: int) -> Attitude:
    return Attitude(boot_ms, math.pi, RATE)


def position(boot_ms: int) -> Position:
    return Position(boot_ms, 100.0 - SPEED * boot_ms * 1e-3, DRIFT * boot_ms * 1e-3, -SPEED, DRIFT)


def test_the_position_is_moved_to_the_attitudes_instant() -> None:
    assembly = Assembly()
    assembly.attitude(attitude(1080))
    fused = assembly.position(position(1000))
    assert fused is not None
    assert fused.boot_ms == 1080
    assert fused.navigation == pytest.approx((100.0 - 2.0 * 1.08, 0.1 * 1.08, math.pi, RATE))
    assert fused.velocity == pytest.approx((SPEED, -DRIFT))  # heading south, east is to port


def test_what_was_overtaken_is_dropped_and_counted() -> None:
    assembly = Assembly()
    assembly.attitude(attitude(1080))
    assembly.attitude(attitude(1060))
    assert assembly.position(position(1050)) is not None
    assert assembly.position(position(1000)) is None
    assert dict(assembly.dropped) == {"ATTITUDE out of order": 1, "LOCAL_POSITION_NED out of order": 1}


def test_no_instant_is_told_twice() -> None:
    assembly = Assembly()
    assembly.attitude(attitude(1000))
    assert assembly.position(position(1000)) is not None
    assert assembly.position(position(1050)) is None
    assembly.attitude(attitude(1060))
    assert assembly.position(position(1100)) is not None


def test_a_position_without_an_attitude_of_its_time_is_no_odometry() -> None:
    assembly = Assembly()
    assert assembly.position(position(1000)) is None
    assembly.attitude(attitude(1000))
    assert assembly.position(position(1201)) is None


def test_depth_and_attitude_of_a_vehicle_that_dives_are_moved_along() -> None:
    assembly = Assembly(fuse_in_space)
    # North at 2 m/s and 0.5 m/s down, bow down by 0.2 rad and rolled to starboard.
    assembly.attitude(Attitude(1080, 0.0, RATE, 0.1, -0.2, 0.01, 0.02))
    fused = assembly.position(Position(1000, 7.0, 3.0, 2.0, 0.0, 12.0, 0.5))
    assert fused is not None
    expected = SpatialNavigation(7.16, 3.0, 12.04, 0.1, -0.2, 0.0, 0.02, RATE)
    assert fused.navigation == pytest.approx(expected)
    assert fused.p == 0.01
    u, v, w = fused.velocity
    assert to_world(*quaternion_of(0.1, -0.2, 0.0), u, v, w) == pytest.approx((2.0, 0.0, 0.5))
    assert u > 2.0 * math.cos(0.2)  # sinking ahead of the bow adds to the speed along it


@pytest.mark.parametrize("spoiled", [{"theta": math.nan}, {"q": math.inf}])
def test_a_pitch_that_is_no_number_goes_nowhere(spoiled: dict[str, float]) -> None:
    assembly = Assembly(fuse_in_space)
    assembly.attitude(Attitude(1000, 0.0, 0.0)._replace(**spoiled))
    assert assembly.position(position(1000)) is None
    assembly.attitude(Attitude(1010, 0.0, 0.0))
    assert assembly.position(position(1010)._replace(z=math.nan)) is None


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_what_is_no_number_goes_nowhere(bad: float) -> None:
    assembly = Assembly()
    assembly.attitude(attitude(1000))
    assembly.attitude(attitude(1010)._replace(r=bad))
    assert assembly.position(position(1010)._replace(x=bad)) is None
    fused = assembly.position(position(1020))
    assert fused is not None
    assert fused.navigation.r == RATE


def test_a_vehicle_that_was_started_anew_begins_anew() -> None:
    assembly = Assembly()
    assembly.attitude(attitude(90_000))
    assembly.position(position(90_000))
    assembly.reset()
    assembly.attitude(attitude(100))
    assert assembly.position(position(100)) is not None
