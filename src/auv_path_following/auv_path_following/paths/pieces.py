"""Any smooth curve as polynomial pieces, for kinds of segments that `rows` has no formula for."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev

from auv_msgs_py.errors import ConfigurationError
from auv_path_following.paths.rows import FITTED, TERMS
from auv_path_following.paths.segment import Segment

Array = npt.NDArray[np.float64]

#: Largest error of a piece, as a share of the largest value of the signal on the segment.
TOLERANCE = 1e-12
#: Degree to which the second derivative is fitted; the curve itself has two more.
DEGREE = TERMS - 3
_NARROWEST = 2.0**-20
_NODES = chebyshev.chebpts1(DEGREE + 1)
_CHECKS = np.linspace(-1.0, 1.0, 41)
#: What two integrations divide a power by.
_TWICE = (np.arange(DEGREE + 1.0) + 1.0) * (np.arange(DEGREE + 1.0) + 2.0)
#: Powers of u at the checks and both derivatives of them, shape (3, TERMS, checks).
_AT_CHECKS = np.stack(
    [[np.polynomial.Polynomial.basis(k).deriv(order)(_CHECKS) for k in range(TERMS)] for order in range(3)]
)
#: From values at the nodes to a Chebyshev series, and from that to powers: in one step digits are lost.
_SERIES = np.linalg.inv(chebyshev.chebvander(_NODES, DEGREE))
_TO_POWERS = np.stack(
    [np.pad(chebyshev.cheb2poly(row), (0, DEGREE + 1))[: DEGREE + 1] for row in np.eye(DEGREE + 1)], axis=1
)


def fitted_row(segment: Segment) -> list[float]:
    """Return a segment as FITTED and its pieces.

    The second derivative is fitted and integrated twice: this keeps two digits more than a fit of the curve
    that is differentiated. Pieces are halved until all six signals are within `TOLERANCE` of the segment's.

    Raises:
        ConfigurationError: the segment has a kink inside, so that no polynomial follows it.
    """
    grid = segment.evaluate(np.linspace(0.0, 1.0, 129))
    scale = np.array([np.max(np.abs(signal)) for signal in grid])
    # A derivative that is zero throughout comes with rounding of the size of the others.
    allowed = TOLERANCE * np.maximum(scale, 1e-3 * scale.max())[:, None]
    row = [FITTED]
    stack = [(0.0, 1.0)]
    while stack:
        a, b = stack.pop()
        middle, half = 0.5 * (a + b), 0.5 * (b - a)
        powers = _fit(segment, middle, half)
        signals = (powers @ _AT_CHECKS / half ** np.arange(3.0)[:, None, None]).reshape(6, -1)
        if np.all(np.abs(signals - np.array(segment.evaluate(middle + half * _CHECKS))) <= allowed):
            row += [a, 1.0 / half, *powers[:, ::-1].ravel().tolist()]
        elif b - a < _NARROWEST:
            raise ConfigurationError(segment.kind, f"a kink at t = {a:.6g}", "a curve that is smooth inside")
        else:
            stack += [(middle, b), (a, middle)]
    return row


def _fit(segment: Segment, middle: float, half: float) -> Array:
    """Return the coefficients of x and y in u = (t - middle) / half, shape (2, TERMS), lowest power first."""
    at_nodes, centre = segment.evaluate(middle + half * _NODES), segment.evaluate(middle)
    second = np.array([at_nodes.ddx, at_nodes.ddy]) * half * half
    powers = np.empty((2, TERMS))
    powers[:, 0] = centre.x, centre.y
    powers[:, 1] = centre.dx * half, centre.dy * half
    powers[:, 2:] = second @ _SERIES.T @ _TO_POWERS.T / _TWICE
    return powers
