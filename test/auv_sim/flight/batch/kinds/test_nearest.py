"""Distances in three dimensions of compiled code against those that a track is measured by."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.fermat import FermatSpiral
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.depth_profile import DepthProfile, RampKind
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.batch.kinds.nearest import (
    LEVEL,
    RULE,
    SEARCHED,
    STRAIGHT,
    UNTRACKED,
    off_subpath,
    spatial_arrays_of,
    spatial_outlines_of,
)

LINE = Line(0.0, 0.0, 80.0, 0.5)
ARC = Arc(0.0, 15.0, 15.0, -1.0, 9.0)
SPIRAL = FermatSpiral(0.0, 0.0, 25.0, 1.4, 0.4, 1)


def over(segment: Segment, depths: tuple[float, float], kind: RampKind) -> SpatialPath:
    return SpatialPath([segment], DepthProfile([(0.0, depths[0]), (segment.length, depths[1])], kind))


PATHS = {
    "level line": (over(LINE, (7.0, 7.0), "linear"), LEVEL),
    "level arc": (over(ARC, (7.0, 7.0), "linear"), LEVEL),
    "slope": (over(LINE, (5.0, 30.0), "linear"), STRAIGHT),
    "smooth ramp": (over(LINE, (25.0, 5.0), "smooth"), SEARCHED),
    "helix": (over(ARC, (5.0, 40.0), "linear"), SEARCHED),
    "level spiral": (over(SPIRAL, (7.0, 7.0), "linear"), SEARCHED),
    "ramp over a spiral": (over(SPIRAL, (5.0, 12.0), "smooth"), SEARCHED),
}


@pytest.mark.parametrize("name", PATHS)
@pytest.mark.parametrize("away", [0.05, 3.0, 30.0])
def test_the_tracked_place_is_the_closest(name: str, away: float) -> None:
    """Along the path, past both ends, and as far off as its centre of curvature."""
    path, rule = PATHS[name]
    rows, outlines = spatial_arrays_of(path), spatial_outlines_of(path)
    assert outlines.rule[0, RULE] == rule
    t = np.linspace(0.0, 1.0, 300)
    p = path.sampled(0, t)
    turn = np.linspace(0.0, 9.0, 300)
    x, y = p.x + away * np.sin(turn), p.y + away * np.cos(1.3 * turn)
    z = p.z + 0.3 * away * np.sin(0.7 * turn)
    distance, depth = path.closest(x, y, z, np.zeros(300, int))
    nearest, last = UNTRACKED, (x[0], y[0], z[0])
    for k, place in enumerate(zip(x, y, z, strict=True)):
        nearest, off, below = off_subpath(rows, outlines, nearest, 0, *place, math.dist(place, last))
        assert off == pytest.approx(distance[k], abs=1e-9)
        if off < 5.0:  # from farther off two places may be as close as each other
            assert below == pytest.approx(z[k] - depth[k], abs=1e-8)
        last = place


def test_what_repeats_has_its_outline_once() -> None:
    once = PATHS["ramp over a spiral"][0].subpaths[0]
    lap = [once, once.reversed()]
    path = SpatialPath(lap * 3)
    outlines = spatial_outlines_of(path)
    assert len(outlines.point) == sum(len(spatial_outlines_of(SpatialPath([part])).point) for part in lap)
    assert outlines.span[0].tolist() == outlines.span[4].tolist() != outlines.span[1].tolist()
