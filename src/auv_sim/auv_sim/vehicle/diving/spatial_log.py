"""A Doppler log in three dimensions; over ground it has a largest height above the bottom."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.draws import Draws, Now, Ring, Seed, slot
from auv_sim.vehicle.noise import Noise, noise, noise_of
from auv_sim.vehicle.velocity_log import Log, LogState, VelocityConfig, log_of, measure_velocity


class SpatialLog(NamedTuple):
    """Configuration of a Doppler log.

    Attributes:
        plane: of the components ahead and to starboard; it has scale, gaps, rate and delay.
        down: noise of the component down, m/s.
        ring: of the delayed component down.
        highest: largest height above the bottom with lock on it, m; 0: no limit.
    """

    plane: Log
    down: Noise
    ring: Ring
    highest: float


class SpatialLogState(NamedTuple):
    """State of a Doppler log: that of the plane; the last component down and its drift, m/s."""

    plane: LogState
    w: float
    down: float


def spatial_log_of(config: VelocityConfig, seed: Seed, draws: Draws) -> tuple[SpatialLog, SpatialLogState]:
    """Return configuration and first state of a Doppler log."""
    plane, state = log_of(config, seed, draws)
    down, drift = noise_of(config.noise, (*seed, 4), draws, config.rate)
    log = SpatialLog(plane, down, draws.ring(plane.delay.steps + 1), config.highest)
    return log, SpatialLogState(state, 0.0, drift)


@pure
def measure_spatial_velocity(
    config: SpatialLog, state: SpatialLogState, truth: tuple[float, float, float],
    height: float, now: Now, dt: float,
) -> tuple[SpatialLogState, bool]:  # fmt: skip
    """Return the state with the reported velocity, and whether the log has lock on bottom or water.

    Args:
        config, state: of the log.
        truth: u, v, w, m/s, FRD.
        height: above the bottom, m; 0 for a log of the water, and where there is no bottom.
        now: of the run.
        dt: s.
    """
    u, v, w = truth
    scale, forward, starboard, gaps, period, delay, lock = config.plane
    is_too_high = 0.0 < config.highest < height
    log = Log(scale, forward, starboard, gaps, period, delay, lock and not is_too_high)
    before = state.plane.since + dt
    plane, seen = measure_velocity(log, state.plane, u, v, now, dt)
    if delay.steps > 0:
        kept, ring = now.memory.kept, config.ring
        kept[slot(ring, now.k)] = w
        w = kept[slot(ring, max(now.k - delay.steps, 0))]
    last, drift = state.w, state.down
    # All three components are measured at once: then this time is 0.
    if plane.since == 0.0:
        drift, error = noise(config.down, drift, now.memory, before)
        last = scale * w + error
    return SpatialLogState(plane, last, drift), seen
