"""Fitted pieces: as few as it takes, and none for a curve with a kink."""

from __future__ import annotations

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.clothoid import Clothoid
from auv_path_following.curves.kinds.polynomial import Polynomial
from auv_path_following.curves.pieces import fitted_row
from auv_path_following.curves.rows import FITTED, FITTED_WIDTH, evaluate
from auv_path_following.curves.segment import PathPoint


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
    with pytest.raises(ConfigurationError, match=r"kinked: found a kink, or terms that cancel, at t = 0\.3"):
        fitted_row(Kinked())


def high(degree: int, seed: int) -> Polynomial:
    """A curve about 100 m long; its coefficients are many thousand times as large."""
    generator = np.random.default_rng(seed)

    def axis() -> list[float]:
        terms = generator.normal(0.0, 4.0, degree - 1) / np.arange(1, degree) ** 2
        series = np.polynomial.Chebyshev([0.0, 50.0, *terms], [0.0, 1.0])
        return [float(x) for x in series.convert(kind=np.polynomial.Polynomial).coef]

    return Polynomial(axis(), axis())


@pytest.mark.parametrize("degree", [8, 10, 14])
def test_a_high_polynomial_whose_terms_cancel_is_followed(degree: int) -> None:
    for seed in range(5):
        curve = high(degree, seed)
        path = CompositePath([curve])
        for t in np.linspace(0.0, 1.0, 101):
            point, expected = evaluate(path.rows, path.rows.subpath[0], float(t)), curve.evaluate(float(t))
            assert point[:2] == pytest.approx(expected[:2], abs=1e-4)


def test_one_of_which_rounding_leaves_nothing_is_refused_where_it_is_made() -> None:
    with pytest.raises(
        ConfigurationError, match=r"polynomial: found a kink, or terms that cancel, at t = 0\."
    ):
        high(25, 0)
