"""Dead reckoning and fixes become one pose."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from auv_msgs_py.types import WaterVelocity
from auv_sim.plant.navigator import Navigator, NavigatorConfig
from auv_sim.plant.sensors import Fix, Measurements

DT = 0.05


class World:
    """A vehicle on a circle in a current, and what ideal instruments would tell of it."""

    def __init__(self, current: complex = 0.1 + 0.2j, turn: float = 0.02, speed: float = 1.9) -> None:
        self.current, self.turn, self.speed = current, turn, speed
        self.z, self.psi = 0.0 + 0.0j, 0.0

    def advance(self) -> None:
        # The mean heading of the step: exact to the third order, far below what is asserted.
        self.z += (self.speed * cmath.exp(1j * (self.psi + 0.5 * self.turn * DT)) + self.current) * DT
        self.psi += self.turn * DT

    def measured(self, fixes: tuple[Fix, ...] = (), lock: bool = True, crooked: float = 0.0) -> Measurements:
        ground = self.speed + self.current * cmath.exp(-1j * self.psi)
        bottom = (ground.real, ground.imag) if lock else None
        water = WaterVelocity(self.speed, 0.0)
        return Measurements(self.psi + crooked, self.turn, water, True, bottom, fixes)

    def fix(self, off: complex = 0.0j) -> Fix:
        return Fix((self.z + off).real, (self.z + off).imag, 0.0)


def error(navigator_output, world: World) -> float:
    return abs(complex(navigator_output.navigation.x, navigator_output.navigation.y) - world.z)


def test_with_bottom_lock_dead_reckoning_is_exact() -> None:
    world, navigator = World(), Navigator(NavigatorConfig())
    out = navigator.update(world.measured(), 0.0)
    for _ in range(2000):
        world.advance()
        out = navigator.update(world.measured(), DT)
    assert error(out, world) < 1e-2
    assert (out.navigation.psi, out.navigation.r) == (world.psi, world.turn)


def test_the_twist_is_the_bottom_tracks_and_nan_without_lock() -> None:
    world, navigator = World(), Navigator(NavigatorConfig())
    out = navigator.update(world.measured(), 0.0)
    assert (out.u, out.v) == pytest.approx((2.0, 0.2))
    out = navigator.update(world.measured(lock=False), DT)
    assert math.isnan(out.u)
    assert math.isnan(out.v)


@pytest.mark.parametrize("lock", [True, False])
def test_fixes_hold_what_dead_reckoning_loses(lock: bool) -> None:
    """A compass 1 degree off with bottom lock; without, a current that nobody has told."""
    generator = np.random.default_rng(1)
    world, navigator = World(), Navigator(NavigatorConfig())
    navigator.update(world.measured(lock=lock), 0.0)
    errors = []
    for k in range(1, 12_001):
        world.advance()
        off = complex(*generator.standard_normal(2))
        fixes = (world.fix(off),) if k % 20 == 0 else ()
        out = navigator.update(world.measured(fixes, lock, math.radians(1.0)), DT)
        errors.append(error(out, world))
    late = np.array(errors[4000:])
    assert np.sqrt(np.mean(late**2)) < (0.4 if lock else 0.8)
    # The filter knows how good it is: both axes together, with a margin for the drift that it cannot see.
    assert np.sqrt(np.mean(late**2)) < 2.0 * math.sqrt(2.0) * out.deviation


def test_when_the_lock_is_lost_the_learned_current_carries_on() -> None:
    world, navigator = World(), Navigator(NavigatorConfig())
    navigator.update(world.measured(), 0.0)
    for k in range(4000):
        world.advance()
        out = navigator.update(world.measured(lock=k < 2800), DT)
    assert error(out, world) < 0.3  # a minute in a current of 0.22 m/s


def test_an_outlier_is_refused_and_leaves_no_trace() -> None:
    world, navigator = World(), Navigator(NavigatorConfig())
    other = Navigator(NavigatorConfig())
    for target in (navigator, other):
        target.update(world.measured(), 0.0)
    for k in range(1, 400):
        world.advance()
        fixes = (world.fix(),) if k % 20 == 0 else ()
        outlier = (world.fix(12.0 + 5.0j),) if k % 50 == 0 else ()
        out = navigator.update(world.measured(fixes + outlier), DT)
        reference = other.update(world.measured(fixes), DT)
        assert out.navigation == reference.navigation
    assert (out.refused, reference.refused) == (7, 0)


def test_the_pose_never_jumps() -> None:
    generator = np.random.default_rng(2)
    world, navigator = World(), Navigator(NavigatorConfig())
    last = navigator.update(world.measured(), 0.0).navigation
    for k in range(1, 4000):
        world.advance()
        fixes = (world.fix(2.0 * complex(*generator.standard_normal(2))),) if k % 20 == 0 else ()
        now = navigator.update(world.measured(fixes), DT).navigation
        assert math.hypot(now.x - last.x, now.y - last.y) < 2.5 * DT + 0.05
        last = now


def test_a_navigator_that_is_wrong_comes_to_doubt_itself() -> None:
    world, navigator = World(), Navigator(NavigatorConfig())
    navigator.reset(60.0, -40.0)
    navigator.update(world.measured(), 0.0)
    for k in range(1, 2001):
        world.advance()
        out = navigator.update(world.measured((world.fix(),) if k % 20 == 0 else ()), DT)
    assert out.refused >= 5
    assert error(out, world) < 0.5


def test_a_late_fix_is_compared_with_where_the_vehicle_was() -> None:
    world, navigator = World(), Navigator(NavigatorConfig())
    navigator.update(world.measured(), 0.0)
    seen: list[complex] = [world.z]
    for k in range(1, 2000):
        world.advance()
        seen.append(world.z)
        fixes: tuple[Fix, ...] = ()
        if k % 20 == 0:
            then = 0.5 * (seen[k - 10] + seen[k - 11])  # between two steps
            fixes = (Fix(then.real, then.imag, 0.525),)
        out = navigator.update(world.measured(fixes), DT)
    assert error(out, world) < 0.02


def test_a_reset_begins_anew() -> None:
    world, navigator = World(), Navigator(NavigatorConfig())
    navigator.update(world.measured((world.fix(1.0 + 0.0j),)), 0.0)
    navigator.reset(0.0, 0.0)
    fresh = Navigator(NavigatorConfig())
    assert navigator.update(world.measured(), 0.0) == fresh.update(world.measured(), 0.0)
