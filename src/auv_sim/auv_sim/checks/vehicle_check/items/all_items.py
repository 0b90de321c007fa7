"""All checks, in the order of the report."""

from __future__ import annotations

import numpy as np

from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.discovered import check_graph
from auv_sim.checks.vehicle_check.items.dive.dive_items import at_the_surface, check_dive, with_dive
from auv_sim.checks.vehicle_check.items.dive.dive_motion import (
    dive_motion_of,
    is_upright,
    levelled_water,
    stays_afloat,
)
from auv_sim.checks.vehicle_check.items.dive.presence import with_sound_rate
from auv_sim.checks.vehicle_check.items.kinematics import check_kinematics
from auv_sim.checks.vehicle_check.items.response import ITEMS, check_response
from auv_sim.checks.vehicle_check.items.timing import check_timing
from auv_sim.checks.vehicle_check.items.values import check_values
from auv_sim.checks.vehicle_check.samples import Recording, motion_of
from auv_sim.checks.vehicle_check.verdict import Level, Mistake, Verdict, unknown

#: Where the yaw rate cannot be used, the change of yaw can.
_RATES = {Mistake.YAW_RATE_SIGN, Mistake.YAW_RATE_DEGREES, Mistake.YAW_RATE_WRONG}


def check(recording: Recording, vehicle: Vehicle) -> list[Verdict]:
    """Judge a recording.

    Args:
        recording: the samples.
        vehicle: the vehicle's file, for rudder and thrust.
    """
    dive = dive_motion_of(recording) if vehicle.dives else None
    if dive is None or not is_upright(dive):
        heard, motion = recording, motion_of(recording.odom)
    else:
        heard, motion = levelled_water(recording, dive), with_sound_rate(dive).planar
    graph, kinematics = check_graph(recording, vehicle.dives), check_kinematics(heard, motion)
    deaf = [verdict for verdict in graph if verdict.level is Level.FAIL and verdict.item.endswith("listener")]
    if deaf:
        response = [unknown(item, "the commands are not heard", deaf[0].expected) for item in ITEMS]
    else:
        if mistakes(kinematics) & _RATES:
            motion = motion._replace(r=np.gradient(motion.yaw, motion.t))
        response = check_response(heard, motion, vehicle)
    values, timing = check_values(recording, motion, vehicle.dives), check_timing(recording)
    verdicts = [*graph, *values, *timing, *kinematics, *response]
    if dive is not None:
        below = check_dive(recording, dive, vehicle, response[0].mistake)
        if stays_afloat(dive):
            kinematics, response, below = map(at_the_surface, (kinematics, response, below))
            verdicts = [*graph, *values, *timing, *kinematics, *response]
        verdicts = with_dive(verdicts, below)
    if recording.wiggled and not mistakes(verdicts):  # otherwise it follows from what failed
        left = Mistake.NOT_JUDGED
        verdicts = [v._replace(mistake=left) if v.level is Level.UNKNOWN else v for v in verdicts]
    return verdicts


def mistakes(verdicts: list[Verdict]) -> set[Mistake]:
    """Return the causes of what does not pass; none: fit for a mission."""
    levels = (Level.FAIL, Level.UNKNOWN)
    return {v.mistake for v in verdicts if v.level in levels and v.mistake is not None}
