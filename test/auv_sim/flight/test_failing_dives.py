"""Dives that fail, in closed loop: which limit ends each, when, and where the vehicle is afterwards."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import pytest

from auv_path_following import vehicle
from auv_path_following.guidance.approach import empty_approach
from auv_path_following.guidance.failsafe import guard
from auv_path_following.guidance.failsafe.ascent import (
    NO_ASCENT,
    NO_PROGRESS,
    SURFACED,
    AscentConfig,
)
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig
from auv_path_following.guidance.measured import SpatialMeasured
from auv_path_following.missions import limits, mission_file
from auv_path_following.missions import mission_state as states
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.spatial_pilot import spatial_begun, spatial_pilot
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.loops import loop_of
from auv_sim.flight.scenario import Scenario

REMUS = vehicle.load("remus100_6dof")
#: The fault begins at this time, s: on the helix, 10 deg bow down.
FAULT = 25.0
THRUST = 6.48

Fault = Callable[[float, Any], Any]


def sound(_: float, value: Any) -> Any:
    return value


class Flown(NamedTuple):
    """End of a mission: cause, time after the fault (s), phase of its ascent, greatest and last depth (m)."""

    cause: int
    time: float
    phase: int
    deepest: float
    last: float


def fly(
    measured: Fault = sound, command: Fault = sound, plant: Vehicle = REMUS, *, when: Any = "sinks",
    limit: LimitsConfig | None = None, seconds: float = 60.0, after: float = 0.0, **dive: float,
) -> Flown:  # fmt: skip
    """Fly the helix with a fault; the commands of every step must be finite and within their limits.

    Args:
        measured: (time, `SpatialMeasured`) -> what guidance receives.
        command: (time, command) -> what the plant receives.
        plant: simulated; the controllers assume `REMUS`.
        when: of `AscentConfig`.
        limit: of the mission.
        seconds: longest flight after the fault.
        after: further time without thrust.
        dive: of `DiveLimitsConfig`.
    """
    mission = mission_file.load("helix")
    c = Scenario(
        path=mission.path, spatial=mission.spatial, vehicle=plant, controller_vehicle=REMUS, thrust=THRUST
    )
    loop = loop_of(c)
    watch = guard.prepare(DiveLimitsConfig(**dive), AscentConfig(when=when), REMUS, THRUST)
    bounds = limits.prepare(limit or LimitsConfig())
    guide = loop.pilot.guide._replace(guard=watch, limits=bounds, hold_after=1.0)
    config, diver, dt = loop.pilot._replace(guide=guide), loop.vehicle, c.dt
    state, seen, deepest = spatial_begun(config, empty_approach()), loop.vehicle.seen, 0.0
    ended = math.inf
    for k in range(round((FAULT + seconds + after) / dt)):
        t = k * dt - FAULT
        found = SpatialMeasured(seen.navigation, seen.water, True, False, 0.0, k * dt, math.nan)
        state, (*_, order) = spatial_pilot(config, loop.path, state, measured(t, found), dt if k else 0.0)
        assert abs(order.rudder) <= REMUS.rudder.max_angle and order.thrust in (0.0, THRUST)
        assert abs(order.sternplanes) <= math.radians(20.0)  # NaN fails, too
        seen = diver.advance(command(t, order), dt)
        deepest = max(deepest, seen.motion.z)
        if state.guide.mission.state == states.ABORTED:
            ended = min(ended, t)
            if t - ended >= after:
                break
    guiding = state.guide
    cause = guiding.mission.reason.cause if guiding.mission.state == states.ABORTED else states.STARTED
    return Flown(cause, ended, guiding.guard.ascent.phase, deepest, seen.motion.z)


def with_depth(change: Callable[[float], float]) -> Fault:
    def measured(t: float, m: SpatialMeasured) -> SpatialMeasured:
        return m if t < 0.0 else m._replace(navigation=m.navigation._replace(z=change(m.navigation.z)))

    return measured


def planes(angle: float) -> Fault:
    return lambda t, order: order if t < 0.0 else order._replace(sternplanes=angle)


def rolls(t: float, m: SpatialMeasured) -> SpatialMeasured:
    return m if t < 0.0 else m._replace(navigation=m.navigation._replace(phi=1.2))


def no_water(t: float, m: SpatialMeasured) -> SpatialMeasured:
    return m._replace(has_water=t < 0.0)


def weak(t: float, order: Any) -> Any:
    return order if t < 0.0 else order._replace(thrust=min(order.thrust, 0.5))


def ballasted(buoyancy: float) -> Vehicle:
    """The hull with another buoyancy, N."""
    assert REMUS.hull is not None and REMUS.hull.vertical is not None
    vertical = dataclasses.replace(REMUS.hull.vertical, B=buoyancy)
    depth = dataclasses.replace(REMUS.depth, allow_sinking=True, minimum_speed=1.9)
    return dataclasses.replace(REMUS, hull=dataclasses.replace(REMUS.hull, vertical=vertical), depth=depth)


def test_a_sound_dive_is_not_ended() -> None:
    assert fly(seconds=30.0).cause == states.STARTED


@pytest.mark.parametrize(
    ("fault", "cause", "latest"),
    [
        ({"measured": with_depth(lambda _: 6.5)}, states.DEPTH_DOUBTED, 12.0),
        ({"measured": rolls}, states.ROLLED, 1.2),
        ({"command": planes(0.35)}, states.PITCHED, 8.0),
        ({"command": planes(-0.35)}, states.PITCHED, 8.0),
        ({"command": planes(0.0), "depth_patience": 10.0}, states.DEPTH_STALLED, 25.0),
        ({"command": weak}, states.TOO_SLOW, 25.0),
        ({"plant": ballasted(316.0), "depth_patience": 10.0, "slow_after": 0.0}, states.DEPTH_STALLED, 40.0),
    ],
    ids=["frozen", "rolled", "planes down", "planes up", "planes neutral", "slow", "buoyant"],
)  # fmt: skip
def test_a_fault_ends_the_dive_and_the_vehicle_floats(fault: Any, cause: int, latest: float) -> None:
    """It begins to rise within seconds: the momentum of the dive is spent."""
    flown = fly(**fault, after=40.0)
    assert flown.cause == cause
    assert flown.time < latest
    assert flown.phase == NO_ASCENT
    assert flown.last < flown.deepest - 0.5 and flown.deepest < 30.0


def test_a_sign_that_is_turned_from_the_start_ends_the_dive_at_once() -> None:
    flown = fly(lambda _, m: m._replace(navigation=m.navigation._replace(z=-m.navigation.z)))
    assert flown.cause == states.DEPTH_DOUBTED
    assert flown.time < 10.0 - FAULT
    assert flown.deepest < 8.0


def test_below_the_largest_depth_the_vehicle_ascends() -> None:
    flown = fly(limit=LimitsConfig(max_depth=8.0), when="always")
    assert (flown.cause, flown.phase) == (states.MAX_DEPTH, SURFACED)
    assert flown.deepest < 11.0
    assert flown.last < 0.81


def test_a_frozen_depth_does_not_keep_the_vehicle_from_the_surface() -> None:
    flown = fly(with_depth(lambda _: 6.5), when="always")
    assert (flown.cause, flown.phase) == (states.DEPTH_DOUBTED, SURFACED)
    assert flown.last < 1.0


def test_planes_that_are_stuck_do_not_drive_the_vehicle_down() -> None:
    """The ascent that does not rise is given up: thrust 0, and the hull floats."""
    flown = fly(command=planes(0.02), when="always", depth_patience=10.0)
    assert (flown.cause, flown.phase) == (states.DEPTH_STALLED, NO_PROGRESS)


def test_a_vehicle_that_sinks_in_a_hold_ascends() -> None:
    """Without velocity through the water it holds, and sinks: odometry alone flies it up."""
    flown = fly(no_water, plant=ballasted(290.0), seconds=120.0)
    assert (flown.cause, flown.phase) == (states.SANK, SURFACED)
    assert flown.deepest < 18.0
    assert flown.last < 0.81
