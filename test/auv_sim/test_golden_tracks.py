"""`closed_loop` flies as it did when the golden tracks were recorded; `golden_tracks.py` renews them."""

from __future__ import annotations

import numpy as np
import pytest

from golden_flights import FLIGHTS
from golden_tracks import FILE, TOLERANCE, difference, fly, stored


def test_every_flight_is_recorded_and_nothing_else() -> None:
    assert stored().keys() == FLIGHTS.keys()
    assert len(FLIGHTS) == 60
    assert FILE.stat().st_size < 500_000


@pytest.mark.parametrize("name", FLIGHTS)
def test_the_track_is_the_recorded_one(name: str) -> None:
    largest, text = difference(fly(FLIGHTS[name]), stored()[name])
    assert largest <= TOLERANCE, f"{name}: {text}"


def test_a_difference_is_found_and_named() -> None:
    golden = stored()["line and arc, paper"]
    rows = golden.copy()
    assert difference(rows, golden)[0] == 0.0
    rows[7:, 2] += 2e-9
    largest, text = difference(rows, golden)
    assert largest == pytest.approx(2e-9, rel=1e-3)
    assert text.startswith("y differs by 2e-09 at ")
    assert text.endswith("more than 1e-09 from 7.00 s on")
    assert difference(rows[:-3], golden)[0] == np.inf
    rows[20, 4] = np.nan
    assert difference(rows, golden)[1].startswith("rudder differs by inf at 20.00 s")
