"""Extended Kalman filter of heave and pitch: one-step prediction errors of a recording.

As `planar_filter`, compiled or for many sets of parameters at once.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from auv_msgs_py.values.pure import pure
from auv_path_following.vehicle import GRAVITY
from auv_sim.own_vehicle.identify.filter.filter_covariance import (
    carried_covariance,
    corrected,
    transition,
)


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
            without that by heave and pitch, over that of gravity, and heave and pitch accelerations by the
            roll rate (m/s^2, rad/s^2).
        theta, w, q: rad, m/s, rad/s.
        delta: angle of the planes, rad.
    """
    sin = np.sin(theta) + given[3] + w * q / GRAVITY
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
def dive_innovations(c: Any, noise: Any, grid: Any, means: Any, changes: Any, out: Any, states: Any) -> None:
    """Fill in the innovations of theta, w and q of a recording; the planes' error is a further state.

    Args:
        c: a `DiveCombinations`, then the biases of gyro (rad/s), theta (rad) and w (m/s), then the time from
            a sample's node to the moment at which it was measured, s.
        noise: variances of theta, w, q as measured; their growth in a second; two that are not used; and
            variance (rad^2) and inverse of the time constant (1/s) of the planes' error.
        grid: `time_grid.Grid` as its arrays, with what `dive_rates` is given in place of the thrust, the
            pitch rate in place of r, and the pitch in place of u, at the nodes of the pitch rate.
        means, changes: mean angle of the planes in each step and its change in it, rad.
        out: written, (m,) or (m, sets).
        states: written if it has rows: theta, w, q and 0 at each node, (n, 4).
    """
    step, begins, given, rate_row, rate, pitch_row, w_row, pitch, w_log, _ = grid
    noise_t, noise_w, noise_q, grow_t, grow_w, grow_q, _, _, fin, decay = noise
    gyro, bias, w_bias, lead, zero = c[14], c[15], c[16], c[17], 0.0 * c[0]
    begin = (zero + noise_t, zero, zero, zero + noise_w, zero, zero + noise_q)
    errors = (zero, zero, zero, zero, zero, zero, zero, zero, zero + fin)
    p, a, x = begin, errors, (zero, zero, zero, zero, zero)
    for k in range(len(step)):
        if begins[k]:
            x = (zero + pitch[k] - bias, zero + w_log[k] - w_bias, zero + rate[k] - gyro, zero, zero)
            p, a = begin, errors
        u, level, h = given[k][0], given[k][1], step[k]
        if rate_row[k] >= 0:
            innovation = rate[k] - gyro - x[2]
            out[rate_row[k]] = innovation
            p, a, x = corrected(p, a, x, (p[2], p[4], p[5], a[2], a[6]), p[5] + noise_q, innovation)
            innovation = pitch[k] - bias - x[0]
            out[pitch_row[k]] = innovation
            p, a, x = corrected(p, a, x, (p[0], p[1], p[2], a[0], a[4]), p[0] + noise_t, innovation)
        if w_row[k] >= 0:
            _, dw, _ = dive_rates(c, given[k], x[0], x[1], x[2], means[k] + x[4])
            innovation = w_log[k] - w_bias - lead * dw - x[1]
            out[w_row[k]] = innovation
            p, a, x = corrected(p, a, x, (p[1], p[3], p[4], a[1], a[5]), p[3] + noise_w, innovation)
        if len(states) > 0:
            states[k, 0], states[k, 1], states[k, 2] = x[0], x[1], x[2]
        f = transition(dive_jacobian(c, u, x[1], x[2], level * np.cos(x[0]), np.sin(x[0]), level), h)
        gains = zero, h * c[4] * u * u, h * c[11] * u * u
        held, growth = 1.0 - decay * h, (h * grow_t, h * grow_w, h * grow_q, zero, fin)
        p, a = carried_covariance(p, a, f, gains, zero, held, growth)
        theta, w, q = dive_advance(c, given[k], (x[0], x[1], x[2]), means[k] + x[4], changes[k], h)
        x = (theta, w, q, zero, held * x[4])
