"""Distances of compiled code against those that a track is measured by."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following.curves.closest import closest_distance
from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.batch.distance import distance_to, outlines_of, rows_of
from one_of_each import IDS, SEGMENTS

PATHS = [CompositePath([segment]) for segment in SEGMENTS]
KNOWN = [(rows_of(path), outlines_of(path)) for path in PATHS]


@pytest.mark.parametrize("number", range(len(SEGMENTS)), ids=IDS)
@settings(max_examples=40)
@given(t=st.floats(0.0, 1.0), away=st.floats(-60.0, 60.0), bearing=st.floats(0.0, 6.3))
def test_distances(number: int, t: float, away: float, bearing: float) -> None:
    segment = SEGMENTS[number]
    p = segment.evaluate(t)
    x, y = p.x + away * math.cos(bearing), p.y + away * math.sin(bearing)
    expected = closest_distance(segment, np.array([x]), np.array([y]))[0]
    assert distance_to(*KNOWN[number], 0, x, y) == pytest.approx(expected, abs=1e-9)


def test_a_lap_flown_again_has_its_outline_once() -> None:
    lap = next(segment for segment in SEGMENTS if segment.kind == "fermat")
    once, twice = outlines_of(CompositePath([lap])), outlines_of(CompositePath([lap, lap], tolerance=1e3))
    assert len(once.point) == len(twice.point) > 0
    assert twice.span.tolist() == once.span.tolist() * 2
