"""The kept figures of a mission: which of its parts are listed."""

from __future__ import annotations

import math

from auv_sim.flight.figures.mission_summary import CornerSummary, farthest


def test_the_farthest_parts_are_listed_in_the_order_of_the_path() -> None:
    distances = (0.1, math.nan, 3.0, 0.5, 2.0)
    corners = [CornerSummary(k + 1, 0.0, 0.0, distance) for k, distance in enumerate(distances)]
    assert [corner.joint for corner in farthest(corners, 3)] == [3, 4, 5]
    assert [corner.joint for corner in farthest(corners, 10)] == [1, 2, 3, 4, 5]
