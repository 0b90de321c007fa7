"""The row that a compiled flight keeps of an odometry: its columns by name, and how one is filled."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import (
    Command,
    Current,
    Navigation,
    SpatialCommand,
    SpatialCurrent,
    SpatialNavigation,
)
from auv_sim.vehicle.hulls.rigid_body import angles_of

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


#: The same in three dimensions, and how many numbers a row of either kind has.
SPATIAL_TRACK = (
    "x", "y", "z", "phi", "theta", "psi", "q", "r", "ur", "vr", "wr", "rudder_cmd", "sternplanes_cmd",
    "thrust_cmd", "psi_d", "r_d", "theta_d", "q_d", "xe", "ye", "ze", "psi_e", "theta_e", "s", "Vx_est",
    "Vy_est", "Vz_est", "Vx_true", "Vy_true", "Vz_true", "rudder", "sternplanes", "depth_d", "altitude",
)  # fmt: skip
SPATIAL_TRACK_COLUMNS = 1 + len(SPATIAL_TRACK) + 6


@pure
def fill_row(
    navigation: Navigation, row: Any, number: int, seen: Any, guided: Any, estimate: Current, command: Command
) -> None:
    """Write one odometry into a row, shape (TRACK_COLUMNS,).

    Args:
        navigation: as guidance got it, NED.
        row: written.
        number: of the odometry, from 0.
        seen: `Seen` of the vehicle.
        guided: `GuidanceOutput`.
        estimate: of the current, m/s, NED.
        command: rad, N.
    """
    row[NUMBER], row[X], row[Y], row[PSI] = number, navigation.x, navigation.y, navigation.psi
    row[R], row[UR], row[VR] = navigation.r, seen.water.ur, seen.water.vr
    row[RUDDER], row[RUDDER_CMD], row[THRUST_CMD] = seen.rudder, command.rudder, command.thrust
    row[PSI_D], row[R_D] = guided.psi_d, guided.r_d
    row[XE], row[YE], row[PSI_E], row[S] = guided.xe, guided.ye, guided.psi_e, guided.s
    row[VX_EST], row[VY_EST] = estimate.Vx, estimate.Vy
    row[VX_TRUE], row[VY_TRUE] = seen.current.Vx, seen.current.Vy
    row[X_TRUE], row[Y_TRUE], row[PSI_TRUE] = seen.motion.x, seen.motion.y, seen.motion.psi


@pure
def fill_spatial_row(
    navigation: SpatialNavigation, row: Any, number: int, seen: Any, guided: Any, estimate: SpatialCurrent,
    command: SpatialCommand,
) -> None:  # fmt: skip
    """Write one odometry into a row, shape (SPATIAL_TRACK_COLUMNS,); arguments as of `fill_row`."""
    n, w, c, g, e, m = navigation, seen.water, command, guided, estimate, seen.motion
    row[0], row[1], row[2], row[3], row[4], row[5] = number, n.x, n.y, n.z, n.phi, n.theta
    row[6], row[7], row[8], row[9], row[10], row[11] = n.psi, n.q, n.r, w.ur, w.vr, w.wr
    row[12], row[13], row[14] = c.rudder, c.sternplanes, c.thrust
    row[15], row[16], row[17], row[18], row[19], row[20] = g.psi_d, g.r_d, g.theta_d, g.q_d, g.xe, g.ye
    row[21], row[22], row[23], row[24], row[25] = g.ze, g.psi_e, g.theta_e, g.s, e.Vx
    row[26], row[27], row[28], row[29], row[30] = (
        e.Vy,
        e.Vz,
        seen.current.Vx,
        seen.current.Vy,
        seen.current.Vz,
    )
    row[31], row[32], row[33], row[34] = seen.rudder, seen.sternplanes, g.depth, seen.altitude
    row[35], row[36], row[37] = m.x, m.y, m.z
    row[38], row[39], row[40] = angles_of(m)
