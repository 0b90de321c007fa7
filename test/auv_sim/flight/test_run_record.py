from __future__ import annotations

import numpy as np
import pytest

from auv_sim.flight.run_record import Run


def test_missing_columns_are_nan_and_lists_will_do() -> None:
    run = Run.from_columns({"t": [1, 2], "x": [0.0, 1.0], "y": (0.0, 0.0), "psi": np.zeros(2)})
    assert run.steps == 2
    assert run.t.dtype == np.float64
    assert np.isnan(run.Vx_true).all()
    assert run.Vx_true.shape == (2,)


@pytest.mark.parametrize(
    ("columns", "says"),
    [
        ({"t": [1.0], "x": [0.0], "y": [0.0]}, "missing columns psi"),
        ({"t": [1.0], "x": [0.0], "y": [0.0], "psi": [0.0], "speed": [0.0]}, "unknown columns speed"),
        ({"t": [1.0], "x": [0.0, 1.0], "y": [0.0], "psi": [0.0]}, "another shape"),
    ],
)
def test_wrong_columns_are_refused(columns: dict[str, list[float]], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        Run.from_columns(columns)


def test_the_active_subpath_follows_s() -> None:
    s = [np.nan, 0.0, 0.99, 1.0, 1.5, 2.0, 2.0]
    zeros = np.zeros(len(s))
    run = Run.from_columns({"t": np.arange(len(s)), "x": zeros, "y": zeros, "psi": zeros, "s": s})
    assert list(run.subpath(2)) == [-1, 0, 0, 1, 1, 1, 1]
    assert list(run.select(run.s > 1.0).t) == [4, 5, 6]
