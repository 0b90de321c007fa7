"""Segments of every kind, turns to either side, and some followed from their end to their start."""

from __future__ import annotations

import math

from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.archimedean import ArchimedeanSpiral
from auv_path_following.curves.kinds.clothoid import Clothoid
from auv_path_following.curves.kinds.fermat import FermatSpiral, MirroredFermatSpiral
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.polynomial import Polynomial
from auv_path_following.curves.kinds.reverse import Reversed
from auv_path_following.curves.kinds.spline import Spline

POINTS = [(0.0, 0.0), (60.0, 5.0), (80.0, 70.0), (10.0, 90.0), (-40.0, 30.0)]
SEGMENTS = [
    Line(3.0, -4.0, 50.0, 2.0),
    Arc(10.0, 20.0, 15.0, -1.0, 3.5),
    Arc(10.0, 20.0, 15.0, 3.5, -1.0),
    Arc(-5.0, 0.0, 40.0, 0.3, 0.3 + 2.0 * math.pi),
    FermatSpiral(-20.0, 265.0, 118.0, 0.1329, -1.57, 1),
    FermatSpiral(0.0, 0.0, 12.0, 2.5, 0.4, -1),
    MirroredFermatSpiral(12.0, 188.0, 118.0, 0.1329, -0.785, 1),
    Clothoid(0.0, 0.0, 40.0, 0.3, 0.0, 1.0 / 12.0),
    Clothoid(0.0, 0.0, 40.0, 0.3, -0.05, -0.05),
    ArchimedeanSpiral(0.0, 0.0, 12.0, 72.0, 0.0, 8.0 * math.pi),
    Polynomial([0.0, 30.0, 40.0, -20.0], [0.0, -10.0, 5.0, 60.0]),
    Spline(POINTS),
    Spline(POINTS, chi_start=1.0, chi_end=-2.0),
    Reversed(Spline(POINTS)),
    Reversed(Arc(10.0, 20.0, 15.0, -1.0, 3.5)),
]
IDS = [f"{number}-{segment.kind}" for number, segment in enumerate(SEGMENTS)]
