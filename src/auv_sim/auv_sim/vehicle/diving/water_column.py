"""The current around a vehicle that dives: the horizontal one with its factor over depth, and upwelling."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import SpatialCurrent
from auv_sim.vehicle.currents import CurrentConfig, Water, flow, vary, water_of
from auv_sim.vehicle.draws import Draws, Lookup, RunMemory, Seed, looked_up
from auv_sim.vehicle.noise import GaussMarkov, gauss_markov, gauss_markov_of


class WaterColumn(NamedTuple):
    """Configuration of the sea's own current.

    Attributes:
        plane: its horizontal part.
        over_depth: factor of the horizontal part over depth, m.
        down: mean of the vertical part, m/s, positive down.
        variation: of the vertical part.
    """

    plane: Water
    over_depth: Lookup
    down: float
    variation: GaussMarkov


class Deviation(NamedTuple):
    """Deviation of the water from its mean: north, east, down, m/s."""

    north: float
    east: float
    down: float


def water_column_of(config: CurrentConfig, seed: Seed, draws: Draws) -> tuple[WaterColumn, Deviation]:
    """Return the configuration of the water and its first deviation from the mean.

    Args:
        config: the parts.
        seed: of its generators.
        draws: of the run.
    """
    plane, north, east = water_of(config, seed, draws)
    u = config.upwelling
    variation, down = gauss_markov_of(u.deviation, u.time, (*seed, 2), draws, u.limit)
    column = WaterColumn(plane, draws.lookup(config.over_depth), -u.mean, variation)
    return column, Deviation(north, east, down)


@pure
def vary_column(config: WaterColumn, state: Deviation, memory: RunMemory, dt: float) -> Deviation:
    """Return the deviation from the mean `dt` seconds later."""
    north, east = vary(config.plane, state.north, state.east, memory, dt)
    return Deviation(north, east, gauss_markov(config.variation, state.down, memory, dt))


@pure
def flow_at_depth(
    config: WaterColumn, state: Deviation, x: float, y: float, z: float, time: float
) -> SpatialCurrent:
    """Return the velocity of the water at a place, m/s, NED.

    Args:
        config: the parts.
        state: deviation from the mean.
        x, y, z: NED, m; z is depth.
        time: since the start, s.
    """
    plane = flow(config.plane, state.north, state.east, x, y, time)
    share = looked_up(config.over_depth, 1, z) if config.over_depth.rows > 0 else 1.0
    down = config.down + state.down + looked_up(config.plane.schedule, 3, time)
    return SpatialCurrent(share * plane.Vx, share * plane.Vy, down)
