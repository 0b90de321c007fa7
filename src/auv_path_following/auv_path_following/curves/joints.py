"""Where two subpaths meet, and how smoothly: geometric and parametric continuity."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from auv_msgs_py.values.angles import wrap
from auv_path_following.curves.segment import PathPoint

#: Largest step of a continuous course (G1), rad.
ANGLE_TOLERANCE = 1e-3
#: Largest step of a continuous curvature (G2), 1/m: a radius of 10 km.
CURVATURE_TOLERANCE = 1e-4
#: Largest step of dp/ds (C1) and d2p/ds2 (C2), as a share of the larger |dp/ds| at the joint.
DERIVATIVE_TOLERANCE = 1e-3


@dataclass(frozen=True)
class Joint:
    """Where one subpath ends and the next one starts, and how smoothly.

    Attributes:
        index: number of the subpath that ends here, counted from 1 as the paper does.
        x, y: its position (start of the next subpath), NED, m.
        gap: distance between the end and the next start, m.
        chi_in, chi_out: courses before and after it, rad.
        angle_step: step of the course, rad in [-pi, pi), positive to starboard.
        curvature_step: step of the curvature, 1/m.
        geometric: G0 connected, G1 course continuous too, G2 curvature continuous too.
        parametric: C0 connected, C1 dp/ds continuous too, C2 d2p/ds2 continuous too.
    """

    index: int
    x: float
    y: float
    gap: float
    chi_in: float
    chi_out: float
    angle_step: float
    curvature_step: float
    geometric: Literal["G0", "G1", "G2"]
    parametric: Literal["C0", "C1", "C2"]


def joint_between(number: int, end: PathPoint, start: PathPoint) -> Joint:
    """Return the joint of two subpaths.

    Args:
        number: of the subpath before it, from 1.
        end: of the subpath before it.
        start: of the subpath after it.
    """
    chi_in, chi_out = end.chi, start.chi
    angle_step = wrap(chi_out - chi_in)
    curvature_step = start.kappa - end.kappa
    geometric: Literal["G0", "G1", "G2"] = "G0"
    if abs(angle_step) <= ANGLE_TOLERANCE:
        geometric = "G2" if abs(curvature_step) <= CURVATURE_TOLERANCE else "G1"
    allowed = DERIVATIVE_TOLERANCE * max(start.speed, end.speed)
    parametric: Literal["C0", "C1", "C2"] = "C0"
    if math.hypot(start.dx - end.dx, start.dy - end.dy) <= allowed:
        parametric = "C2" if math.hypot(start.ddx - end.ddx, start.ddy - end.ddy) <= allowed else "C1"
    return Joint(
        index=number,
        x=start.x,
        y=start.y,
        gap=math.hypot(start.x - end.x, start.y - end.y),
        chi_in=chi_in,
        chi_out=chi_out,
        angle_step=angle_step,
        curvature_step=curvature_step,
        geometric=geometric,
        parametric=parametric,
    )
