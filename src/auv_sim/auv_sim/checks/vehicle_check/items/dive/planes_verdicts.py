"""Verdicts on the stern planes, from how the measured angle and the pitch rate follow the commands."""

from __future__ import annotations

from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.fits import Fit
from auv_sim.checks.vehicle_check.items.response import GOOD_DELAY, WORST_DELAY
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown, warned

#: What is judged here.
ITEMS = ("stern planes: sign and scale", "stern planes: rate", "stern planes: dead time")
_NEEDED = "stern-plane commands of some degrees while the vehicle moves: --wiggle, or a mission under way"
#: Largest share of the quick changes that the planes leave unexplained: for the sign, for rate and dead time,
#: and for rate and dead time from the measured angle.
_SHOWN, _FOLLOWS, _CLOSE = 0.7, 0.5, 0.3
#: Mistakes of the axes with which the planes seem to act the other way.
_TURNED = {
    Mistake.PITCH_SIGN,
    Mistake.DIVE_OTHER_CONVENTION,
    Mistake.AXES_OTHER_CONVENTION,
    Mistake.DIVE_SIGN,
}


def check_planes(
    state: Fit | None, pitching: Fit | None, vehicle: Vehicle, axes: Mistake | None
) -> list[Verdict]:
    """Judge sign and scale, rate and dead time.

    Args:
        state: of the measured angle, None without it.
        pitching: of the pitch rate, None if it shows nothing.
        vehicle: its file.
        axes: what is wrong with the axes of depth and pitch.
    """
    if state is None and pitching is None:
        return [unknown(item, "no commands to follow", _NEEDED) for item in ITEMS]
    return [_sign(state, pitching, axes), *_rate_and_delay(state, pitching, vehicle)]


def _sign(state: Fit | None, pitching: Fit | None, axes: Mistake | None) -> Verdict:
    item, expected = ITEMS[0], "1: positive turns the bow down, radians"
    named = (("sternplane_state", state), ("pitch rate", pitching))
    shares = "; ".join(f"{name} {fit.scale * fit.gain:.2g}" for name, fit in named if fit is not None)
    measured = f"per command and file: {shares}"
    for fit in (state, pitching):
        if fit is not None and fit.scale != 1.0 and fit.unexplained < 0.5 and 0.3 < abs(fit.gain) < 3.0:
            return failed(item, Mistake.PLANES_DEGREES, measured, expected)
    if state is not None and abs(state.gain) < 0.05:
        return failed(item, Mistake.PLANES_DEAD, measured, expected)
    if pitching is None:
        return unknown(item, f"{measured}; the pitch does not show it", _NEEDED)
    if pitching.unexplained > _SHOWN:
        return failed(item, Mistake.PLANES_DEAD, measured, expected)
    if pitching.gain < 0.0:
        if axes in _TURNED:
            return failed(item, axes, measured, expected)
        return failed(item, Mistake.PLANES_SIGN, measured, f"{expected}: negate the command in the driver")
    if state is not None and state.gain < 0.0:
        return failed(item, Mistake.PLANES_STATE_SIGN, measured, expected)
    scale = state.gain if state is not None else pitching.gain
    if not 0.3 < pitching.gain < 3.0 or (state is not None and not 0.7 < scale < 1.4):
        if state is not None and 0.7 < scale < 1.4:
            return warned(item, measured, "a hull as the vehicle's file has it", Mistake.PLANES_SCALE)
        return failed(item, Mistake.PLANES_SCALE, measured, expected)
    return passed(item, measured, expected)


def _rate_and_delay(state: Fit | None, pitching: Fit | None, vehicle: Vehicle) -> list[Verdict]:
    fit = state if state is not None and state.unexplained < _CLOSE else pitching
    if fit is None or fit.unexplained > _FOLLOWS or fit.scale != 1.0:
        return [unknown(item, "the planes do not follow closely enough", _NEEDED) for item in ITEMS[1:]]
    assert vehicle.sternplanes is not None
    file = vehicle.sternplanes.max_rate_deg_s
    # The pitch rate alone shows a slow servo less clearly.
    slowest = 0.55 if fit is state else 0.35
    measured, expected = f"about {fit.rate * file:.0f} deg/s", f"{file:g} deg/s, from the vehicle's file"
    if fit.rate < slowest and fit.rate * file < 30.0:
        rate = failed(ITEMS[1], Mistake.PLANES_SLOW, measured, expected)
    else:
        rate = passed(ITEMS[1], measured, expected)
    measured, expected = (
        f"{fit.delay * 1e3:.0f} ms",
        f"{GOOD_DELAY * 1e3:.0f} ms or less, or the planes swing",
    )
    if fit.delay > WORST_DELAY:
        return [rate, failed(ITEMS[2], Mistake.PLANES_DEAD_TIME, measured, expected)]
    if fit.delay > GOOD_DELAY:
        return [rate, warned(ITEMS[2], measured, expected, Mistake.PLANES_DEAD_TIME)]
    return [rate, passed(ITEMS[2], measured, expected)]
