"""Gains for a hull without shipped ones: a rule from a few numbers of its response and the delay.

docs/tuning.md derives the rule and has its measured limits.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import pydantic

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.nism import NismConfig
from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_path_following.control.reference_model import JERK_SHARE, ReferenceConfig
from auv_path_following.control.rule.allowance import KNOWN, Allowance, allowance_for
from auv_path_following.control.rule.fin_response import FinResponse, response_of
from auv_path_following.vehicle import Rudder, Vehicle

#: Least delay that the rule allows for, s.
LEAST_DELAY = 0.1
#: w_c^2 tau: `INSTABILITY` p of an unstable hull, at least `STEADINESS`, 1/s.
INSTABILITY, STEADINESS = 1.7, 3.0
#: Largest kp, rad/s: a faster servo adds nothing but gain.
LARGEST_KP = 1.0
#: The reference's acceleration: share of the full fin, and time in which its jerk builds it up, s.
FIN_SHARE, BUILD_UP = 0.3, 0.5
#: A fin counts as at most this many full angles a second fast, 1/s.
FASTEST = 2.5
#: w_r over w_c, and at most over jerk/acceleration; in pitch it is `PITCH_SHARE` times as much.
REFERENCE_SHARE, REFERENCE_LAG, PITCH_SHARE = 0.1, 0.28, 1.5
#: b rate/p^2 below which a fin is slow for its unstable hull, rad/s: the deviation that it can still catch.
FULL_AUTHORITY = 0.13
#: Share of the steady turn that the reference may use.
RATE_SHARE = 0.9
#: a = k1 k2 and c = k3 k4 over w_c; k1 over the reference's rate, k3 over its acceleration.
A_SHARE, C_SHARE, K1_SHARE, K3_SHARE = 0.19, 0.05, 0.9, 1.0
#: Delta = `LOOKAHEADS` u0/w_r + `DRIFTS` u0 T_v; in pitch the drift counts `PITCH_SHARE` times less.
LOOKAHEADS, DRIFTS = 2.0, 3.5
#: Share of a turn that sideslip may take back before Delta grows, and up to which it grows; see `_lookahead`.
USUAL_SLIP, LARGEST_SLIP = 0.62, 0.9
#: Product of divergence and delay, and authority (rad/s), up to and from which limit cycles were absent.
LARGEST_PRODUCT, LEAST_AUTHORITY = 0.4, 0.1


class PlaneGains(NamedTuple):
    """Gains of one plane.

    Attributes:
        autopilot: controller and reference.
        lookahead: Delta, m.
        crossover: w_c of the inner loop, 1/s.
        product: p tau, the divergence times the delay, the lag by sideslip included; 0 of a stable hull.
        authority: b rate/p^2, rad/s; very large of a stable hull.
    """

    autopilot: AutopilotConfig
    lookahead: float
    crossover: float
    product: float
    authority: float


class RuledGains(NamedTuple):
    """Gains of a vehicle.

    Attributes:
        heading: of the horizontal plane.
        pitch: of the vertical plane; None of a planar vehicle.
        notices: a line for each condition of the rule that the vehicle or the delay does not meet.
    """

    heading: PlaneGains
    pitch: PlaneGains | None
    notices: tuple[str, ...]


def gains_for(vehicle: Vehicle, delay: float = 0.0, step: float = 0.05) -> RuledGains:
    """Return gains for a vehicle.

    Args:
        vehicle: with a hull, or with what was measured.
        delay: from a measurement to the arrival of its command, s; the fin's own dead time is added.
        step: between two odometries, s.

    Raises:
        ConfigurationError: no turn of the hull is steady and none was measured; a gain is out of its range.
    """
    allowance = allowance_for(vehicle.assumed_within)
    heading = plane_gains(response_of(vehicle), vehicle.rudder, delay, step, allowance=allowance)
    pitch = None
    if vehicle.sternplanes is not None:
        # Seen from the side a course has no turns.
        side = response_of(pitch_plane_of(vehicle))._replace(course_turn=0.0)
        pitch = plane_gains(side, vehicle.sternplanes, delay, step, PITCH_SHARE)
    named = (("rudder", heading), ("stern planes", pitch))
    notices = [
        line for name, plane in named if plane is not None for line in _notices(vehicle.name, name, plane)
    ]
    return RuledGains(heading, pitch, tuple(notices))


def plane_gains(
    response: FinResponse, fin: Rudder, delay: float, step: float, quickness: float = 1.0,
    allowance: Allowance = KNOWN,
) -> PlaneGains:  # fmt: skip
    """Return the gains of one plane.

    Args:
        response: of the hull to the fin.
        fin: its limits and dead time.
        delay, step: as in `gains_for`.
        quickness: factor of the reference's bandwidth, divisor of the drift in the look-ahead.
        allowance: for coefficients that are assumed.

    Raises:
        ConfigurationError: a gain is out of its range.
    """
    tau = max(delay + fin.dead_time + 0.5 * step, LEAST_DELAY)
    crossover = _crossover(response, tau)
    kp = min(allowance.kp_for(fin.max_rate, step), LARGEST_KP)
    k5 = 1.0 / (kp * abs(response.gain(crossover)))
    limits = _limits(response, fin, crossover, quickness, allowance)
    bandwidth, rate, acceleration = limits["bandwidth"], limits["max_rate"], limits["max_acceleration"]
    k1, k3 = (allowance.correction * gain for gain in (K1_SHARE * rate, K3_SHARE * acceleration))
    nism = _within(
        NismConfig, k1=k1, k2=A_SHARE * crossover / k1, k3=k3, k4=C_SHARE * crossover / k3, k5=k5, kp=kp
    )
    reference = _within(ReferenceConfig, enabled=True, **limits)
    return PlaneGains(
        AutopilotConfig(nism=nism, reference=reference),
        allowance.lookahead * _lookahead(response, bandwidth, quickness),
        crossover,
        _divergence(response) * (tau + response.lag(crossover)),
        _authority(response, fin),
    )


def _divergence(response: FinResponse) -> float:
    """Return p, 1/s; above 0 also for a stable hull."""
    return max(response.divergence, 1e-6)


def _authority(response: FinResponse, fin: Rudder) -> float:
    """Return b rate/p^2, rad/s."""
    p = _divergence(response)
    return response.effect * fin.max_rate / (p * p)


def _limits(
    response: FinResponse, fin: Rudder, crossover: float, quickness: float, allowance: Allowance
) -> dict[str, float]:
    """Return bandwidth (1/s) and limits (rad/s, rad/s^2, rad/s^3) of the reference, by name of setting."""
    b = response.effect
    jerk = JERK_SHARE * b * min(allowance.reference * fin.max_rate, FASTEST * fin.max_angle)
    acceleration = min(allowance.acceleration * FIN_SHARE * b * fin.max_angle, BUILD_UP * jerk)
    slowest = REFERENCE_LAG * jerk / acceleration
    slowest *= min(1.0, allowance.reference * _authority(response, fin) / FULL_AUTHORITY)
    # Turns of a course must not be faster than the reference: on a slow hull that takes a smaller bandwidth.
    course_turn = allowance.turn * response.course_turn
    slowest = min(slowest, acceleration / max(course_turn, 1e-9))
    bandwidth = quickness * min(REFERENCE_SHARE * crossover, slowest)
    rate = min(max(RATE_SHARE * response.turn, course_turn), acceleration / bandwidth)
    return {
        "bandwidth": bandwidth, "max_rate": rate, "max_acceleration": acceleration, "max_jerk": jerk,
    }  # fmt: skip


def _within(kind: Any, **gains: Any) -> Any:
    """Return gains as settings, which have ranges.

    Raises:
        ConfigurationError: one is out of its range.
    """
    try:
        return kind(**gains)
    except pydantic.ValidationError as error:
        name, range_ = error.errors()[0]["loc"][0], error.errors()[0]["msg"]
        expected = f"{range_.removeprefix('Input should be ')}, as of a vehicle's hull"
        raise ConfigurationError(f"gains by the rule: {name}", f"{gains[str(name)]:.3g}", expected) from None


def _crossover(response: FinResponse, tau: float) -> float:
    """Return w_c = sqrt(max(1.7 p, 3 1/s)/tau'), where sideslip that makes the hull late adds to tau."""
    strength = max(INSTABILITY * response.divergence, STEADINESS)
    crossover = math.sqrt(strength / tau)
    for _ in range(6):
        crossover = math.sqrt(strength / (tau + response.lag(crossover)))
    return crossover


def _lookahead(response: FinResponse, bandwidth: float, quickness: float) -> float:
    """Return Delta, m; longer for a hull that slips.

    Guidance turns the bow by 1/(1 - slip) times a change of course. So the course follows later than the
    heading, and a Delta that suits the heading alone leaves a swing that takes minutes to decay.
    """
    slip = min(response.slip_at(bandwidth), LARGEST_SLIP)
    caution = max((1.0 - USUAL_SLIP) / (1.0 - slip), 1.0)
    drift = DRIFTS / quickness * response.drift_time
    return response.speed * (LOOKAHEADS * caution / bandwidth + drift)


def _notices(name: str, fin: str, plane: PlaneGains) -> list[str]:
    found = []
    if plane.product > LARGEST_PRODUCT:
        found.append(
            f"{name}: {fin}: divergence times delay is {plane.product:.2f}, above {LARGEST_PRODUCT:g}: "
            "too much delay for this hull, expect a limit cycle"
        )
    if plane.authority < LEAST_AUTHORITY:
        found.append(
            f"{name}: {fin}: effect times rate over divergence^2 is {plane.authority:.3f} rad/s, below "
            f"{LEAST_AUTHORITY:g}: too slow a fin for this hull, expect limit cycles after large deviations"
        )
    return found
