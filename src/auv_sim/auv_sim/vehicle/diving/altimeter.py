"""An echo sounder that looks along the hull's downward axis."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.diving.bottom import Bottom, bottom_at
from auv_sim.vehicle.draws import Draws, Now, Seed
from auv_sim.vehicle.hulls.rigid_body import BodyState, to_world
from auv_sim.vehicle.noise import (
    DropoutConfig,
    Dropouts,
    Noise,
    NoiseConfig,
    dropouts,
    dropouts_of,
    noise,
    noise_of,
    period_of,
    sampler,
)

#: Steps of the search for the bottom along the beam.
_SEARCH = 8


@settings
class AltimeterConfig:
    """An altimeter: range along the hull's downward axis."""

    fitted: bool = setting(True, "whether the vehicle has one")
    noise: NoiseConfig = setting(factory=NoiseConfig, doc="errors of the range, m")
    rate: float = setting(0.0, "measurements a second; 0: at every step", unit="1/s", ge=0.0)
    nearest: float = setting(0.0, "least range with an echo", unit="m", ge=0.0)
    farthest: float = setting(1000.0, "largest range with an echo", unit="m", gt=0.0)
    dropouts: DropoutConfig = setting(factory=DropoutConfig, doc="gaps without an echo")


class Altimeter(NamedTuple):
    """Configuration of an altimeter: whether there is one; noise, period (s), ranges (m), gaps."""

    fitted: bool
    noise: Noise
    period: float
    nearest: float
    farthest: float
    dropouts: Dropouts


class AltimeterState(NamedTuple):
    """The last range (m), its drift (m), and gap and times as in `LogState`."""

    last: float
    drift: float
    silent: bool
    left: float
    until: float
    since: float


def altimeter_of(config: AltimeterConfig, seed: Seed, draws: Draws) -> tuple[Altimeter, AltimeterState]:
    """Return configuration and first state of an altimeter."""
    error, drift = noise_of(config.noise, (*seed, 0), draws, config.rate)
    gaps, left = dropouts_of(config.dropouts, (*seed, 1), draws)
    ranges = config.nearest, config.farthest
    altimeter = Altimeter(config.fitted, error, period_of(config.rate), *ranges, gaps)
    return altimeter, AltimeterState(math.inf, drift, False, left, 0.0, 0.0)


@pure
def range_to(bottom: Bottom, body: BodyState, farthest: float) -> float:
    """Return the range from a body to the bottom along its downward axis, m; infinite beyond `farthest`.

    On a level bottom it is the height over cos phi cos theta.
    """
    dx, dy, dz = to_world(body.qw, body.qi, body.qj, body.qk, 0.0, 0.0, 1.0)
    if not dz > 0.1:
        return math.inf
    length = 0.0
    for _ in range(_SEARCH):
        under = bottom_at(bottom, body.x + length * dx, body.y + length * dy)
        before, length = length, max((under - body.z) / dz, 0.0)
        if length > farthest:
            return math.inf
        if abs(length - before) < 1e-9:
            break
    return length


@pure
def measure_range(
    config: Altimeter, state: AltimeterState, bottom: Bottom, body: BodyState, now: Now, dt: float
) -> AltimeterState:
    """Return the state with the last range, m: infinite without an echo.

    Args:
        config, state: of the altimeter.
        bottom, body: the truth.
        now: of the run.
        dt: s.
    """
    fitted, errors, period, nearest, farthest, gaps = config
    last, drift, silent, left, until, since = state
    if not fitted:
        return AltimeterState(math.nan, drift, silent, left, until, since)
    silent, left = dropouts(gaps, silent, left, now.memory, dt)
    since += dt
    until, due = sampler(period, until, dt)
    if due:
        drift, error = noise(errors, drift, now.memory, since)
        since = 0.0
        last = range_to(bottom, body, farthest) + error
        if silent or not nearest <= last <= farthest:
            last = math.inf
    return AltimeterState(last, drift, silent, left, until, since)
