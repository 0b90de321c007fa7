"""A part of a segment is that stretch of it, and so is its row."""

from __future__ import annotations

import numpy as np
import pytest

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.rows import evaluate
from auv_path_following.curves.spatial.part import Part
from one_of_each import IDS, SEGMENTS


@pytest.mark.parametrize("segment", SEGMENTS, ids=IDS)
def test_a_part_is_that_stretch_of_the_whole(segment) -> None:
    part = Part(segment, 0.2, 0.65)
    for t in (0.0, 0.3, 1.0):
        whole, own = segment.evaluate(0.2 + 0.45 * t), part.evaluate(t)
        assert (own.x, own.y) == pytest.approx((whole.x, whole.y), abs=1e-12)
        assert own.chi == pytest.approx(whole.chi, abs=1e-12)
        assert own.kappa == pytest.approx(whole.kappa, rel=1e-9, abs=1e-12)
        rest = segment.length_to_go(0.2 + 0.45 * t) - segment.length_to_go(0.65)
        assert part.length_to_go(t) == pytest.approx(rest, abs=1e-9)
    speeds = part.evaluate(np.linspace(0.0, 1.0, 20_001)).speed
    assert part.length == pytest.approx(np.trapezoid(speeds, dx=1.0 / 20_000), rel=1e-7)


@pytest.mark.parametrize("segment", SEGMENTS, ids=IDS)
def test_its_row_is_the_part(segment) -> None:
    part = Part(segment, 0.2, 0.65)
    rows = CompositePath([part]).rows
    for t in np.linspace(0.0, 1.0, 37):
        own = part.evaluate(float(t))
        scale = max(map(abs, own))
        assert evaluate(rows, rows.subpath[0], float(t)) == pytest.approx(own, abs=1e-10 * scale)
