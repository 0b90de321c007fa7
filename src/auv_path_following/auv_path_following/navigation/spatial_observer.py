"""Estimates the current in three components: Eq. (35) in the horizontal plane, and alike for the depth."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import NO_CURRENT, Navigation, SpatialCurrent, WaterVelocity
from auv_path_following.navigation.current_observer import Observer, ObserverState, observe, relocated


class SpatialObserverState(NamedTuple):
    """States of the observer of x and y, and of the one of z."""

    horizontal: ObserverState
    vertical: ObserverState


#: The state before the first measurement.
UNOBSERVED = SpatialObserverState(
    ObserverState(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, NO_CURRENT),
    ObserverState(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, NO_CURRENT),
)


@pure
def spatial_estimate(state: SpatialObserverState) -> SpatialCurrent:
    """Return the estimated current, m/s, NED."""
    across, down = state.horizontal.current, state.vertical.current
    return SpatialCurrent(across.Vx, across.Vy, down.Vx)


@pure
def spatially_relocated(state: SpatialObserverState) -> SpatialObserverState:
    """Return the state in which the next place does not continue the last one; the current is kept."""
    return SpatialObserverState(relocated(state.horizontal), relocated(state.vertical))


@pure
def observe_spatial(
    config: Observer,
    state: SpatialObserverState,
    level: Navigation,
    z: float,
    water: WaterVelocity,
    sinking: float,
    has_water: bool,
    dt: float,
) -> SpatialObserverState:
    """Estimate the current; what is not measured of the velocity through the water appears in it.

    Args:
        config: gains, the same for all components.
        state: of the observers.
        level: place and heading, NED.
        z: depth, m.
        water: velocity through the water, levelled: ahead and to starboard, m/s.
        sinking: its part downwards, m/s.
        has_water: whether that is known now; otherwise the estimate rests.
        dt: seconds since the last step, greater than 0; ignored on the first one.
    """
    # The depth is an axis of its own, along which the vehicle "heads".
    downwards, along = Navigation(z, 0.0, 0.0, 0.0), WaterVelocity(sinking, 0.0)
    return SpatialObserverState(
        observe(config, state.horizontal, level, water, has_water, dt),
        observe(config, state.vertical, downwards, along, has_water, dt),
    )
