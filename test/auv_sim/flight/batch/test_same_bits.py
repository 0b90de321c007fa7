"""Compiled arithmetic has the last bits of Python's."""

from __future__ import annotations

import math
import random

import pytest

from auv_msgs_py.values.pure import modulus, squared
from auv_sim.flight.batch import same_bits
from auv_sim.flight.batch.compiled import COMPILED, compiled


@compiled
def all_three(x: float, y: float) -> tuple[float, float, float]:
    return math.hypot(x, y), squared(x), modulus(complex(x, y))


def test_the_length_is_that_of_python() -> None:
    dice = random.Random(1)
    for _ in range(20_000):
        x, y = dice.gauss(0.0, 1.0), dice.gauss(0.0, 10.0 ** dice.uniform(-6.0, 6.0))
        assert same_bits.hypot(x, y) == math.hypot(x, y)


@pytest.mark.skipif(not COMPILED, reason="needs Numba")
def test_compiled_code_rounds_as_python_does() -> None:
    dice = random.Random(2)
    others = 0
    for _ in range(20_000):
        x, y = dice.gauss(0.0, 3.0), dice.gauss(0.0, 1.0)
        assert all_three(x, y) == (math.hypot(x, y), x**2, abs(complex(x, y)))
        others += math.hypot(x, y) != abs(complex(x, y)) or x**2 != x * x
    assert others > 10  # it does make a difference


@pytest.mark.parametrize("pair", [(0.0, 0.0), (-0.0, 0.0), (1e200, 1e200), (1e-200, 0.0), (math.inf, 1.0)])
def test_the_ends_of_the_range_are_finite_where_they_can_be(pair: tuple[float, float]) -> None:
    assert same_bits.hypot(*pair) == pytest.approx(math.hypot(*pair), rel=1e-12)
    assert math.isnan(same_bits.hypot(math.nan, 1.0))
