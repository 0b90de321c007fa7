"""The protocol of every subpath: a smooth curve over t in [0, 1]."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

from auv_msgs_py.values.elementary import functions_of


class PathPoint(NamedTuple):
    """A point of a path, Eq. (3), with its derivatives with respect to t (equally: to s), Eq. (5).

    NED, metres; t has no unit, so the derivatives are metres too. All fields are floats, or arrays of
    one shape when the curve was evaluated for an array.
    """

    x: float
    y: float
    dx: float
    dy: float
    ddx: float
    ddy: float

    @property
    def speed(self) -> float:
        """|dp/dt|, Eq. (4): metres of path per unit of t, the factor between U_P and ds/dt in Eq. (6)."""
        return functions_of(self.dx).hypot(self.dx, self.dy)  # type: ignore[no-any-return]

    @property
    def chi(self) -> float:
        """Course chi_p, Eq. (7), rad clockwise from north, in (-pi, pi]."""
        return functions_of(self.dx).atan2(self.dy, self.dx)  # type: ignore[no-any-return]

    @property
    def kappa(self) -> float:
        """Curvature, Eq. (8), 1/m, positive where the path turns to starboard."""
        squared = self.dx * self.dx + self.dy * self.dy
        root = functions_of(squared).sqrt(squared)
        return (self.dx * self.ddy - self.dy * self.ddx) / (squared * root)  # type: ignore[no-any-return]


class Segment(Protocol):
    """One subpath. Immutable; safe to share between threads."""

    @property
    def kind(self) -> str:
        """Its name in a mission file."""

    @property
    def length(self) -> float:
        """Length of the whole segment, m."""

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t.

        Args:
            t: float or array of floats in [0, 1]; not checked; the formulas extend beyond.
        """

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end of the segment, m."""

    def row(self) -> list[float]:
        """Return its kind and its numbers, as `rows.evaluate` reads them.

        `pieces.fitted_row` makes them for a kind that has no formula there.
        """
