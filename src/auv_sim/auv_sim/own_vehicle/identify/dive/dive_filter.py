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
        c, u, w, q: as for `dive_accelerations`.
        cos: cosine of the pitch.
        sin: sine of the pitch times the cosine of the roll.
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
def dive_rates(c: Any, u: Any, given: Any, theta: Any, w: Any, q: Any, delta: Any) -> tuple[Any, Any, Any]:
    """Return the rates of theta, w and q.

    The centre of gravity below that of buoyancy makes the hull a pendulum: it feels the acceleration ahead as
    it feels the pitch, and pitching and rolling pull the hull down by their centripetal acceleration.

    Args:
        c: the numbers of a `DiveCombinations`.
        u: surge, m/s.
        given: measured surge (m/s), cosine of the roll, yaw rate times its sine (rad/s), acceleration ahead
            without that by heave and pitch, over that of gravity, heave and pitch accelerations by the roll
            rate (m/s^2, rad/s^2), heave by the righting moment over that of gravity (m s^2/rad^2), and the
            square of the roll rate (rad^2/s^2).
        theta, w, q: rad, m/s, rad/s.
        delta: angle of the planes, rad.
    """
    sin = np.sin(theta) + given[3] + w * q / GRAVITY
    dw, dq = dive_accelerations(c, u, w, q, given[1] * np.cos(theta), sin, delta)
    centripetal = given[6] * c[13] * (q * q + given[7])
    return given[1] * q - given[2], dw + given[4] - centripetal, dq + given[5]


@pure
def dive_advance(c: Any, u: Any, given: Any, x: Any, delta: Any, change: Any, h: Any) -> tuple[Any, Any, Any]:
    """Return (theta, w, q) after `h` seconds: one Runge-Kutta step.

    Args:
        c, u, given: as for `dive_rates`.
        x: theta, w, q before, rad, m/s, rad/s.
        delta, change: mean angle of the planes in the step, and its change, rad.
        h: s.
    """
    theta, w, q = x
    half, sixth = 0.5 * h, h / 6.0
    t1, w1, q1 = dive_rates(c, u, given, theta, w, q, delta - 0.5 * change)
    t2, w2, q2 = dive_rates(c, u, given, theta + half * t1, w + half * w1, q + half * q1, delta)
    t3, w3, q3 = dive_rates(c, u, given, theta + half * t2, w + half * w2, q + half * q2, delta)
    t4, w4, q4 = dive_rates(c, u, given, theta + h * t3, w + h * w3, q + h * q3, delta + 0.5 * change)
    return (
        theta + sixth * (t1 + 2.0 * (t2 + t3) + t4),
        w + sixth * (w1 + 2.0 * (w2 + w3) + w4),
        q + sixth * (q1 + 2.0 * (q2 + q3) + q4),
    )


@pure
def dive_carried(
    c: Any, p: Any, a: Any, x: Any, given: Any, delta: Any, change: Any, h: Any, noise: Any
) -> Any:
    """Return covariances and state `h` seconds later.

    Args:
        c: the numbers of a `DiveCombinations`.
        p, a, x: as for `corrected`.
        given: as for `dive_rates`.
        delta, change: mean angle of the planes in the step, and its change, rad.
        h: s.
        noise: as for `dive_innovations`.
    """
    _, _, _, grow_t, grow_w, grow_q, surge, loss, drift, decay = noise
    theta, w, q, off, leaning = x
    u, level, zero = given[0] + off, given[1], 0.0 * c[0]
    f = transition(dive_jacobian(c, u, w, q, np.cos(theta), level * np.sin(theta), level), h)
    heaved = c[2] * q + c[3] * w + 2.0 * c[4] * u * delta
    pitched = c[9] * q + c[10] * w + 2.0 * c[11] * u * delta
    gains = zero, h * heaved, h * pitched, zero, zero, zero
    kept, held = 1.0 - loss * h, 1.0 - decay * h
    growth = h * grow_t, h * grow_w, h * grow_q, surge, drift
    p, a = carried_covariance(p, a, f, gains, kept, held, growth)
    theta, w, q = dive_advance(c, u, given, (theta, w, q), delta, change, h)
    return p, a, (theta, w, q, kept * off, held * leaning)


