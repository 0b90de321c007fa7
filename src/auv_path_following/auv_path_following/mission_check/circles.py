"""Judges whether circles of acceptance fit on their path, with a given or a computed radius."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from auv_msgs_py.values.types import Current
from auv_path_following.curves.joints import Joint
from auv_path_following.guidance.acceptance import acceptance_radius, corner_of, cornering_of
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.mission_check.finding import Finding, Level, at
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle

#: Circles of more look-aheads than this leave out too much of the path. One is the paper's bound; a little
#: more is useful in a current.
_FAR_TOO_WIDE = 2.0


def circles(
    mission: Mission,
    vehicle: Vehicle,
    switching: SwitchingConfig,
    lookahead: float,
    speed: float,
    current: Current,
) -> Iterator[Finding]:
    """Judge the circles of acceptance.

    Args:
        mission, vehicle: what is flown, and what flies it.
        switching: which joints, and Rk.
        lookahead: Delta of guidance, m.
        speed: through the water, m/s.
        current: m/s, NED.
    """
    if switching.mode == "off":
        return
    if switching.radius > 0.0:
        yield from _given_circles(mission, switching, lookahead)
    else:
        yield from _computed_circles(mission, vehicle, lookahead, speed, current)


def _computed_circles(
    mission: Mission, vehicle: Vehicle, lookahead: float, speed: float, current: Current
) -> Iterator[Finding]:
    """Find legs that are too short for the circles at their ends, whose radii follow from hull and corner.

    A circle may be wider than the look-ahead: a turn that needs more room begins earlier.
    """
    cornering = cornering_of(vehicle)
    short: list[tuple[float, float, Joint]] = []
    for joint in mission.path.joints[: mission.once + 1]:
        if joint.geometric == "G0":
            corner = corner_of(mission.path, joint.index - 1)
            whole = corner._replace(widest=math.inf)
            radius = acceptance_radius(cornering, whole, lookahead, speed, current)
            if radius > corner.widest:
                short.append((radius - corner.widest, radius, joint))
    if short:
        lacking, radius, joint = max(short, key=lambda item: item[0])
        found = f"legs with room for a circle of acceptance of {radius - lacking:.1f} m"
        if len(short) > 1:
            found += f" (likewise at {len(short) - 1} more)"
        place = f"joint {joint.index} {at(joint.x, joint.y)}"
        yield Finding(
            "warning",
            place,
            found,
            f"room for {radius:.1f} m, which this turn needs on half of the shorter leg",
        )


def _given_circles(mission: Mission, switching: SwitchingConfig, lookahead: float) -> Iterator[Finding]:
    # One joint more than the path has once: where it repeats itself, the next lap's first.
    joints = [
        j for j in mission.path.joints[: mission.once + 1] if switching.mode == "all" or j.geometric == "G0"
    ]
    if not joints:
        return
    if switching.radius > lookahead:
        found = f"{switching.radius:g} m with a look-ahead of {lookahead:g} m"
        level: Level = "refused" if switching.radius > _FAR_TOO_WIDE * lookahead else "warning"
        yield Finding(level, "switching.radius", found, "at most the look-ahead, Rk <= Delta of Eq. (44)")
    # Along the path: a circle counts on the last stretch of its subpath only, see `switching.reached`.
    gaps = -np.diff([mission.path.distance_to_go(j.index, 0.0) for j in joints])
    overlapping = np.flatnonzero(gaps < 2.0 * switching.radius)
    if overlapping.size:
        k = int(overlapping[np.argmin(gaps[overlapping])])
        one, other = joints[k], joints[k + 1]
        found = f"{gaps[k]:.1f} m apart with circles of acceptance of {switching.radius:g} m, which overlap"
        if overlapping.size > 1:
            found += f" (as do {overlapping.size - 1} more pairs)"
        yield Finding(
            "warning",
            f"joints {one.index} and {other.index}",
            found,
            "joints further apart, or smaller circles: these cut short the subpath between",
        )
