"""The heading loop's limit cycle: the linear hull behind the describing function of a rate limit."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from auv_path_following.control.hull_model import HullModel, accelerations, rudder_gain
from auv_path_following.vehicle import Vehicle

Array = npt.NDArray[np.float64]


def linear_hull(vehicle: Vehicle) -> tuple[Array, Array]:
    """Return A (2, 2) and b (2,) of (vr, r)' = A (vr, r) + b delta, straight ahead at cruising speed.

    Central differences over 0.02 m/s and 0.02 rad/s, so the quadratic drags count with a small value.
    """
    model = HullModel(vehicle).sway_yaw
    ur = vehicle.top_speed
    h = 0.02
    columns = [
        (
            np.array(accelerations(model, ur, h * v, h * r))
            - np.array(accelerations(model, ur, -h * v, -h * r))
        )
        / (2 * h)
        for v, r in ((1.0, 0.0), (0.0, 1.0))
    ]
    return np.column_stack(columns), np.array(rudder_gain(model, ur))


def open_loop(vehicle: Vehicle, w: Array) -> npt.NDArray[Any]:
    """Return the response from -delta to r at the angular frequencies w (rad/s), shape as w."""
    A, b = linear_hull(vehicle)
    return np.array([-np.linalg.solve(1j * x * np.eye(2) - A, b)[1] for x in w])


def phase_lag(w: Array, amplitude: float, rate: float) -> Array:
    """Return the lag (rad) of a rudder commanded to amplitude sin(w t) that moves at `rate` at most.

    Deep in the limit the rudder moves in a triangle of height pi rate / (2 w), and turns where it meets the
    command: it lags by acos(pi rate / (2 w amplitude)). Below the limit it does not lag.
    """
    share = np.minimum(math.pi * rate / (2.0 * w * amplitude), 1.0)
    return np.asarray(np.arccos(share))
