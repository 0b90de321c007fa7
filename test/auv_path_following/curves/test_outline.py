"""Where a segment begins to lead to its end."""

from __future__ import annotations

import math

import pytest

from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.fermat import FermatSpiral
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.reverse import Reversed
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.curves.outline import last_stretch

HALF = math.pi


@pytest.mark.parametrize(
    "segment",
    [
        Line(3.0, -4.0, 0.01, 2.0),
        Line(3.0, -4.0, 5000.0, 2.0),
        Arc(80.0, 420.0, 100.0, 0.0, HALF),  # the paper's
        Reversed(Arc(0.0, 0.0, 5.0, 0.0, -HALF)),
        FermatSpiral(-20.0, 265.0434, 118.115, 0.1329, -math.pi / 2, 1),
        Spline([(0.0, 0.0), (40.0, 0.0), (60.0, 30.0)]),
    ],
)
def test_what_turns_by_half_a_turn_at_most_leads_to_its_end_from_the_start(segment):
    assert last_stretch(segment) == 0.0


@pytest.mark.parametrize("sweep", [1.5 * HALF, 2.0 * HALF, 3.0 * HALF, -2.0 * HALF, -6.0 * HALF])
def test_of_an_arc_it_is_the_last_half_turn(sweep):
    begins = last_stretch(Arc(7.0, 8.0, 25.0, 0.3, 0.3 + sweep))
    left = (1.0 - begins) * abs(sweep)
    assert HALF - abs(sweep) / 16.0 - 1e-9 <= left <= HALF + abs(sweep) / 16.0 + 1e-9


def test_a_spline_that_comes_back_is_still_going_away_at_first():
    there_and_back = Spline([(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0), (0.0, 0.0)])
    begins = last_stretch(there_and_back)
    assert 0.4 < begins < 0.95
    assert there_and_back.length_to_go(begins) < 0.6 * there_and_back.length
