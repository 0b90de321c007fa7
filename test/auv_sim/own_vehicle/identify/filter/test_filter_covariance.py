"""Covariances of motion, a first error and the fin's against dense matrices of all five states."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from auv_sim.own_vehicle.identify.filter.filter_covariance import carried_covariance, corrected

_ROOT = np.random.default_rng(2).normal(size=(5, 5))
#: Covariance of three states of motion, of a first error and of the fin's.
DENSE = _ROOT @ _ROOT.T


def flat(P: Any) -> tuple[Any, Any]:
    """Return the numbers of a dense covariance as the filter keeps them."""
    return tuple(P[:3, :3][np.triu_indices(3)]), (*P[:3, 3], P[3, 3], *P[:3, 4], P[3, 4], P[4, 4])


def dense(p: Any, a: Any) -> Any:
    P = np.zeros((5, 5))
    P[:3, :3][np.triu_indices(3)] = p
    P[:3, 3], P[3, 3], P[:3, 4], P[3, 4], P[4, 4] = a[:3], a[3], a[4:7], a[7], a[8]
    return P + np.triu(P, 1).T


def test_a_step_is_that_of_the_matrices_of_all_states() -> None:
    f, gains = np.random.default_rng(3).normal(size=(3, 3)), (0.3, 0.4, -0.6, 0.5, -0.2, 0.7)
    kept, held, growth = 0.9, 0.8, (0.01, 0.02, 0.03, 0.4, 0.5)
    F = np.zeros((5, 5))
    F[:3, :3], F[:3, 3], F[:3, 4], F[3, 3], F[4, 4] = f, gains[:3], gains[3:], kept, held
    shaken = np.diag([*growth[:3], (1.0 - kept**2) * growth[3], (1.0 - held**2) * growth[4]])
    found = carried_covariance(*flat(DENSE), tuple(f.ravel()), gains, kept, held, growth)
    assert dense(*found) == pytest.approx(F @ DENSE @ F.T + shaken)


@pytest.mark.parametrize("state", [0, 1, 2])
def test_a_measurement_is_that_of_the_matrices_of_all_states(state: int) -> None:
    x, noise, innovation = np.arange(5.0), DENSE[state, state] + 0.3, 0.25
    gain = DENSE[:, state] / noise
    p, a, moved = corrected(*flat(DENSE), tuple(x), tuple(DENSE[state]), noise, innovation)
    assert dense(p, a) == pytest.approx(DENSE - np.outer(gain, DENSE[state]))
    assert moved == pytest.approx(x + gain * innovation)
