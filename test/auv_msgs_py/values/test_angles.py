"""The one wrap."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.angles import TWO_PI, wrap


@pytest.mark.parametrize(
    ("angle", "expected"),
    [
        (0.0, 0.0),
        (math.pi, -math.pi),  # half open: the port side owns the seam
        (-math.pi, -math.pi),
        (1.5 * math.pi, -0.5 * math.pi),
        (-1.5 * math.pi, 0.5 * math.pi),
        (7.0 * math.pi, -math.pi),
        (4.0 * math.pi + 0.25, 0.25),
    ],
)
def test_known_angles(angle, expected):
    assert wrap(angle) == pytest.approx(expected, abs=1e-14)


@given(st.floats(-1e4, 1e4))
def test_it_is_the_same_angle_within_one_turn(angle):
    wrapped = wrap(angle)
    assert -math.pi <= wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle), abs=1e-11)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle), abs=1e-11)


@given(st.floats(-3.1, 3.1), st.integers(-50, 50))
def test_whole_turns_change_nothing(angle, turns):
    assert wrap(angle + turns * TWO_PI) == pytest.approx(angle, abs=1e-12)


def test_an_array_gives_what_the_numbers_give():
    angles = np.linspace(-20.0, 20.0, 401)
    assert wrap(angles).tolist() == [wrap(float(angle)) for angle in angles]


def test_what_is_no_angle_stays_none():
    assert math.isnan(wrap(math.nan))
    assert math.isnan(wrap(math.inf))
