"""What the vertical plane follows: the path's depth, one depth, or an altitude above the bottom."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, dispatched, pure

#: Steepest slope of the bottom that is fed forward, rad.
STEEPEST_BOTTOM = math.radians(20.0)


@settings
class AltitudeConfig:
    """Filter of the bottom, and the response to a lost echo."""

    bandwidth: float = setting(
        1.0, "bandwidth of the bottom's tracker", unit="1/s", gt=0.0, le=10.0, live=True
    )
    damping: float = setting(0.7, "damping ratio of the tracker", gt=0.1, le=5.0, live=True)
    patience: float = setting(
        5.0, "without an echo the depth is held for this long; then the vehicle climbs", unit="s", ge=0.0,
        le=600.0, live=True,
    )  # fmt: skip
    largest_drop: float = setting(
        5.0,
        "a bottom deeper than the tracked one by more than this is ignored until it has lasted"
        " for patience, so that a false echo does not lead down",
        unit="m", gt=0.0, live=True,
    )  # fmt: skip


@settings
class VerticalConfig:
    """Guidance in the vertical plane."""

    lookahead: float = setting(5.2, "Delta_v, Eq. (3D-22)", unit="m", gt=0.0, le=1000.0, live=True)
    altitude: AltitudeConfig = setting(factory=AltitudeConfig, doc="flight at an altitude above the bottom")


class PathDepth(NamedTuple):
    """Follow the depth of the path."""


FOLLOW_PATH = PathDepth()


class DepthHold(NamedTuple):
    """Hold one depth, m."""

    depth: float


class AltitudeHold(NamedTuple):
    """Hold an altitude above the bottom.

    Attributes:
        above: altitude, m.
        least: below it the vehicle climbs as steeply as it can, m.
        surface, deepest: range of the requested depth, m.
        bandwidth, damping, patience, largest_drop: of `AltitudeConfig`.
    """

    above: float
    least: float
    surface: float
    deepest: float
    bandwidth: float
    damping: float
    patience: float
    largest_drop: float


class VerticalState(NamedTuple):
    """State of a vertical mode.

    Attributes:
        begun: whether `depth` holds a request.
        tracked: whether an echo was ever received.
        bottom, sinking: the tracked depth of the bottom (m), and its rate (m/s).
        depth: requested, m.
        silent: time since the last echo, s.
        heard_at: depth of the vehicle at the last echo, m.
        dropped: time for which the bottom has been deeper than `largest_drop` allows, s.
    """

    begun: bool = False
    tracked: bool = False
    bottom: float = 0.0
    sinking: float = 0.0
    depth: float = 0.0
    silent: float = 0.0
    heard_at: float = 0.0
    dropped: float = 0.0


#: The state at the beginning of a mission.
NO_REQUEST = VerticalState(False, False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class VerticalInputs(NamedTuple):
    """Measurements, and the request of the path.

    Attributes:
        z: depth, m.
        tilt: cos(phi) cos(theta).
        altitude: range to the bottom along body z, m.
        speed: over ground, m/s.
        ze, gamma_a, rho: from the path: m, rad, Eq. (3D-19).
        depth: of the virtual point, m.
        steepest: theta_max, rad.
    """

    z: float
    tilt: float
    altitude: float
    speed: float
    ze: float
    gamma_a: float
    rho: float
    depth: float
    steepest: float


class VerticalRequest(NamedTuple):
    """What the law of the vertical plane receives.

    Attributes:
        ze: how far the vehicle is below the request, m.
        gamma_a, rho: of Eq. (3D-19), rad and 1.
        depth: requested, m.
        least_climb: least elevation gamma_d, rad; minus infinity for none.
    """

    ze: float
    gamma_a: float
    rho: float
    depth: float
    least_climb: float


@pure
def follow_depth(
    mode: PathDepth, state: VerticalState, inputs: VerticalInputs, dt: float
) -> tuple[VerticalState, VerticalRequest]:
    """Request the depth of the path."""
    return state, VerticalRequest(inputs.ze, inputs.gamma_a, inputs.rho, inputs.depth, -math.inf)


@pure
def hold_depth(
    mode: DepthHold, state: VerticalState, inputs: VerticalInputs, dt: float
) -> tuple[VerticalState, VerticalRequest]:
    """Request one depth, whatever the path has."""
    return state, VerticalRequest(inputs.z - mode.depth, 0.0, 1.0, mode.depth, -math.inf)


@pure
def echo(
    mode: AltitudeHold, state: VerticalState, altitude: float, there: float, dt: float
) -> tuple[bool, bool, float]:
    """Return whether there is an echo of the bottom, whether that is tracked, and the time of a drop, s.

    Args:
        mode, state: of the vertical plane.
        altitude: range to the bottom, m.
        there: depth of the bottom by this range, m.
        dt: seconds since the last step.
    """
    if not 0.0 < altitude < math.inf:  # NaN is no echo
        return False, state.tracked, 0.0
    if not state.tracked or there - state.bottom <= mode.largest_drop:
        return True, state.tracked, 0.0
    dropped = state.dropped + dt
    if dropped > mode.patience:  # it is the bottom
        return True, False, 0.0
    return False, True, dropped


@pure
def hold_altitude(
    mode: AltitudeHold, state: VerticalState, inputs: VerticalInputs, dt: float
) -> tuple[VerticalState, VerticalRequest]:
    """Request a depth above the bottom, with the bottom's slope fed forward.

    Without an echo the requested depth is held for a while; then the vehicle climbs at theta_max/2 to the
    depth at which it had the last one. A vehicle below the least altitude climbs at theta_max.
    """
    z, tilt, altitude, speed = inputs.z, inputs.tilt, inputs.altitude, inputs.speed
    begun, tracked, bottom, sinking, depth, silent, heard_at, dropped = state
    if not begun:
        depth = heard_at = z
    slope, least_climb, there = 0.0, -math.inf, z + altitude * tilt
    has_echo, tracked, dropped = echo(mode, state, altitude, there, dt)
    if has_echo:
        if tracked:
            w = mode.bandwidth
            sinking += (w * w * (there - bottom) - 2.0 * mode.damping * w * sinking) * dt
            bottom += sinking * dt
        else:
            bottom, sinking = there, 0.0
        tracked, silent, heard_at = True, 0.0, z
        depth = bottom - mode.above
        if mode.surface < depth < mode.deepest:
            slope = bounded(math.atan2(-sinking, max(speed, 0.1)), STEEPEST_BOTTOM)
        if altitude * tilt < mode.least:
            least_climb = inputs.steepest
    elif altitude <= 0.0:  # too close to be measured
        silent, least_climb = 0.0, inputs.steepest
    else:
        silent, sinking = silent + dt, 0.0
        if silent > mode.patience and z > heard_at:
            depth, least_climb = heard_at, 0.5 * inputs.steepest
    depth = min(max(depth, mode.surface), mode.deepest)
    ze = math.cos(slope) * (z - depth)
    state = VerticalState(True, tracked, bottom, sinking, depth, silent, heard_at, dropped)
    return state, VerticalRequest(ze, slope, 1.0, depth, least_climb)


#: One step of a vertical mode: (configuration, state, `VerticalInputs`, dt) -> (state, `VerticalRequest`).
vertical_step = dispatched({PathDepth: follow_depth, DepthHold: hold_depth, AltitudeHold: hold_altitude})
