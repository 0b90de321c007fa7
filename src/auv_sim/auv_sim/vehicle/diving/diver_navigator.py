"""The navigator of a vehicle that dives: north and east as in the plane, depth by pressure.

Velocities are levelled by the measured roll and pitch, Eq. (3D-14). Between two pressures, depth follows the
velocity down.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import SpatialNavigation, WaterVelocity
from auv_path_following.navigation.levelled import levelled
from auv_sim.vehicle.diving.diver_sensors import SpatialMeasurements, SpatialSensors
from auv_sim.vehicle.draws import Draws, Now, Ring, slot
from auv_sim.vehicle.navigator import (
    Navigator,
    NavigatorConfig,
    NavigatorState,
    navigate,
    navigator_at,
    navigator_of,
    weigh,
)
from auv_sim.vehicle.sensors import Measurements


class SpatialNavigator(NamedTuple):
    """Configuration of the navigator: that of the plane, and the ring of satellite fixes."""

    plane: Navigator
    surface_fixes: Ring


class SpatialNavigatorState(NamedTuple):
    """State of the navigator: that of the plane; depth (m), and the time since the last pressure (s)."""

    plane: NavigatorState
    depth: float
    since: float


def spatial_navigator_of(config: NavigatorConfig, sensors: SpatialSensors, draws: Draws) -> SpatialNavigator:
    """Return the configuration of a navigator.

    Args:
        config: its assumptions about its instruments.
        sensors: its instruments.
        draws: of the run.
    """
    return SpatialNavigator(navigator_of(config, sensors.position, draws), sensors.surface_fix.fixes.ring)


def spatial_navigator_at(config: SpatialNavigator, x: float, y: float) -> SpatialNavigatorState:
    """Return the state of a navigator that starts from a position (m, north, east)."""
    return SpatialNavigatorState(navigator_at(config.plane, x, y), 0.0, 0.0)


@pure
def navigate_in_space(
    config: SpatialNavigator, state: SpatialNavigatorState, measured: SpatialMeasurements, now: Now, dt: float
) -> tuple[SpatialNavigatorState, SpatialNavigation]:
    """Propagate by dead reckoning, correct by fixes and pressure; return the reported pose as well."""
    m = measured
    water, ground = levelled(m.water, m.phi, m.theta), levelled(m.ground, m.phi, m.theta)
    level = Measurements(
        m.psi, m.r,
        WaterVelocity(water.ahead, water.starboard), m.water_lock,
        ground.ahead, ground.starboard, m.bottom_lock,
        m.first, m.after,
    )  # fmt: skip
    plane, _ = navigate(config.plane, state.plane, level, now, dt)
    for k in range(m.surface_first, m.surface_after):
        at, kept = slot(config.surface_fixes, k), now.memory.kept
        fix, age = complex(kept[at + 1], kept[at + 2]), max(now.time - kept[at], 0.0)
        plane = weigh(config.plane, plane, fix, config.plane.assumed.surface_fix, age, now)
    down = ground.down if m.bottom_lock else water.down
    depth, since = _depth(config.plane.assumed.depth_time, state, m, down, now, dt)
    shown = plane.z + plane.shown
    pose = SpatialNavigation(shown.real, shown.imag, depth, m.phi, m.theta, m.psi, m.q, m.r)
    return SpatialNavigatorState(plane, depth, since), pose


@pure
def _depth(
    time: float, state: SpatialNavigatorState, measured: SpatialMeasurements, down: float, now: Now, dt: float
) -> tuple[float, float]:
    """Return the depth and the time since the last pressure; `time` is the time constant, s."""
    if now.k == 0:
        return measured.depth, 0.0
    depth, since = state.depth + down * dt, state.since + dt
    if not measured.is_depth_new:
        return depth, since
    share = -math.expm1(-since / time) if time > 0.0 else 1.0
    return depth + share * (measured.depth - depth), 0.0
