"""Fitted pieces: as few as it takes, and none for a curve with a kink."""

from __future__ import annotations

import numpy as np
import pytest

from auv_msgs_py.errors import ConfigurationError
from auv_path_following.paths.clothoid import Clothoid
from auv_path_following.paths.pieces import fitted_row
from auv_path_following.paths.polynomial import Polynomial
from auv_path_following.paths.rows import FITTED, FITTED_WIDTH
from auv_path_following.paths.segment import PathPoint


class Kinked:
    """Bends at t = 0.3."""

    kind = "kinked"
    length = 20.0

    def evaluate(self, t):
        bend = 10.0 * np.abs(t - 0.3)
        return PathPoint(10.0 * t, bend, 10.0 + 0.0 * t, 10.0 * np.sign(t - 0.3), 0.0 * t, 0.0 * t)

    def length_to_go(self, t):
        return self.length * (1.0 - t)

    def row(self):
        return fitted_row(self)


@pytest.mark.parametrize(
    ("segment", "most"),
    [
        (Polynomial([0.0, 30.0, 40.0, -20.0], [0.0, -10.0, 5.0, 60.0]), 1),
        (Clothoid(0.0, 0.0, 15.0, 0.3, 0.0, 1.0 / 15.0), 2),
        (Clothoid(0.0, 0.0, 40.0, 0.3, 0.0, 1.0 / 12.0), 3),
    ],
)
def test_few_pieces_are_enough(segment, most: int) -> None:
    kind, *numbers = fitted_row(segment)
    assert kind == FITTED
    assert len(numbers) <= most * FITTED_WIDTH
    assert len(numbers) % FITTED_WIDTH == 0


def test_a_kink_inside_a_segment_is_refused() -> None:
    with pytest.raises(ConfigurationError, match=r"kinked: found a kink at t = 0\.3"):
        fitted_row(Kinked())
