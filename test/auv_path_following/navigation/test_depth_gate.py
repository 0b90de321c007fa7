"""Which depths are accepted of a vehicle that dives."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import SpatialNavigation
from auv_path_following import vehicle
from auv_path_following.navigation.depth_gate import DepthGateConfig, PlanarGate, SpatialGate, gate_of
from auv_path_following.navigation.navigation_gate import NavigationGateConfig, Passed

ACCEPTED, REFUSED, MOVED = Passed.ACCEPTED, Passed.REFUSED, Passed.MOVED
DT = 0.1


def gate_with(**gate: Any) -> Any:
    return gate_of(NavigationGateConfig(**gate), DepthGateConfig(), vehicle.load("remus100_6dof"))


def at(t: float, z: float = 10.0, theta: float = -0.1, north: float = 0.0) -> SpatialNavigation:
    """A vehicle that goes east at 2 m/s."""
    return SpatialNavigation(north, 2.0 * t, z, 0.0, theta, 0.0, 0.0, 0.0)


def passed(gate: Any, measurements: Any, under_way: bool = True) -> list[Passed]:
    return [gate.judge(navigation, DT, under_way).passed for navigation in measurements]


@settings(max_examples=50)
@given(st.lists(st.floats(-1.9, 1.9), min_size=2, max_size=40))
def test_what_a_vehicle_can_do_is_always_accepted(rates: list[float]) -> None:
    gate, z = gate_with(), 50.0
    for k, rate in enumerate(rates):
        z += rate * DT
        assert gate.judge(at(k * DT, z), DT, True).passed is ACCEPTED


@pytest.mark.parametrize("z", [60.0, -2.5])
def test_a_jump_is_refused_until_it_has_persisted(z: float) -> None:
    gate = gate_with()
    assert set(passed(gate, [at(k * DT, 20.0) for k in range(11)])) == {ACCEPTED}
    wrong = gate.judge(at(1.1, z), DT, True)
    assert wrong.passed is REFUSED
    assert wrong.found == f"a depth {abs(z - 20.0):.1f} m from the last accepted one"
    after = passed(gate, [at(1.2 + k * DT, z) for k in range(40)])
    assert after.count(MOVED) == 1
    assert after.index(MOVED) == pytest.approx(30, abs=1)  # gate.accept_after: 3 s
    assert set(after[after.index(MOVED) + 1 :]) == {ACCEPTED}


def test_a_lone_outlier_leaves_no_trace() -> None:
    gate = gate_with()
    passed(gate, [at(k * DT) for k in range(11)])
    assert passed(gate, [at(1.1, 60.0), at(1.2), at(1.3, -60.0), at(1.4)]) == [
        REFUSED, ACCEPTED, REFUSED, ACCEPTED,
    ]  # fmt: skip


def test_depths_that_disagree_among_themselves_are_never_accepted() -> None:
    gate = gate_with()
    passed(gate, [at(k * DT) for k in range(11)])
    wild = [at(1.1 + k * DT, 40.0 if k % 2 else 60.0) for k in range(100)]
    assert set(passed(gate, wild)) == {REFUSED}


def test_a_depth_far_above_the_surface_is_never_accepted() -> None:
    """A sign that is turned: it agrees with itself for as long as it likes."""
    gate = gate_with()
    found = [gate.judge(at(k * DT, -10.0), DT, True) for k in range(100)]
    assert {each.passed for each in found} == {REFUSED}
    assert found[0].found == "a depth of -10.0 m"
    assert found[0].expected == "at most 3 m above the surface: z is up in ENU, and down in NED"


def test_an_odometry_without_depth_roll_and_pitch_is_refused_under_way() -> None:
    planar = [at(k * DT, 0.0, 0.0) for k in range(60)]
    assert set(passed(gate_with(), planar, under_way=False)) == {ACCEPTED}
    found = passed(gate_with(), planar)
    assert found.index(REFUSED) == pytest.approx(30, abs=1)
    assert set(found[found.index(REFUSED) :]) == {REFUSED}
    for lively in (at(0.0, 0.0, 1e-9), at(0.0, 1e-9, 0.0)):
        assert set(passed(gate_with(), [lively._replace(y=0.2 * k) for k in range(60)])) == {ACCEPTED}
    gate = gate_with()  # the vehicle stops for it: that does not make it right
    passed(gate, planar)
    assert gate.judge(at(6.0, 0.0, 0.0), DT, False).passed is REFUSED
    gate.reset()
    assert gate.judge(at(6.1, 0.0, 0.0), DT, False).passed is ACCEPTED


def test_a_new_place_is_reported_once_though_its_depth_is_refused_first() -> None:
    gate = gate_with()
    passed(gate, [at(k * DT) for k in range(11)])
    there = [at(1.1 + k * DT, 10.0, north=100.0) for k in range(29)]
    wrong = [at(4.0 + k * DT, 40.0, north=100.0) for k in range(10)]
    back = [at(5.0 + k * DT, 10.0, north=100.0) for k in range(10)]
    found = passed(gate, [*there, *wrong, *back])
    assert found.count(MOVED) == 1
    assert found[29 + 10] is MOVED


def test_a_gate_that_is_off_accepts_everything() -> None:
    assert set(passed(gate_with(enabled=False), [at(0.0, z) for z in (5.0, 500.0, -500.0)])) == {ACCEPTED}


def test_a_planar_vehicle_has_the_level_gate_alone() -> None:
    config, depth = NavigationGateConfig(), DepthGateConfig(depth_margin=7.0)
    planar = gate_of(config, depth, vehicle.load("remus100"))
    assert isinstance(planar, PlanarGate)
    planar.configure(NavigationGateConfig(yaw_rate=1.0), depth)
    assert planar.config.yaw_rate == 1.0
    spatial = gate_with()
    assert isinstance(spatial, SpatialGate)
    spatial.configure(config, depth)
    passed(spatial, [at(0.0)])
    assert passed(spatial, [at(0.1, 16.0)]) == [ACCEPTED]
