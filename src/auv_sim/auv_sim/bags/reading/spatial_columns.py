"""The further columns of a `SpatialRun` from the topics of a recording."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import Convention

_POSITION, _ORIENTATION = "pose.pose.position.", "pose.pose.orientation."
_ATTITUDE = (f"{_POSITION}z", *(f"{_ORIENTATION}{axis}" for axis in "wxyz"))


def spatial_columns(
    own: Callable[[str], NDArray[np.float64]],
    aligned: Callable[..., NDArray[np.float64]],
    convention: Convention,
    water_sign: float,
) -> dict[str, NDArray[np.float64]]:
    """Return the columns by their names, each of shape (n,).

    Args:
        own: field of the odometry -> column.
        aligned: (topic, field) -> column on the odometry's stamps; NaN where the topic has none.
        convention: of the odometry's frames.
        water_sign: 1 where the velocity through the water is in FRD, -1 in FLU.
    """
    sign = 1.0 if convention is Convention.NED_FRD else -1.0
    z, phi, theta = _attitude([own(field) for field in _ATTITUDE], sign)
    z_true, phi_true, theta_true = _attitude([aligned(topics.TRUE_ODOM, field) for field in _ATTITUDE], sign)
    theta_d = -aligned(topics.DESIRED_PITCH)
    return {
        "z": z,
        "phi": phi,
        "theta": theta,
        "q": sign * own("twist.twist.angular.y"),
        "wr": water_sign * aligned(topics.WATER_VELOCITY, "twist.twist.linear.z"),
        "sternplanes": aligned(topics.STERNPLANE_STATE),
        "sternplanes_cmd": aligned(topics.STERNPLANE_CMD),
        "theta_d": theta_d,
        "q_d": -aligned(topics.DESIRED_PITCH_RATE),
        "depth_d": aligned(topics.DESIRED_DEPTH),
        "ze": aligned(topics.PATH_ERROR_3D, "vector.z"),
        "theta_e": theta - theta_d,
        "altitude": aligned(topics.ALTITUDE, "range"),
        "Vz_est": -aligned(topics.CURRENT_ESTIMATE, "vector.z"),
        "Vz_true": -aligned(topics.TRUE_CURRENT, "vector.z"),
        "z_true": z_true,
        "phi_true": phi_true,
        "theta_true": theta_true,
    }


def _attitude(columns: list[Any], sign: float) -> tuple[Any, Any, Any]:
    """Return depth (m), roll and pitch (rad), NED, from the columns of `_ATTITUDE`."""
    z, w, x, y, turn = columns
    roll = np.arctan2(2.0 * (w * x + y * turn), 1.0 - 2.0 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2.0 * (w * y - turn * x), -1.0, 1.0))
    return sign * z, roll, sign * pitch
