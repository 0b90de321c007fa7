"""Switching to the next subpath: the circle of acceptance, Eq. (44)."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, NamedTuple

from auv_msgs_py.settings.schema import Auto, setting, settings
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.curves.rows import (
    CHI_IN,
    CHI_OUT,
    CORNER,
    END,
    JOINT,
    JOINT_X,
    JOINT_Y,
    JOINT_Z,
    STRETCH,
    WIDEST,
)
from auv_path_following.curves.switching_modes import LISTED, MODES, OFF, ONLY_CORNERS, SwitchingMode
from auv_path_following.guidance.acceptance import Cornering, JointCorner, acceptance_radius, reach


@settings
class SwitchingConfig:
    """The circle of acceptance around a joint."""

    mode: SwitchingMode = setting("g0", f"joints with a circle of acceptance: {LISTED}", live=True)
    radius: Auto = setting(
        6.0,
        "radius Rk of the circles; 0 or auto: computed for each corner",
        unit="m",
        ge=0.0,
        le=1000.0,
        live=True,
    )
    turn_rate: float = setting(
        0.0,
        "yaw rate of turns, for a computed radius: the limit of the autopilot's reference; 0: from the hull",
        unit="rad/s",
        ge=0.0,
        le=10.0,
        live=True,
    )
    lead: float = setting(
        1.0,
        "lead time of these turns, for their limits of acceleration and jerk",
        unit="s",
        ge=0.0,
        le=600.0,
        live=True,
    )


def with_overrides(
    config: SwitchingConfig, mode: SwitchingMode | None, radius: float | None
) -> SwitchingConfig:
    """Return `config` with a mission's values; None leaves a value as it is."""
    return dataclasses.replace(
        config,
        mode=config.mode if mode is None else mode,
        radius=config.radius if radius is None else radius,
    )


class Circles(NamedTuple):
    """The circles of acceptance of a path.

    Attributes:
        mode: index in `MODES`.
        radius: Rk, m.
        computed: whether Rk is computed for each corner instead.
        cornering: turning ability, for a computed Rk.
        lookahead: Delta, m, for a computed Rk.
    """

    mode: int
    radius: float
    computed: bool
    cornering: Cornering
    lookahead: float


def circles_of(config: SwitchingConfig, cornering: Cornering | None, lookahead: float) -> Circles:
    """Return the circles of acceptance.

    Args:
        config: joints and Rk.
        cornering: turning ability, for an Rk of 0 where `config` has no rate; None: an Rk of 0 is no circle.
        lookahead: Delta, m.
    """
    if cornering is not None and config.turn_rate > 0.0:
        cornering = Cornering(float(config.turn_rate), float(config.lead))
    mode = MODES.index(config.mode)
    computed = cornering is not None and not config.radius > 0.0
    return Circles(mode, float(config.radius), computed, cornering or _NO_CORNERING, lookahead)


@pure
def radius_at(circles: Circles, row: Any, Ur: float, current: Current) -> float:
    """Return Rk at the end of a subpath, m.

    A smooth joint needs no circle: where Rk is computed it is 0 there.

    Args:
        circles: of the path.
        row: of the subpath.
        Ur: speed through the water, m/s.
        current: the estimate, m/s, NED.
    """
    if not circles.computed or row[JOINT] != CORNER:
        return circles.radius
    corner = JointCorner(row[CHI_IN], row[CHI_OUT], row[WIDEST])
    return acceptance_radius(circles.cornering, corner, circles.lookahead, Ur, current)


@pure
def reached(
    circles: Circles, row: Any, x: float, y: float, t: float, Ur: float = 0.0,
    current: Current = NO_CURRENT, z: float = 0.0,
) -> bool:  # fmt: skip
    """Return whether to follow the next subpath, Eq. (44), for subpaths of any length and shape.

    Only the last stretch of a subpath counts, because a subpath that returns to its start begins inside the
    circle at its end. At least half of a subpath shorter than the circle (between dense waypoints) is
    followed, so that P does not skip from one circle to the next.

    Args:
        circles: of the path.
        row: of the subpath.
        x, y: the vehicle's position, NED, m.
        t: place of P on the subpath.
        Ur: speed through the water, m/s.
        current: the estimate, m/s, NED.
        z: the vehicle's depth, m; 0 on a planar path.
    """
    if t < 0.5 or t < row[STRETCH]:
        return False
    mode, joint = circles.mode, row[JOINT]
    if mode == OFF or joint == END or (mode == ONLY_CORNERS and joint != CORNER):
        return False
    distance, above = math.hypot(row[JOINT_X] - x, row[JOINT_Y] - y), row[JOINT_Z] - z
    if above != 0.0:
        distance = math.hypot(distance, above)
    if circles.computed and distance > reach(circles.cornering, circles.lookahead, Ur, current):
        return False
    return distance <= radius_at(circles, row, Ur, current)


_NO_CORNERING = Cornering(1.0, 0.0)
