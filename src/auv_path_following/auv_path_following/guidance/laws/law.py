"""Inputs and output of every guidance law: from the cross-track error to the desired heading."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.types import Current


class LawInputs(NamedTuple):
    """Inputs of a law.

    ye (m, starboard positive) and chi_p (rad) as in Eq. (20); Ur (m/s) and beta_r (rad) as in Eq. (17);
    the current (m/s, NED) as the observer estimates it, zero if it is not to be compensated.
    """

    ye: float
    chi_p: float
    Ur: float
    beta_r: float
    current: Current


class LawOutput(NamedTuple):
    """psi_d and its parts: psi_d = chi_p + chi_r - beta_r, Eq. (24), rad; alpha in m; theta_n is a ratio."""

    psi_d: float
    chi_r: float
    alpha: float
    theta_n: float


class NoState(NamedTuple):
    """State of a law without memory."""
