"""The row that a compiled flight keeps of an odometry: its columns by name, and how one is filled."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import Current, Navigation

#: Columns of a track after the first, the odometry's number, as signals of a run.
TRACK = (
    "x", "y", "psi", "r", "ur", "vr", "rudder", "rudder_cmd", "thrust_cmd", "psi_d", "r_d",
    "xe", "ye", "psi_e", "s", "Vx_est", "Vy_est", "Vx_true", "Vy_true",
)  # fmt: skip

(
    NUMBER, X, Y, PSI, R, UR, VR, RUDDER, RUDDER_CMD, THRUST_CMD, PSI_D, R_D,
    XE, YE, PSI_E, S, VX_EST, VY_EST, VX_TRUE, VY_TRUE, X_TRUE, Y_TRUE, PSI_TRUE,
) = range(1 + len(TRACK) + 3)  # fmt: skip
TRACK_COLUMNS = 1 + len(TRACK) + 3


@pure
def fill_row(
    row: Any, number: int, navigation: Navigation, seen: Any, guided: Any, estimate: Current,
    rudder_cmd: float, thrust_cmd: float,
) -> None:  # fmt: skip
    """Write one odometry into a row, shape (TRACK_COLUMNS,).

    Args:
        row: written.
        number: of the odometry, from 0.
        navigation: as guidance got it, NED.
        seen: `Seen` of the vehicle.
        guided: `GuidanceOutput`.
        estimate: of the current, m/s, NED.
        rudder_cmd, thrust_cmd: rad, N.
    """
    row[NUMBER], row[X], row[Y], row[PSI] = number, navigation.x, navigation.y, navigation.psi
    row[R], row[UR], row[VR] = navigation.r, seen.water.ur, seen.water.vr
    row[RUDDER], row[RUDDER_CMD], row[THRUST_CMD] = seen.rudder, rudder_cmd, thrust_cmd
    row[PSI_D], row[R_D] = guided.psi_d, guided.r_d
    row[XE], row[YE], row[PSI_E], row[S] = guided.xe, guided.ye, guided.psi_e, guided.s
    row[VX_EST], row[VY_EST] = estimate.Vx, estimate.Vy
    row[VX_TRUE], row[VY_TRUE] = seen.current.Vx, seen.current.Vy
    row[X_TRUE], row[Y_TRUE], row[PSI_TRUE] = seen.motion.x, seen.motion.y, seen.motion.psi
