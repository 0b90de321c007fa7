"""Extended Kalman filter of surge, sway and yaw: one-step prediction errors of a recording.

The source is compiled for one set of parameters, and runs uncompiled for many sets at once: every parameter
may be a number or an array of one number for each set.
"""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.pure import pure


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
def corrected(p: Any, q: Any, w: Any, x: Any, row: Any, noise: Any, innovation: Any) -> Any:
    """Return covariance and state after one measured number.

    Args:
        p: upper triangle of the covariance of u, v, r.
        q, w: their covariances with the thrust's error, and its variance.
        x: u, v, r and the thrust's error.
        row: covariances of the measured state with all of `x`.
        noise: variance of the innovation.
        innovation: measured minus predicted.
    """
    m0, m1, m2, m3 = row
    k0, k1, k2, k3 = m0 / noise, m1 / noise, m2 / noise, m3 / noise
    p00, p01, p02, p11, p12, p22 = p
    return (
        (p00 - k0 * m0, p01 - k0 * m1, p02 - k0 * m2, p11 - k1 * m1, p12 - k1 * m2, p22 - k2 * m2),
        (q[0] - k0 * m3, q[1] - k1 * m3, q[2] - k2 * m3),
        w - k3 * m3,
        (x[0] + k0 * innovation, x[1] + k1 * innovation, x[2] + k2 * innovation, x[3] + k3 * innovation),
    )


@pure
def carried(
    c: Any, p: Any, q: Any, w: Any, x: Any, thrust: Any, delta: Any, change: Any, h: Any, noise: Any
) -> Any:
    """Return covariance and state `h` seconds later.

    Args:
        c: the numbers of a `Combinations`.
        p, q, w, x: as for `corrected`.
        thrust: of the step, N.
        delta, change: mean angle of the rudder in the step, and its change, rad.
        h: s.
        noise: as for `planar_innovations`.
    """
    _, _, _, grow_u, grow_v, grow_r, drift, decay = noise
    f = transition(planar_jacobian(c, x[0], x[1], x[2], delta), h)
    shaken = h * c[0] * thrust
    f0 = f[0] * q[0] + f[1] * q[1] + f[2] * q[2]
    f1 = f[3] * q[0] + f[4] * q[1] + f[5] * q[2]
    f2 = f[6] * q[0] + f[7] * q[1] + f[8] * q[2]
    p00, p01, p02, p11, p12, p22 = spread(p, f)
    p = (
        p00 + shaken * (2.0 * f0 + shaken * w) + h * grow_u,
        p01 + shaken * f1, p02 + shaken * f2, p11 + h * grow_v, p12, p22 + h * grow_r,
    )  # fmt: skip
    kept = 1.0 - decay * h
    push = c[0] * thrust * (1.0 + x[3])
    u, v, r = planar_advance(c, x[0], x[1], x[2], push, delta, change, h)
    return (
        p,
        (kept * (f0 + shaken * w), kept * f1, kept * f2),
        kept * kept * w + (1.0 - kept * kept) * drift,
        (u, v, r, kept * x[3]),
    )


@pure
def planar_innovations(
    c: Any, noise: Any, grid: Any, means: Any, changes: Any, out: Any, states: Any
) -> None:
    """Fill in the innovations of u, v and r of a recording.

    The thrust's error is a Gauss-Markov process, estimated as a fourth state.

    Args:
        c: a `Combinations`, then the biases of gyro (rad/s), u and v (m/s), then the time from a sample's
            node to the moment at which it was measured, s.
        noise: variances of u, v, r as measured; their growth in a second; variance of the thrust's error, a
            share squared; and the inverse of its time constant, 1/s.
        grid: `time_grid.Grid` as its arrays: step to the next node (s), whether a node begins a passage,
            thrust of the step, row of r in `out` or -1, r, rows of u and v in `out` or -1, u, v.
        means, changes: mean rudder angle of each step and its change in it, rad.
        out: written, (m,) or (m, sets).
        states: written if it has rows: u, v, r and the thrust's error at each node, (n, 4).
    """
    step, begins, thrust, rate_row, rate, u_row, v_row, u_log, v_log = grid
    noise_u, noise_v, noise_r, _, _, _, drift, _ = noise
    gyro, u_bias, v_bias, lead = c[14], c[15], c[16], c[17]
    zero = 0.0 * c[0]
    x = (zero, zero, zero, zero)
    p = (zero + noise_u, zero, zero, zero + noise_v, zero, zero + noise_r)
    q, w = (zero, zero, zero), zero + drift
    begin = p
    for k in range(len(step)):
        if begins[k]:
            x = (zero + u_log[k] - u_bias, zero + v_log[k] - v_bias, zero + rate[k] - gyro, zero)
            p, q, w = begin, (zero, zero, zero), zero + drift
        push, delta = c[0] * thrust[k] * (1.0 + x[3]), means[k]
        if rate_row[k] >= 0:
            innovation = rate[k] - gyro - x[2]
            out[rate_row[k]] = innovation
            p, q, w, x = corrected(p, q, w, x, (p[2], p[4], p[5], q[2]), p[5] + noise_r, innovation)
        if u_row[k] >= 0:
            du, dv, _ = planar_accelerations(c, x[0], x[1], x[2], push, delta)
            at_u, at_v = u_log[k] - u_bias - lead * du, v_log[k] - v_bias - lead * dv
            out[u_row[k]] = at_u - x[0]
            out[v_row[k]] = at_v - x[1]
            p, q, w, x = corrected(p, q, w, x, (p[0], p[1], p[2], q[0]), p[0] + noise_u, at_u - x[0])
            p, q, w, x = corrected(p, q, w, x, (p[1], p[3], p[4], q[1]), p[3] + noise_v, at_v - x[1])
        if len(states) > 0:
            states[k, 0], states[k, 1], states[k, 2], states[k, 3] = x
        p, q, w, x = carried(c, p, q, w, x, thrust[k], delta, changes[k], step[k], noise)


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
        out[k, 0], out[k, 1], out[k, 2] = u, v, r
