"""Satellite fixes: only while the antenna is out of the water."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.draws import Draws, Now, Seed
from auv_sim.vehicle.noise import NoiseConfig
from auv_sim.vehicle.position_fixes import FixConfig, Fixes, FixesState, fixes_of, measure_position


@settings
class SurfaceFixConfig:
    """Satellite fixes (GNSS) of a vehicle that dives, without delay."""

    fitted: bool = setting(True, "whether the vehicle has a receiver")
    noise: NoiseConfig = setting(factory=NoiseConfig, doc="errors north and east, m")
    rate: float = setting(0.0, "fixes a second; 0: at every step", unit="1/s", ge=0.0)
    antenna: float = setting(0.2, "depth of the hull's axis at which the antenna goes under", unit="m")
    acquisition: float = setting(0.0, "from surfacing to the first fix", unit="s", ge=0.0)


class SurfaceFixes(NamedTuple):
    """Configuration of satellite fixes: whether there are any; depth of the hull's axis (m); time (s)."""

    fitted: bool
    fixes: Fixes
    antenna: float
    acquisition: float


class SurfaceFixesState(NamedTuple):
    """State of the fixes, and the time until the receiver has its satellites, s."""

    fixes: FixesState
    left: float


def surface_fixes_of(
    config: SurfaceFixConfig, seed: Seed, draws: Draws
) -> tuple[SurfaceFixes, SurfaceFixesState]:
    """Return configuration and first state of the satellite fixes; at the start there are satellites."""
    fixes, state = fixes_of(FixConfig(noise=config.noise, rate=config.rate), seed, draws)
    limits = config.antenna, config.acquisition
    return SurfaceFixes(config.fitted, fixes, *limits), SurfaceFixesState(state, 0.0)


@pure
def measure_at_surface(
    config: SurfaceFixes, state: SurfaceFixesState, x: float, y: float, z: float, now: Now, dt: float
) -> SurfaceFixesState:
    """Return the state after a fix may have been measured.

    Args:
        config, state: of the fixes.
        x, y, z: the truth, NED, m; z is the depth of the hull's axis.
        now: of the run.
        dt: s.
    """
    if not config.fitted:
        return state
    if z > config.antenna:
        return SurfaceFixesState(state.fixes, config.acquisition)
    left = max(state.left - dt, 0.0)
    if left > 0.0:
        return SurfaceFixesState(state.fixes, left)
    return SurfaceFixesState(measure_position(config.fixes, state.fixes, x, y, now, dt), 0.0)
