"""Estimates the current in three components: Eq. (35) in the horizontal plane, and alike for the depth."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.attitude import level_of
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import (
    NO_CURRENT,
    NO_SPATIAL_WATER,
    Navigation,
    SpatialCurrent,
    SpatialNavigation,
    SpatialWater,
    WaterVelocity,
)
from auv_path_following.navigation.current_observer import (
    CurrentObserverConfig,
    Observer,
    ObserverState,
    observe,
    prepare,
    relocated,
)
from auv_path_following.navigation.levelled import levelled


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


class SpatialCurrentObserver:
    """The observer of one vehicle that dives: settings and state.

    Args:
        config: gains.
    """

    def __init__(self, config: CurrentObserverConfig) -> None:
        self.configure(config)
        self.reset()

    def configure(self, config: CurrentObserverConfig) -> None:
        """Take new gains; the estimate is kept."""
        self.config = prepare(config)

    def reset(self) -> None:
        """Reset the state; the next update starts with an estimate of zero."""
        self.state = UNOBSERVED

    def relocate(self) -> None:
        """Forget the last position, which the next one does not continue; keep the current."""
        self.state = spatially_relocated(self.state)

    @property
    def current(self) -> SpatialCurrent:
        """The latest estimate, m/s, NED."""
        return spatial_estimate(self.state)

    def update(self, navigation: SpatialNavigation, water: SpatialWater | None, dt: float) -> None:
        """Take one measurement, see `observe_spatial`; `water` is None where it is unknown."""
        flow = levelled(water or NO_SPATIAL_WATER, navigation.phi, navigation.theta)
        across = WaterVelocity(flow.ahead, flow.starboard)
        self.state = observe_spatial(
            self.config,
            self.state,
            level_of(navigation),
            navigation.z,
            across,
            flow.down,
            water is not None,
            dt,
        )
