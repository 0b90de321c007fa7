"""The driven ascent after a dive has failed: heading kept, bow up, until the surface. No ROS, no clock."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import numbers, numbers_of, pure
from auv_path_following.guidance.failsafe.watchdogs import sinking_of
from auv_path_following.guidance.spatial.spatial_limits import Steepness, steepest_at, steepest_of
from auv_path_following.missions.mission_state import DEPTH_DOUBTED, PITCHED, ROLLED, SANK, Reason
from auv_path_following.vehicle import Vehicle

#: Phases of an ascent, for pure steps.
NO_ASCENT, ASCENDS, SURFACED, NO_PROGRESS, TOO_LONG, NAVIGATION_ENDED = range(6)

_WORDS = {
    NO_ASCENT: "",
    ASCENDS: "under way",
    SURFACED: "at the surface",
    NO_PROGRESS: "given up: the vehicle did not rise",
    TOO_LONG: "given up: it took too long",
    NAVIGATION_ENDED: "given up: no odometry",
}
#: Distance from the surface depth within which the vehicle is at the surface, m.
THERE = 0.3
#: Decrease of the depth that counts as progress of an ascent, m.
_STEP = 0.5
#: Increase of the depth at which an ascent has failed, m: less may be the momentum of a dive.
_DEEPER = 5.0
#: Distance over which the climb ends at the surface, m.
_LEVELLING = 3.0

When = Literal["never", "sinks", "always"]


@numbers
@settings
class AscentConfig:
    """Driven ascent of a vehicle with stern planes after a limit has ended its mission."""

    when: When = setting(
        "sinks",
        "never: thrust 0 at once; sinks: a hull that does not float up (B not above W; without coefficients:"
        " depth.allow_sinking), or that sank in a hold, ascends first; always: any hull does",
        live=True,
    )
    on_abort: bool = setting(
        False, "the service abort starts an ascent as well; called again, it ends the ascent", live=True
    )
    pitch_deg: float = setting(
        20.0, "pitch of the ascent, bow up; less where the planes do not hold it", unit="deg",
        gt=0.0, le=60.0, live=True,
    )  # fmt: skip
    patience: float = setting(
        20.0, "an ascent that has not risen by 0.5 m for this long ends with thrust 0", unit="s", ge=1.0,
        live=True,
    )  # fmt: skip
    longest: float = setting(300.0, "longest ascent; then thrust 0", unit="s", ge=1.0, live=True)
    linger: float = setting(
        0.0,
        "at the surface the vehicle drives on for this long",
        unit="s",
        ge=0.0,
        live=True,
    )


class Ascent(NamedTuple):
    """Configuration.

    Attributes:
        values: settings.
        always: whether every limit is followed by an ascent.
        if_sunk: whether an ascent follows the limit of sinking.
        surface: depth.surface of the vehicle file, m.
        steepness: theta_max(u).
    """

    values: AscentConfig
    always: bool
    if_sunk: bool
    surface: float
    steepness: Steepness


def prepare(config: AscentConfig, vehicle: Vehicle, thrust: float) -> Ascent:
    """Return the configuration of a vehicle's ascent at a thrust, N."""
    steepness = steepest_of(vehicle, thrust)
    always = config.when == "always" or (config.when == "sinks" and not vehicle.floats)
    return Ascent(numbers_of(config), always, config.when != "never", float(vehicle.depth.surface), steepness)


class AscentState(NamedTuple):
    """State.

    Attributes:
        phase: one of the phases.
        psi: heading that is kept, rad.
        z: depth, m: measured, or by pitch and speed where the measured one is not trusted.
        trusts: whether the measured depth is trusted.
        time: since the beginning, s.
        least, since: least depth so far (m), and time since it last decreased by `_STEP`, s.
        there: time since the surface was reached, s; negative: not yet.
    """

    phase: int
    psi: float
    z: float
    trusts: bool
    time: float
    least: float
    since: float
    there: float


#: Before any ascent.
AT_DEPTH = AscentState(NO_ASCENT, 0.0, 0.0, True, 0.0, 0.0, 0.0, -1.0)


class AscentInputs(NamedTuple):
    """Measured depth (m), attitude (rad, NED) and velocity through the water (m/s, FRD; NaN: none)."""

    z: float
    phi: float
    theta: float
    psi: float
    ur: float
    vr: float
    wr: float


def phase_words(phase: int) -> str:
    """Return a phase as text; empty before an ascent."""
    return _WORDS[phase]


@pure
def has_to_ascend(config: Ascent, reason: Reason, is_asked: bool, z: float) -> bool:
    """Return whether a mission that ends has to end with an ascent.

    Args:
        config: of the ascent.
        reason: why it ends. A vehicle beyond its limits of roll and pitch is not steered, so it does not
            ascend.
        is_asked: whether the service `abort` ends it.
        z: depth, m.
    """
    is_there = z <= config.surface + THERE and reason.cause != DEPTH_DOUBTED
    if is_there or reason.cause == ROLLED or reason.cause == PITCHED:
        return False
    if is_asked:
        return config.values.on_abort
    return config.always or (config.if_sunk and reason.cause == SANK)


@pure
def begun(reason: Reason, z: float, psi: float) -> AscentState:
    """Return the state at the beginning of an ascent.

    Args:
        reason: of the ascent. Where it is the depth, the ascent integrates pitch and speed, beginning at the
            magnitude of the measured depth plus twice the error found: it ends late rather than early.
        z, psi: measured depth (m) and heading (rad).
    """
    trusts = reason.cause != DEPTH_DOUBTED
    depth = z if trusts else abs(z) + 2.0 * reason.found
    return AscentState(ASCENDS, psi, depth, trusts, 0.0, depth, 0.0, -1.0)


@pure
def ascend(config: Ascent, state: AscentState, inputs: AscentInputs, dt: float) -> tuple[AscentState, float]:
    """Return the state, whose phase is `ASCENDS` until the ascent ends, and the desired pitch, rad."""
    c = config.values
    _, psi, depth, trusts, time, least, since, there = state
    z, phi, theta, _, ur, vr, wr = inputs
    time, since = time + dt, since + dt
    has_water = not math.isnan(ur)
    if trusts:
        depth = z
    elif has_water:
        depth += sinking_of(phi, theta, ur, vr, wr) * dt
    if depth < least - _STEP:
        least, since = depth, 0.0
    if there >= 0.0:
        there += dt
    elif depth <= config.surface + THERE:
        there = 0.0
    phase = ASCENDS
    if there >= 0.0:
        if there >= c.linger:
            phase = SURFACED
    elif time > c.longest:
        phase = TOO_LONG
    elif since > c.patience or depth > least + _DEEPER:
        phase = NO_PROGRESS
    climb = math.radians(c.pitch_deg)
    if has_water:
        climb = min(climb, steepest_at(config.steepness, math.sqrt(ur * ur + vr * vr + wr * wr)))
    theta_d = min(max(math.atan2(depth - config.surface, _LEVELLING), -climb), climb)
    return AscentState(phase, psi, depth, trusts, time, least, since, there), theta_d
