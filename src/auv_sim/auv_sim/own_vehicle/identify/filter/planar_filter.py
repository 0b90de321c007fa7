"""Extended Kalman filter of surge, sway and yaw: one-step prediction errors of a recording.

The source is compiled for one set of parameters, and runs uncompiled for many sets at once: every parameter
may be a number or an array of one number for each set.
"""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.pure import pure
from auv_sim.own_vehicle.identify.filter.filter_covariance import (
    carried_covariance,
    corrected,
    transition,
)


@pure
def planar_accelerations(c: Any, u: Any, v: Any, r: Any, push: Any, delta: Any) -> tuple[Any, Any, Any]:
    """Return (u', v', r') by Eqs. (18), (19).

    Args:
        c: the numbers of a `Combinations`.
        u, v, r: through the water, m/s, rad/s.
        push: acceleration by the thrust, m/s^2.
        delta: rudder angle, rad.
    """
    vv, rr, ur, uv, uud = v * abs(v), r * abs(r), u * r, u * v, u * u * delta
    return (
        push + c[1] * u * abs(u) + c[2] * v * r + c[3] * r * r,
        c[4] * vv + c[5] * rr + c[6] * ur + c[7] * uv + c[8] * uud,
        c[9] * vv + c[10] * rr + c[11] * ur + c[12] * uv + c[13] * uud,
    )


@pure
def planar_jacobian(c: Any, u: Any, v: Any, r: Any, delta: Any) -> tuple[Any, ...]:
    """Return the derivatives of `planar_accelerations` by u, v, r: nine numbers, row after row."""
    av, ar, ud = 2.0 * abs(v), 2.0 * abs(r), 2.0 * u * delta
    return (
        2.0 * c[1] * abs(u), c[2] * r, c[2] * v + 2.0 * c[3] * r,
        c[6] * r + c[7] * v + c[8] * ud, c[4] * av + c[7] * u, c[5] * ar + c[6] * u,
        c[11] * r + c[12] * v + c[13] * ud, c[9] * av + c[12] * u, c[10] * ar + c[11] * u,
    )  # fmt: skip


@pure
def planar_advance(
    c: Any, u: Any, v: Any, r: Any, push: Any, delta: Any, change: Any, h: Any
) -> tuple[Any, Any, Any]:
    """Return (u, v, r) after `h` seconds: one Runge-Kutta step.

    Args:
        c: the numbers of a `Combinations`.
        u, v, r: before, m/s, rad/s.
        push: acceleration by the thrust, m/s^2.
        delta, change: mean angle of the rudder in the step, and its change, rad.
        h: s.
    """
    half, early, late = 0.5 * h, delta - 0.5 * change, delta + 0.5 * change
    u1, v1, r1 = planar_accelerations(c, u, v, r, push, early)
    u2, v2, r2 = planar_accelerations(c, u + half * u1, v + half * v1, r + half * r1, push, delta)
    u3, v3, r3 = planar_accelerations(c, u + half * u2, v + half * v2, r + half * r2, push, delta)
    u4, v4, r4 = planar_accelerations(c, u + h * u3, v + h * v3, r + h * r3, push, late)
    sixth = h / 6.0
    return (
        u + sixth * (u1 + 2.0 * (u2 + u3) + u4),
        v + sixth * (v1 + 2.0 * (v2 + v3) + v4),
        r + sixth * (r1 + 2.0 * (r2 + r3) + r4),
    )


@pure
def carried(
    c: Any, p: Any, a: Any, x: Any, thrust: Any, delta: Any, change: Any, given: Any, h: Any, noise: Any
) -> Any:
    """Return covariances and state `h` seconds later.

    Args:
        c: the numbers of a `Combinations`.
        p, a, x: as for `corrected`.
        thrust: of the step, N.
        delta, change: mean angle of the rudder in the step, and its change, rad.
        given: further accelerations, m/s^2, rad/s^2.
        h: s.
        noise: as for `planar_innovations`.
    """
    _, _, _, grow_u, grow_v, grow_r, drift, decay, fin, fin_decay = noise
    u, v, r, error, off = x
    delta = delta + off
    f = transition(planar_jacobian(c, u, v, r, delta), h)
    kept, held, square = 1.0 - decay * h, 1.0 - fin_decay * h, h * u * u
    growth = h * grow_u, h * grow_v, h * grow_r, drift, fin
    zero = 0.0 * c[0]
    gains = h * c[0] * thrust, zero, zero, zero, c[8] * square, c[13] * square
    p, a = carried_covariance(p, a, f, gains, kept, held, growth)
    u, v, r = planar_advance(c, u, v, r, c[0] * thrust * (1.0 + error), delta, change, h)
    u, v, r = u + h * given[0], v + h * given[1], r + h * given[2]
    return p, a, (u, v, r, kept * error, held * off)


