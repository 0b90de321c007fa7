"""The signals of a run: unit, meaning and source of each, for `Run`, exports, reports and batch."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.contract import topics


class Signal(NamedTuple):
    """One column of a `Run`.

    Attributes:
        unit: SI; "-" for a number without one.
        meaning: one line; angles in NED and FRD.
        source: the topic that a recording takes it from.
    """

    unit: str
    meaning: str
    source: str


_ODOM, _TRUE_ODOM, _WATER = topics.ODOM.name, topics.TRUE_ODOM.name, topics.WATER_VELOCITY.name
_ERROR, _ESTIMATE, _TRUE = topics.PATH_ERROR.name, topics.CURRENT_ESTIMATE.name, topics.TRUE_CURRENT.name

#: Name -> signal, in the order of `Run`'s columns.
SIGNALS: dict[str, Signal] = {
    "t": Signal("s", "stamp of the odometry", _ODOM),
    "x": Signal("m", "position north", _ODOM),
    "y": Signal("m", "position east", _ODOM),
    "psi": Signal("rad", "heading", _ODOM),
    "r": Signal("rad/s", "rate of the heading", _ODOM),
    "ur": Signal("m/s", "surge through the water, Eq. (16)", _WATER),
    "vr": Signal("m/s", "sway through the water, Eq. (16)", _WATER),
    "rudder": Signal("rad", "measured rudder angle, positive to port", topics.RUDDER_STATE.name),
    "rudder_cmd": Signal("rad", "commanded rudder angle, positive to port", topics.RUDDER_CMD.name),
    "thrust_cmd": Signal("N", "commanded thrust", topics.THRUST_CMD.name),
    "psi_d": Signal("rad", "desired heading, Eq. (24)", topics.DESIRED_YAW.name),
    "r_d": Signal("rad/s", "feed-forward rate of the desired heading", topics.DESIRED_YAW_RATE.name),
    "xe": Signal("m", "along-track error, Eq. (20)", _ERROR),
    "ye": Signal("m", "cross-track error, Eq. (20)", _ERROR),
    "psi_e": Signal("rad", "heading error wrap(psi - psi_d)", _ERROR),
    "s": Signal("-", "path parameter, Eq. (1), in [0, number of subpaths]", topics.PATH_PARAMETER.name),
    "Vx_est": Signal("m/s", "current estimate north, Eq. (35)", _ESTIMATE),
    "Vy_est": Signal("m/s", "current estimate east, Eq. (35)", _ESTIMATE),
    "Vx_true": Signal("m/s", "true current north, of a simulator", _TRUE),
    "Vy_true": Signal("m/s", "true current east, of a simulator", _TRUE),
    "x_true": Signal("m", "true position north, of a simulator whose navigation errs", _TRUE_ODOM),
    "y_true": Signal("m", "true position east, of a simulator whose navigation errs", _TRUE_ODOM),
    "psi_true": Signal("rad", "true heading, of a simulator whose navigation errs", _TRUE_ODOM),
    "held": Signal(
        "-", "1 where the mission held at the row or since the row before, else 0", topics.MISSION_STATE.name
    ),
}

_ERROR_3D, _PITCH, _PITCH_RATE = "path_error_3d", "desired_pitch", "desired_pitch_rate"

#: The same for the further columns of `SpatialRun`.
SPATIAL_SIGNALS: dict[str, Signal] = {
    "z": Signal("m", "depth", _ODOM),
    "phi": Signal("rad", "roll", _ODOM),
    "theta": Signal("rad", "pitch, positive bow up", _ODOM),
    "q": Signal("rad/s", "pitch rate in body axes", _ODOM),
    "wr": Signal("m/s", "heave through the water, positive down", _WATER),
    "sternplanes": Signal("rad", "measured angle of the stern planes, positive bow down", "sternplane_state"),
    "sternplanes_cmd": Signal("rad", "commanded angle of the stern planes", "sternplane_cmd"),
    "theta_d": Signal("rad", "desired pitch, Eq. (3D-24)", _PITCH),
    "q_d": Signal("rad/s", "feed-forward rate of the desired pitch", _PITCH_RATE),
    "depth_d": Signal("m", "requested depth", "desired_depth"),
    "ze": Signal("m", "error below the path, Eq. (3D-12)", _ERROR_3D),
    "theta_e": Signal("rad", "pitch error theta - theta_d", _PITCH),
    "altitude": Signal("m", "range to the bottom along body z; infinite without an echo", "altitude"),
    "Vz_est": Signal("m/s", "current estimate, down", _ESTIMATE),
    "Vz_true": Signal("m/s", "true current, down, of a simulator", _TRUE),
    "z_true": Signal("m", "true depth, of a simulator whose navigation errs", _TRUE_ODOM),
    "phi_true": Signal("rad", "true roll, of a simulator whose navigation errs", _TRUE_ODOM),
    "theta_true": Signal("rad", "true pitch, of a simulator whose navigation errs", _TRUE_ODOM),
}

#: Columns of the true pose, of a simulator whose navigation errs.
TRUTH = ("x_true", "y_true", "psi_true")
SPATIAL_TRUTH = ("x_true", "y_true", "z_true", "phi_true", "theta_true", "psi_true")

#: Signals that are shown in degrees.
ANGLES = tuple(name for name, signal in (SIGNALS | SPATIAL_SIGNALS).items() if signal.unit.startswith("rad"))
