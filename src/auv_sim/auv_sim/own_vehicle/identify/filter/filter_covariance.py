"""Covariances of a filter's states: of motion, and of two slow errors, those of the thrust and of the fin.

In a dive the two errors are those of the measured surge and pitch.

Written flat, for compiled code and for arrays of many sets. Of three states of motion `p` is the upper
triangle of the covariance, row after row. `a` are nine numbers: covariances of the states with the thrust's
error, its variance, covariances with the fin's error, that of both errors, and the variance of the fin's.
"""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.pure import pure


@pure
def transition(a: tuple[Any, ...], h: Any) -> tuple[Any, ...]:
    """Return I + h A + h^2 A^2 / 2 of a 3 x 3 matrix A, both row after row."""
    a0, a1, a2, a3, a4, a5, a6, a7, a8 = a
    g = 0.5 * h * h
    return (
        1.0 + h * a0 + g * (a0 * a0 + a1 * a3 + a2 * a6),
        h * a1 + g * (a0 * a1 + a1 * a4 + a2 * a7),
        h * a2 + g * (a0 * a2 + a1 * a5 + a2 * a8),
        h * a3 + g * (a3 * a0 + a4 * a3 + a5 * a6),
        1.0 + h * a4 + g * (a3 * a1 + a4 * a4 + a5 * a7),
        h * a5 + g * (a3 * a2 + a4 * a5 + a5 * a8),
        h * a6 + g * (a6 * a0 + a7 * a3 + a8 * a6),
        h * a7 + g * (a6 * a1 + a7 * a4 + a8 * a7),
        1.0 + h * a8 + g * (a6 * a2 + a7 * a5 + a8 * a8),
    )


@pure
def spread(p: tuple[Any, ...], f: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return F P F' of a covariance, given and returned as its upper triangle, row after row."""
    p00, p01, p02, p11, p12, p22 = p
    f0, f1, f2, f3, f4, f5, f6, f7, f8 = f
    b0, b1, b2 = (
        f0 * p00 + f1 * p01 + f2 * p02,
        f0 * p01 + f1 * p11 + f2 * p12,
        f0 * p02 + f1 * p12 + f2 * p22,
    )
    b3, b4, b5 = (
        f3 * p00 + f4 * p01 + f5 * p02,
        f3 * p01 + f4 * p11 + f5 * p12,
        f3 * p02 + f4 * p12 + f5 * p22,
    )
    b6, b7, b8 = (
        f6 * p00 + f7 * p01 + f8 * p02,
        f6 * p01 + f7 * p11 + f8 * p12,
        f6 * p02 + f7 * p12 + f8 * p22,
    )
    return (
        b0 * f0 + b1 * f1 + b2 * f2,
        b0 * f3 + b1 * f4 + b2 * f5,
        b0 * f6 + b1 * f7 + b2 * f8,
        b3 * f3 + b4 * f4 + b5 * f5,
        b3 * f6 + b4 * f7 + b5 * f8,
        b6 * f6 + b7 * f7 + b8 * f8,
    )


@pure
def corrected(p: Any, a: Any, x: Any, row: Any, noise: Any, innovation: Any) -> Any:
    """Return covariances and state after one measured number.

    Args:
        p, a: covariances.
        x: three states of motion, the thrust's error (a share) and the fin's (rad).
        row: covariances of the measured state with all of `x`.
        noise: variance of the innovation.
        innovation: measured minus predicted.
    """
    m0, m1, m2, m3, m4 = row
    k0, k1, k2, k3, k4 = m0 / noise, m1 / noise, m2 / noise, m3 / noise, m4 / noise
    p00, p01, p02, p11, p12, p22 = p
    q0, q1, q2, w, s0, s1, s2, y, e = a
    return (
        (p00 - k0 * m0, p01 - k0 * m1, p02 - k0 * m2, p11 - k1 * m1, p12 - k1 * m2, p22 - k2 * m2),
        (
            q0 - k0 * m3, q1 - k1 * m3, q2 - k2 * m3, w - k3 * m3,
            s0 - k0 * m4, s1 - k1 * m4, s2 - k2 * m4, y - k3 * m4, e - k4 * m4,
        ),
        (
            x[0] + k0 * innovation, x[1] + k1 * innovation, x[2] + k2 * innovation,
            x[3] + k3 * innovation, x[4] + k4 * innovation,
        ),
    )  # fmt: skip


@pure
def carried_covariance(p: Any, a: Any, f: Any, gains: Any, kept: Any, held: Any, growth: Any) -> Any:
    """Return covariances after one step.

    Args:
        p, a: covariances.
        f: transition of the states of motion, nine numbers.
        gains: change of the three states by the first error, then by the fin's.
        kept, held: shares of the first and the fin's error that are left.
        growth: of the variances of the three states, and variances of the two errors.
    """
    g0, g1, g2, d0, d1, d2 = gains
    q0, q1, q2, w, s0, s1, s2, y, e = a
    a0, a1 = f[0] * q0 + f[1] * q1 + f[2] * q2, f[3] * q0 + f[4] * q1 + f[5] * q2
    a2 = f[6] * q0 + f[7] * q1 + f[8] * q2
    b0, b1 = f[0] * s0 + f[1] * s1 + f[2] * s2, f[3] * s0 + f[4] * s1 + f[5] * s2
    b2 = f[6] * s0 + f[7] * s1 + f[8] * s2
    p00, p01, p02, p11, p12, p22 = spread(p, f)
    # Half of what both errors add to themselves: each product below has it twice.
    m0, m1, m2 = a0 + 0.5 * (g0 * w + d0 * y), a1 + 0.5 * (g1 * w + d1 * y), a2 + 0.5 * (g2 * w + d2 * y)
    n0, n1, n2 = b0 + 0.5 * (g0 * y + d0 * e), b1 + 0.5 * (g1 * y + d1 * e), b2 + 0.5 * (g2 * y + d2 * e)
    return (
        (
            p00 + 2.0 * (g0 * m0 + d0 * n0) + growth[0],
            p01 + g0 * m1 + g1 * m0 + d0 * n1 + d1 * n0,
            p02 + g0 * m2 + g2 * m0 + d0 * n2 + d2 * n0,
            p11 + 2.0 * (g1 * m1 + d1 * n1) + growth[1],
            p12 + g1 * m2 + g2 * m1 + d1 * n2 + d2 * n1,
            p22 + 2.0 * (g2 * m2 + d2 * n2) + growth[2],
        ),
        (
            kept * (a0 + g0 * w + d0 * y), kept * (a1 + g1 * w + d1 * y), kept * (a2 + g2 * w + d2 * y),
            kept * kept * w + (1.0 - kept * kept) * growth[3],
            held * (b0 + g0 * y + d0 * e), held * (b1 + g1 * y + d1 * e), held * (b2 + g2 * y + d2 * e),
            kept * held * y, held * held * e + (1.0 - held * held) * growth[4],
        ),
    )  # fmt: skip