@pure
def dive_innovations(c: Any, noise: Any, grid: Any, means: Any, changes: Any, out: Any, states: Any) -> None:
    """Fill in the innovations of theta, w and q of a recording.

    The errors of the measured surge and of the measured pitch are further states.

    Args:
        c: a `DiveCombinations`, then the biases of gyro (rad/s), theta (rad) and w (m/s), then the time from
            a sample's node to the moment at which it was measured, s.
        noise: variances of theta, w, q as measured; their growth in a second; variance (m^2/s^2) and inverse
            of the time constant (1/s) of the measured surge's error, and those of the pitch's (rad^2, 1/s).
        grid: `time_grid.Grid` as its arrays, with what `dive_rates` is given in place of the thrust, the
            pitch rate in place of r, and the pitch in place of u, at the nodes of the pitch rate.
        means, changes: mean angle of the planes in each step and its change in it, rad.
        out: written, (m,) or (m, sets).
        states: written if it has rows: theta, w, q and the surge's error at each node, (n, 4).
    """
    step, begins, given, rate_row, rate, pitch_row, w_row, pitch, w_log, _ = grid
    noise_t, noise_w, noise_q, _, _, _, surge, _, drift, _ = noise
    gyro, bias, w_bias, lead, zero = c[14], c[15], c[16], c[17], 0.0 * c[0]
    begin = (zero + noise_t, zero, zero, zero + noise_w, zero, zero + noise_q)
    errors = (zero, zero, zero, zero + surge, zero, zero, zero, zero, zero + drift)
    p, a, x = begin, errors, (zero, zero, zero, zero, zero)
    for k in range(len(step)):
        if begins[k]:
            x = (zero + pitch[k] - bias, zero + w_log[k] - w_bias, zero + rate[k] - gyro, zero, zero)
            p, a = begin, errors
        if rate_row[k] >= 0:
            innovation = rate[k] - gyro - x[2]
            out[rate_row[k]] = innovation
            p, a, x = corrected(p, a, x, (p[2], p[4], p[5], a[2], a[6]), p[5] + noise_q, innovation)
            innovation = pitch[k] - bias - x[0] - x[4]
            out[pitch_row[k]] = innovation
            row = (p[0] + a[4], p[1] + a[5], p[2] + a[6], a[0] + a[7], a[4] + a[8])
            p, a, x = corrected(p, a, x, row, row[0] + row[4] + noise_t, innovation)
        if w_row[k] >= 0:
            _, dw, _ = dive_rates(c, given[k][0] + x[3], given[k], x[0], x[1], x[2], means[k])
            innovation = w_log[k] - w_bias - lead * dw - x[1]
            out[w_row[k]] = innovation
            p, a, x = corrected(p, a, x, (p[1], p[3], p[4], a[1], a[5]), p[3] + noise_w, innovation)
        if len(states) > 0:
            states[k, 0], states[k, 1], states[k, 2], states[k, 3] = x[0], x[1], x[2], x[3]
        p, a, x = dive_carried(c, p, a, x, given[k], means[k], changes[k], step[k], noise)


@pure
def dive_flight(
    c: Any, grid: Any, means: Any, changes: Any, first: int, length: int, state: Any, out: Any
) -> None:
    """Predict theta, w and q by the commands of the planes alone; the other motion is given.

    Args:
        c, grid, means, changes: as for `dive_innovations`.
        first, length: node where the prediction begins, and its steps.
        state: theta, w, q (rad, m/s, rad/s) there, and the surge's error, which is not used.
        out: written, (length, 3): after each step.
    """
    theta, w, q, _ = state
    for k in range(length):
        given, h = grid.thrust[first + k], grid.step[first + k]
        x = (theta, w, q)
        theta, w, q = dive_advance(c, given[0], given, x, means[first + k], changes[first + k], h)
        out[k, 0], out[k, 1], out[k, 2] = theta, w, q
