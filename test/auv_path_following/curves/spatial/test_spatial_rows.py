"""A path as numbers is the path: place, derivatives, lengths and joints."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.rows import AFTER, CORNER, JOINT, LENGTH, SMOOTH
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_rows import evaluate_spatial, spatial_rows
from auv_path_following.missions import mission_file

SEGMENTS = mission_file.load("paper_composite").path.segments
LENGTH_OF_PLAN = math.fsum(segment.length for segment in SEGMENTS)


def path_of(kind) -> SpatialPath:
    shares = [(0.0, 5.0), (0.15, 30.0), (0.3, 12.0), (0.5, 25.0), (0.85, 8.0), (1.0, 5.0)]
    return SpatialPath(SEGMENTS, DepthProfile([(s * LENGTH_OF_PLAN, z) for s, z in shares], kind))


@pytest.mark.parametrize("kind", ["smooth", "linear"])
def test_the_rows_are_the_path(kind) -> None:
    path = path_of(kind)
    rows = spatial_rows(path)
    for i in range(path.n):
        for t in np.linspace(0.0, 1.0, 21):
            expected = path.evaluate(i, float(t))
            found = evaluate_spatial(rows, i, float(t))
            assert found[:3] == pytest.approx(expected[:3], abs=1e-9)
            scale = max(map(abs, expected[3:]))
            assert found[3:] == pytest.approx(expected[3:], abs=1e-8 * scale)


def test_lengths_are_in_three_dimensions() -> None:
    arc = Arc(0.0, 0.0, 15.0, 0.0, 4.0 * math.pi)
    slope = math.tan(math.radians(10.0))
    helix = SpatialPath([arc], DepthProfile([(0.0, 5.0), (arc.length, 5.0 + slope * arc.length)], "linear"))
    rows = spatial_rows(helix)
    assert rows.plan.subpath[0][LENGTH] == pytest.approx(arc.length / math.cos(math.radians(10.0)))
    path = path_of("smooth")
    rows = spatial_rows(path)
    points = np.array([path.evaluate(2, float(t))[:3] for t in np.linspace(0.0, 1.0, 4001)])
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert rows.plan.subpath[2][LENGTH] == pytest.approx(chords, rel=1e-6)
    assert rows.plan.subpath[0][AFTER] == pytest.approx(sum(row[LENGTH] for row in rows.plan.subpath[1:]))


def test_a_vertical_corner_is_a_corner() -> None:
    path = path_of("linear")
    rows = spatial_rows(path)
    knots = {knot.depth for knot in path.knots[1:-1]}
    for joint, row in zip(path.joints, rows.plan.subpath, strict=False):
        if any(abs(joint.z - depth) < 1e-6 for depth in knots):
            assert row[JOINT] == CORNER
    smooth = [row[JOINT] for row in spatial_rows(path_of("smooth")).plan.subpath]
    assert SMOOTH in smooth
