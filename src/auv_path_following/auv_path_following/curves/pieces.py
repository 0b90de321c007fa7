"""Any smooth curve as polynomial pieces, for kinds of segments without a formula in `rows`."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.rows import FITTED, TERMS
from auv_path_following.curves.segment import Segment

Array = npt.NDArray[np.float64]

#: Largest error of a piece, as a share of the largest value of the signal on the segment.
TOLERANCE = 1e-12
#: Degree to which the second derivative is fitted; the curve itself has two more.
DEGREE = TERMS - 3
#: Allowed share where halving no longer helps, because the segment's own rounding is larger.
ROUNDING = 1e-6
_NARROWEST = 2.0**-20
_NODES = chebyshev.chebpts1(DEGREE + 1)
_CHECKS = np.linspace(-1.0, 1.0, 41)
#: Where a piece is sampled: the nodes of the fit, its middle, and the checks.
_SAMPLES = np.concatenate((_NODES, [0.0], _CHECKS))
#: Divisors of two integrations of a power.
_TWICE = (np.arange(DEGREE + 1.0) + 1.0) * (np.arange(DEGREE + 1.0) + 2.0)
_K = np.arange(TERMS)[:, None]
#: Powers of u at the checks and both derivatives of them, shape (3, TERMS, checks).
_AT_CHECKS = np.stack(
    [
        _CHECKS**_K,
        _K * _CHECKS ** np.maximum(_K - 1, 0),
        _K * (_K - 1) * _CHECKS ** np.maximum(_K - 2, 0),
    ]
)
#: From values at the nodes to a Chebyshev series, and from that to powers: in one step digits are lost.
_SERIES = np.linalg.inv(chebyshev.chebvander(_NODES, DEGREE))
_TO_POWERS = np.stack(
    [np.pad(chebyshev.cheb2poly(row), (0, DEGREE + 1))[: DEGREE + 1] for row in np.eye(DEGREE + 1)], axis=1
)


def fitted_row(segment: Segment) -> list[float]:
    """Return a segment as FITTED and its pieces.

    The second derivative is fitted and integrated twice: this keeps two digits more than a fit of the curve
    that is differentiated. Pieces are halved until all six signals are within `TOLERANCE` of the segment's,
    or within `ROUNDING` where halving no longer helps: terms of a high polynomial cancel, and the rest of
    their digits is noise.

    Raises:
        ConfigurationError: the segment has a kink inside, or noise beyond `ROUNDING`.
    """
    scale = np.abs(_sampled(segment, 0.5, 0.5)).max(axis=1)
    # A derivative that is zero throughout comes with rounding of the size of the others.
    allowed = TOLERANCE * np.maximum(scale, 1e-3 * scale.max())[:, None]
    row = [FITTED]
    stack = [(0.0, 1.0, np.inf)]
    while stack:
        a, b, before = stack.pop()
        middle, half = 0.5 * (a + b), 0.5 * (b - a)
        samples = _sampled(segment, middle, half)
        powers = _fit(samples, half)
        signals = (powers @ _AT_CHECKS / half ** np.arange(3.0)[:, None, None]).reshape(6, -1)
        error = float(np.max(np.abs(signals - samples[:, DEGREE + 2 :]) / allowed))
        is_noise = 0.25 * before < error <= ROUNDING / TOLERANCE
        if error <= 1.0 or is_noise:
            row += [a, 1.0 / half, *powers[:, ::-1].ravel().tolist()]
        elif b - a < _NARROWEST:
            found = f"a kink, or terms that cancel, at t = {a:.6g}"
            raise ConfigurationError(segment.kind, found, "a curve that is smooth inside")
        else:
            stack += [(middle, b, error), (a, middle, error)]
    return row


def _sampled(segment: Segment, middle: float, half: float) -> Array:
    """Return the six signals of a `PathPoint` at `_SAMPLES`, shape (6, samples)."""
    return np.array(segment.evaluate(middle + half * _SAMPLES))


def _fit(samples: Array, half: float) -> Array:
    """Return the coefficients of x and y in u = (t - middle) / half, shape (2, TERMS), lowest power first."""
    at_nodes, centre = samples[4:, : DEGREE + 1], samples[:, DEGREE + 1]
    powers = np.empty((2, TERMS))
    powers[:, 0] = centre[:2]
    powers[:, 1] = centre[2:4] * half
    powers[:, 2:] = at_nodes * half * half @ _SERIES.T @ _TO_POWERS.T / _TWICE
    return powers
