"""Dead reckoning and fixes become one pose."""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np
import pytest

from auv_msgs_py.values.types import Navigation, WaterVelocity
from auv_sim.vehicle.draws import Draws, Now, slot
from auv_sim.vehicle.navigator import NavigatorConfig, navigate, navigator_at, navigator_of
from auv_sim.vehicle.position_fixes import FixConfig, fixes_of
from auv_sim.vehicle.sensors import Measurements

DT = 0.05


class Fix(NamedTuple):
    """A position (m, north, east) and for how long it has been past, s."""

    x: float
    y: float
    age: float


class Measured(NamedTuple):
    """What a navigator is given at one step."""

    psi: float
    r: float
    water: WaterVelocity
    bottom: tuple[float, float] | None
    fixes: tuple[Fix, ...]


class Navigator:
    """A navigator with its memory, driven in steps of DT.

    Args:
        latency: of its fixes, s.
        x, y: where it starts, m.
    """

    def __init__(self, latency: float = 0.0, x: float = 0.0, y: float = 0.0) -> None:
        draws = Draws(DT, 1)
        fixes, _ = fixes_of(FixConfig(latency=latency), (0,), draws)
        self.config = navigator_of(NavigatorConfig(), fixes, draws)
        self.memory = draws.memory()
        self.state = navigator_at(self.config, x, y)
        self.time, self.k, self.fixes = 0.0, 0, 0

    def update(self, measured: Measured, dt: float) -> Navigation:
        self.time += dt
        kept, first = self.memory.kept, self.fixes
        for fix in measured.fixes:
            at = slot(self.config.fixes, self.fixes)
            due = self.time + self.config.latency - fix.age
            kept[at : at + 3] = due, fix.x, fix.y
            self.fixes += 1
        u, v = measured.bottom or (1e9, 1e9)
        seen = Measurements(
            measured.psi,
            measured.r,
            measured.water,
            True,
            u,
            v,
            measured.bottom is not None,
            first,
            self.fixes,
        )
        now = Now(self.memory, self.time, self.k)
        self.state, navigation = navigate(self.config, self.state, seen, now, dt)
        self.k += 1
        return navigation


class World:
    """A vehicle on a circle in a current, and what ideal instruments would tell of it."""

    def __init__(self, current: complex = 0.1 + 0.2j, turn: float = 0.02, speed: float = 1.9) -> None:
        self.current, self.turn, self.speed = current, turn, speed
        self.z, self.psi = 0.0 + 0.0j, 0.0

    def advance(self) -> None:
        # The mean heading of the step: exact to the third order, far below what is asserted.
        self.z += (self.speed * cmath.exp(1j * (self.psi + 0.5 * self.turn * DT)) + self.current) * DT
        self.psi += self.turn * DT

    def measured(self, fixes: tuple[Fix, ...] = (), lock: bool = True, crooked: float = 0.0) -> Measured:
        ground = self.speed + self.current * cmath.exp(-1j * self.psi)
        bottom = (ground.real, ground.imag) if lock else None
        water = WaterVelocity(self.speed, 0.0)
        return Measured(self.psi + crooked, self.turn, water, bottom, fixes)

    def fix(self, off: complex = 0.0j) -> Fix:
        return Fix((self.z + off).real, (self.z + off).imag, 0.0)


def error(navigation: Navigation, world: World) -> float:
    return abs(complex(navigation.x, navigation.y) - world.z)


def test_with_bottom_lock_dead_reckoning_is_exact() -> None:
    world, navigator = World(), Navigator()
    out = navigator.update(world.measured(), 0.0)
    for _ in range(2000):
        world.advance()
        out = navigator.update(world.measured(), DT)
    assert error(out, world) < 1e-2
    assert (out.psi, out.r) == (world.psi, world.turn)


@pytest.mark.parametrize("lock", [True, False])
def test_fixes_hold_what_dead_reckoning_loses(lock: bool) -> None:
    """A compass 1 degree off with bottom lock; without, an unknown current."""
    generator = np.random.default_rng(1)
    world, navigator = World(), Navigator()
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
    # The filter's own deviation is right: both axes together, with a margin for the drift that it cannot see.
    assert np.sqrt(np.mean(late**2)) < 2.0 * math.sqrt(2.0 * navigator.state.P_z)


def test_when_the_lock_is_lost_the_learned_current_carries_on() -> None:
    world, navigator = World(), Navigator()
    navigator.update(world.measured(), 0.0)
    for k in range(4000):
        world.advance()
        out = navigator.update(world.measured(lock=k < 2800), DT)
    assert error(out, world) < 0.3  # a minute in a current of 0.22 m/s


def test_an_outlier_is_refused_and_leaves_no_trace() -> None:
    world, navigator = World(), Navigator()
    other = Navigator()
    for target in (navigator, other):
        target.update(world.measured(), 0.0)
    for k in range(1, 400):
        world.advance()
        fixes = (world.fix(),) if k % 20 == 0 else ()
        outlier = (world.fix(12.0 + 5.0j),) if k % 50 == 0 else ()
        out = navigator.update(world.measured(fixes + outlier), DT)
        reference = other.update(world.measured(fixes), DT)
        assert out == reference
    assert (navigator.state.refused, other.state.refused) == (7, 0)


def test_the_pose_never_jumps() -> None:
    generator = np.random.default_rng(2)
    world, navigator = World(), Navigator()
    last = navigator.update(world.measured(), 0.0)
    for k in range(1, 4000):
        world.advance()
        fixes = (world.fix(2.0 * complex(*generator.standard_normal(2))),) if k % 20 == 0 else ()
        now = navigator.update(world.measured(fixes), DT)
        assert math.hypot(now.x - last.x, now.y - last.y) < 2.5 * DT + 0.05
        last = now


def test_a_navigator_that_is_wrong_doubts_itself_after_refusals() -> None:
    world, navigator = World(), Navigator(x=60.0, y=-40.0)
    navigator.update(world.measured(), 0.0)
    for k in range(1, 2001):
        world.advance()
        out = navigator.update(world.measured((world.fix(),) if k % 20 == 0 else ()), DT)
    assert navigator.state.refused >= 5
    assert error(out, world) < 0.5


def test_a_late_fix_is_compared_with_where_the_vehicle_was() -> None:
    world, navigator = World(), Navigator(latency=0.5)
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


def test_a_fix_that_is_older_than_the_track_is_compared_with_its_oldest_entry() -> None:
    world, navigator = World(turn=0.0), Navigator(latency=29.99)
    navigator.update(world.measured(), 0.0)
    seen: list[complex] = [world.z]
    for k in range(1, 2000):
        world.advance()
        seen.append(world.z)
        fixes = (Fix(seen[k - 600].real, seen[k - 600].imag, 30.0),) if k > 600 and k % 20 == 0 else ()
        out = navigator.update(world.measured(fixes), DT)
    assert error(out, world) < 0.02
    assert navigator.state.refused == 0
