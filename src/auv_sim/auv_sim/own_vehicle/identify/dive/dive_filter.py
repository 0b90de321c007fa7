"""Extended Kalman filter of heave and pitch: one-step prediction errors of a recording.

As `planar_filter`, compiled or for many sets of parameters at once.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from auv_msgs_py.values.pure import pure
from auv_sim.own_vehicle.identify.planar_filter import spread, transition


@pure
def dive_accelerations(c: Any, u: Any, w: Any, q: Any, cos: Any, sin: Any, delta: Any) -> tuple[Any, Any]:
    """Return (w', q') by Eqs. (3D-3), (3D-4), without the forces of sway, roll rate and yaw rate.

    Args:
        c: the numbers of a `DiveCombinations`.
        u, w, q: through the water, m/s, rad/s.
        cos, sin: cosine of the pitch times that of the roll, and sine of the pitch.
        delta: angle of the stern planes, rad.
    """
    ww, qq, uq, uw, uud = w * abs(w), q * abs(q), u * q, u * w, u * u * delta
    return (
        c[0] * ww + c[1] * qq + c[2] * uq + c[3] * uw + c[4] * uud + c[5] * cos + c[6] * sin,
        c[7] * ww + c[8] * qq + c[9] * uq + c[10] * uw + c[11] * uud + c[12] * cos + c[13] * sin,
    )


@pure
def dive_jacobian(c: Any, u: Any, w: Any, q: Any, cos: Any, sin: Any, level: Any) -> tuple[Any, ...]:
    """Return the derivatives of the rates of theta, w, q by themselves: nine numbers, row after row.

    Args:
        c, u, w, q, cos, sin: as for `dive_accelerations`.
        level: cosine of the roll.
    """
    aw, aq = 2.0 * abs(w), 2.0 * abs(q)
    zero = 0.0 * c[0]
    return (
        zero, zero, zero + level,
        c[6] * cos - c[5] * sin, c[0] * aw + c[3] * u, c[1] * aq + c[2] * u,
        c[13] * cos - c[12] * sin, c[7] * aw + c[10] * u, c[8] * aq + c[9] * u,
    )  # fmt: skip


@pure
def dive_rates(c: Any, given: Any, theta: Any, w: Any, q: Any, delta: Any) -> tuple[Any, Any, Any]:
    """Return the rates of theta, w and q.

    The centre of gravity below that of buoyancy makes the hull a pendulum: it feels the acceleration ahead as
    it feels the pitch.

    Args:
        c: the numbers of a `DiveCombinations`.
        given: surge (m/s), cosine of the roll, yaw rate times sine of the roll (rad/s), acceleration ahead
            over that of gravity, and heave and pitch accelerations by the roll rate (m/s^2, rad/s^2).
        theta, w, q: rad, m/s, rad/s.
        delta: angle of the planes, rad.
    """
    sin = np.sin(theta) + given[3]
    dw, dq = dive_accelerations(c, given[0], w, q, given[1] * np.cos(theta), sin, delta)
    return given[1] * q - given[2], dw + given[4], dq + given[5]


@pure
def dive_advance(c: Any, given: Any, x: Any, delta: Any, change: Any, h: Any) -> tuple[Any, Any, Any]:
    """Return (theta, w, q) after `h` seconds: one Runge-Kutta step.

    Args:
        c, given: as for `dive_rates`.
        x: theta, w, q before, rad, m/s, rad/s.
        delta, change: mean angle of the planes in the step, and its change, rad.
        h: s.
    """
    theta, w, q = x
    half, sixth = 0.5 * h, h / 6.0
    t1, w1, q1 = dive_rates(c, given, theta, w, q, delta - 0.5 * change)
    t2, w2, q2 = dive_rates(c, given, theta + half * t1, w + half * w1, q + half * q1, delta)
    t3, w3, q3 = dive_rates(c, given, theta + half * t2, w + half * w2, q + half * q2, delta)
    t4, w4, q4 = dive_rates(c, given, theta + h * t3, w + h * w3, q + h * q3, delta + 0.5 * change)
    return (
        theta + sixth * (t1 + 2.0 * (t2 + t3) + t4),
        w + sixth * (w1 + 2.0 * (w2 + w3) + w4),
        q + sixth * (q1 + 2.0 * (q2 + q3) + q4),
    )


@pure
def corrected_dive(p: Any, x: Any, row: Any, noise: Any, innovation: Any) -> Any:
    """Return covariance and state after one measured number, as `planar_filter.corrected`."""
    m0, m1, m2 = row
    k0, k1, k2 = m0 / noise, m1 / noise, m2 / noise
    p00, p01, p02, p11, p12, p22 = p
    return (
        (p00 - k0 * m0, p01 - k0 * m1, p02 - k0 * m2, p11 - k1 * m1, p12 - k1 * m2, p22 - k2 * m2),
        (x[0] + k0 * innovation, x[1] + k1 * innovation, x[2] + k2 * innovation),
    )


@pure
def dive_innovations(c: Any, noise: Any, grid: Any, means: Any, changes: Any, out: Any, states: Any) -> None:
    """Fill in the innovations of theta, w and q of a recording.

    Args:
        c: a `DiveCombinations`, then the biases of gyro (rad/s), theta (rad) and w (m/s), then the time from
            a sample's node to the moment at which it was measured, s.
        noise: variances of theta, w, q as measured, and their growth in a second; further ones are not used.
        grid: `time_grid.Grid` as its arrays, with what `dive_rates` is given in
            place of the thrust, the pitch rate in place of r,
            and the pitch in place of u, at the nodes of the pitch rate.
        means, changes: mean angle of the planes in each step and its change in it, rad.
        out: written, (m,) or (m, sets).
        states: written if it has rows: theta, w, q and 0 at each node, (n, 4).
    """
    step, begins, given, rate_row, rate, pitch_row, w_row, pitch, w_log = grid
    noise_t, noise_w, noise_q, grow_t, grow_w, grow_q, _, _ = noise
    gyro, bias, w_bias, lead = c[14], c[15], c[16], c[17]
    zero = 0.0 * c[0]
    begin = (zero + noise_t, zero, zero, zero + noise_w, zero, zero + noise_q)
    p, x = begin, (zero, zero, zero)
    for k in range(len(step)):
        if begins[k]:
            p, x = begin, (zero + pitch[k] - bias, zero + w_log[k] - w_bias, zero + rate[k] - gyro)
        u, level, delta, h = given[k][0], given[k][1], means[k], step[k]
        if rate_row[k] >= 0:
            innovation = rate[k] - gyro - x[2]
            out[rate_row[k]] = innovation
            p, x = corrected_dive(p, x, (p[2], p[4], p[5]), p[5] + noise_q, innovation)
            innovation = pitch[k] - bias - x[0]
            out[pitch_row[k]] = innovation
            p, x = corrected_dive(p, x, (p[0], p[1], p[2]), p[0] + noise_t, innovation)
        cos, sin = level * np.cos(x[0]), np.sin(x[0])
        if w_row[k] >= 0:
            _, dw, _ = dive_rates(c, given[k], x[0], x[1], x[2], delta)
            innovation = w_log[k] - w_bias - lead * dw - x[1]
            out[w_row[k]] = innovation
            p, x = corrected_dive(p, x, (p[1], p[3], p[4]), p[3] + noise_w, innovation)
            cos, sin = level * np.cos(x[0]), np.sin(x[0])
        if len(states) > 0:
            states[k, 0], states[k, 1], states[k, 2] = x
        p00, p01, p02, p11, p12, p22 = spread(
            p, transition(dive_jacobian(c, u, x[1], x[2], cos, sin, level), h)
        )
        p = (p00 + h * grow_t, p01, p02, p11 + h * grow_w, p12, p22 + h * grow_q)
        x = dive_advance(c, given[k], x, delta, changes[k], h)
