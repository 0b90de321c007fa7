"""All checks on a vehicle that dives, in the order of the report, each cause named once."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.dive import altitude, heave, planes, presence, signs
from auv_sim.checks.vehicle_check.items.dive.dive_motion import DiveMotion, of_water
from auv_sim.checks.vehicle_check.items.dive.planes_verdicts import ITEMS, check_planes
from auv_sim.checks.vehicle_check.items.fits import Fit
from auv_sim.checks.vehicle_check.items.velocities import ENOUGH, SPAN
from auv_sim.checks.vehicle_check.samples import Recording, slope
from auv_sim.checks.vehicle_check.verdict import Level, Mistake, Verdict, unknown

#: Mistakes that a tilted attitude brings about.
_OF_ATTITUDE = {
    Mistake.YAW_OTHER_CONVENTION, Mistake.YAW_SIGN, Mistake.YAW_UNRELATED, Mistake.YAW_RATE_SIGN,
    Mistake.YAW_RATE_WRONG, Mistake.YAW_DEGREES, Mistake.SWAPPED_AXES, Mistake.MIRRORED_POSITION,
    Mistake.SWAY_SIGN, Mistake.VELOCITY_IN_WORLD, Mistake.VELOCITY_WRONG, Mistake.VELOCITY_UNITS,
    Mistake.WATER_SWAY_SIGN, Mistake.WATER_IN_WORLD, Mistake.WATER_WRONG, Mistake.RUDDER_SIGN,
}  # fmt: skip
_KINEMATIC = (
    presence.DEPTH, signs.PITCH, presence.PITCH_RATE, presence.ROLL_RATE, heave.HEAVE, heave.WATER_HEAVE,
    altitude.AGAINST_DEPTH,
)  # fmt: skip


class PlaneFits(NamedTuple):
    """How the stern planes follow their commands: the measured angle, and the pitch rate; None: not shown."""

    state: Fit | None
    pitching: Fit | None


def check_dive(
    recording: Recording, dive: DiveMotion, vehicle: Vehicle, rudder: Mistake | None
) -> list[Verdict]:
    """Judge depth, attitude, vertical velocities, altitude and stern planes.

    Args:
        recording: as it was heard.
        dive: the motion that it shows.
        vehicle: its file, for the stern planes.
        rudder: what is wrong with the rudder.
    """
    if dive.t.size < 20 or dive.t[-1] - dive.t[0] < 3.0:
        return [unknown(item, "too little odometry", ENOUGH) for item in (*_KINEMATIC, *ITEMS)]
    first = presence.check_presence(dive)
    if first.level is Level.FAIL:
        assert first.mistake is not None
        why = "the depth and the attitude come first", f"without {first.mistake.value}"
        return [first, *(unknown(item, *why) for item in (*_KINEMATIC[1:], *ITEMS))]
    ratio = presence.rate_ratio(dive.t, dive.pitch, dive.pitch_rate)
    rate = presence.check_pitch_rate(ratio)
    fits = _plane_fits(recording, presence.with_sound_rate(dive), vehicle)
    verdict = _signs(recording, dive, ratio, fits, rudder)
    if verdict.mistake is Mistake.PITCH_SIGN and rate.mistake is Mistake.PITCH_RATE_SIGN:
        rate = rate._replace(mistake=verdict.mistake)
    kinematic = [first, verdict, rate, presence.check_roll_rate(dive)]
    if verdict.mistake is not None:
        why = "the axes come first", f"without {verdict.mistake.value}"
        kinematic += [unknown(item, *why) for item in _KINEMATIC[4:]]
    else:
        kinematic += [heave.check_heave(dive), heave.check_water_heave(recording, dive)]
        kinematic += altitude.check_altitude(recording, dive)
    return [*kinematic, *check_planes(*fits, vehicle, verdict.mistake)]


def _plane_fits(recording: Recording, dive: DiveMotion, vehicle: Vehicle) -> PlaneFits:
    t, commands = planes.commanded(recording)
    if not planes.enough(commands):
        return PlaneFits(None, None)
    return PlaneFits(
        planes.fit_planes_state(recording, t, commands, vehicle),
        planes.fit_pitching(recording, dive, t, commands, vehicle),
    )


def _signs(
    recording: Recording, dive: DiveMotion, ratio: float, fits: PlaneFits, rudder: Mistake | None
) -> Verdict:
    _, middles = slope(dive.t, dive.z, SPAN)
    ahead, _, _ = of_water(recording, dive, middles, SPAN)
    shown = fits.pitching is not None and fits.pitching.unexplained < 0.7
    found = signs.Signs(
        signs.climb_ratio(dive, ahead, middles),
        signs.depth_sign(dive),
        math.copysign(1.0, ratio) if math.isfinite(ratio) else math.nan,
        math.copysign(1.0, fits.pitching.gain) if shown and fits.pitching is not None else math.nan,
    )
    return signs.check_signs(found, dive, rudder is Mistake.RUDDER_SIGN)


def with_dive(verdicts: list[Verdict], dive: list[Verdict]) -> list[Verdict]:
    """Return both in one list; a vehicle whose attitude or axes are turned has that cause alone.

    Args:
        verdicts: of the motion in the plane and the rudder.
        dive: of depth, attitude and stern planes.
    """
    first, pitch = dive[0], dive[1]
    if first.mistake is Mistake.ATTITUDE_TILTED:
        cause = first.mistake
        verdicts = [
            unknown(v.item, "the attitude comes first", f"without {cause.value}")
            if v.level is Level.FAIL and v.mistake in _OF_ATTITUDE
            else v
            for v in verdicts
        ]
    elif pitch.mistake is Mistake.AXES_OTHER_CONVENTION:
        turned = Mistake.RUDDER_SIGN
        verdicts = [v._replace(mistake=pitch.mistake) if v.mistake is turned else v for v in verdicts]
    return [*verdicts, *dive]


def at_the_surface(verdicts: list[Verdict]) -> list[Verdict]:
    """Return verdicts on a vehicle that stays at the surface: what fails there is not judged."""
    why = "the vehicle stays at the surface", "a start at 2 m of depth or more"
    return [unknown(v.item, *why) if v.level is Level.FAIL else v for v in verdicts]