@pure
def planar_innovations(
    c: Any, noise: Any, grid: Any, means: Any, changes: Any, out: Any, states: Any
) -> None:
    """Fill in the innovations of u, v and r of a recording.

    The errors of thrust and rudder are Gauss-Markov processes, estimated as a fourth and a fifth state.

    Args:
        c: a `Combinations`, then the biases of gyro (rad/s), u and v (m/s), then the time from a sample's
            node to the moment at which it was measured, s.
        noise: variances of u, v, r as measured; their growth in a second; variance of the thrust's error, a
            share squared, and the inverse of its time constant, 1/s; the same of the rudder's, rad^2, 1/s.
        grid: `time_grid.Grid` as its arrays.
        means, changes: mean rudder angle of each step and its change in it, rad.
        out: written, (m,) or (m, sets).
        states: written if it has rows: u, v, r and the thrust's error at each node, (n, 4).
    """
    step, begins, thrust, rate_row, rate, u_row, v_row, u_log, v_log, given = grid
    noise_u, noise_v, noise_r, _, _, _, drift, _, fin, _ = noise
    gyro, u_bias, v_bias, lead = c[14], c[15], c[16], c[17]
    zero = 0.0 * c[0]
    x = (zero, zero, zero, zero, zero)
    begin = (zero + noise_u, zero, zero, zero + noise_v, zero, zero + noise_r)
    errors = (zero, zero, zero, zero + drift, zero, zero, zero, zero, zero + fin)
    p, a = begin, errors
    for k in range(len(step)):
        if begins[k]:
            x = (zero + u_log[k] - u_bias, zero + v_log[k] - v_bias, zero + rate[k] - gyro, zero, zero)
            p, a = begin, errors
        if rate_row[k] >= 0:
            innovation = rate[k] - gyro - x[2]
            out[rate_row[k]] = innovation
            p, a, x = corrected(p, a, x, (p[2], p[4], p[5], a[2], a[6]), p[5] + noise_r, innovation)
        if u_row[k] >= 0:
            push = c[0] * thrust[k] * (1.0 + x[3])
            du, dv, _ = planar_accelerations(c, x[0], x[1], x[2], push, means[k] + x[4])
            du, dv = du + given[k][0], dv + given[k][1]
            at_u, at_v = u_log[k] - u_bias - lead * du, v_log[k] - v_bias - lead * dv
            out[u_row[k]] = at_u - x[0]
            out[v_row[k]] = at_v - x[1]
            p, a, x = corrected(p, a, x, (p[0], p[1], p[2], a[0], a[4]), p[0] + noise_u, at_u - x[0])
            p, a, x = corrected(p, a, x, (p[1], p[3], p[4], a[1], a[5]), p[3] + noise_v, at_v - x[1])
        if len(states) > 0:
            states[k, 0], states[k, 1], states[k, 2], states[k, 3] = x[0], x[1], x[2], x[3]
        p, a, x = carried(c, p, a, x, thrust[k], means[k], changes[k], given[k], step[k], noise)


@pure
def planar_flight(
    c: Any, grid: Any, means: Any, changes: Any, first: int, length: int, state: Any, out: Any
) -> None:
    """Predict u, v and r by the commands alone.

    Args:
        c: as for `planar_innovations`.
        grid, means, changes: as for `planar_innovations`.
        first, length: node where the prediction begins, and its steps.
        state: u, v, r (m/s, rad/s) and the thrust's error there, which is kept.
        out: written, (length, 3): after each step.
    """
    u, v, r, error = state
    for k in range(length):
        push = c[0] * grid.thrust[first + k] * (1.0 + error)
        h, delta = grid.step[first + k], means[first + k]
        u, v, r = planar_advance(c, u, v, r, push, delta, changes[first + k], h)
        more = grid.given[first + k]
        u, v, r = u + h * more[0], v + h * more[1], r + h * more[2]
        out[k, 0], out[k, 1], out[k, 2] = u, v, r
