"""The motion of a vehicle that dives, as its odometry shows it: still as on the wire."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from auv_msgs_py.contract.frames import Convention
from auv_msgs_py.values.attitude import angles_of_quaternion
from auv_sim.checks.vehicle_check.items.values import convention_of
from auv_sim.checks.vehicle_check.samples import Array, Motion, Recording, mean_over, usable

#: Depth of a vehicle whose hull and fins break the surface, m.
_AFLOAT = 0.5


class DiveMotion(NamedTuple):
    """The usable odometries as arrays of shape (n,), and what their frame ids mean.

    World and body are right-handed in either convention, so the equations of motion are the same in both: a
    positive pitch turns the bow against the z axis.

    Attributes:
        t: stamps, s.
        x, y, z: m.
        roll, pitch, yaw: rad; yaw without steps of a turn.
        u, v, w: velocity over ground, m/s; NaN: not measured.
        p, q, r: rates, rad/s.
        down: 1 where z is depth and pitch is bow up (NED/FRD), -1 where z is up and pitch is bow down.
    """

    t: Array
    x: Array
    y: Array
    z: Array
    roll: Array
    pitch: Array
    yaw: Array
    u: Array
    v: Array
    w: Array
    p: Array
    q: Array
    r: Array
    down: float

    @property
    def planar(self) -> Motion:
        """The motion in the plane: levelled velocities, Eq. (3D-14), and the rate of yaw, Eq. (3D-27)."""
        a, b = levelled(self.roll, self.pitch, self.u, self.v, self.w)
        rate = (self.q * np.sin(self.roll) + self.r * np.cos(self.roll)) / np.cos(self.pitch)
        return Motion(self.t, self.x, self.y, self.yaw, rate, a, b)

    @property
    def pitch_rate(self) -> Array:
        """The rate of pitch by the measured rates, rad/s, Eq. (3D-27)."""
        return self.q * np.cos(self.roll) - self.r * np.sin(self.roll)


def dive_motion_of(recording: Recording) -> DiveMotion:
    """Return the motion that usable odometries show; a z or pitch rate that is no number is left out."""
    rows = []
    for s in usable(recording.odom):
        if math.isfinite(s.z + s.q):
            qx, qy, qz, qw = s.orientation
            angles = angles_of_quaternion(qw, qx, qy, qz)
            roll_rate = s.p if math.isfinite(s.p) else 0.0
            rows.append((s.stamp, s.x, s.y, s.z, *angles, s.u, s.v, s.w, roll_rate, s.q, s.r))
    t, x, y, z, roll, pitch, yaw, u, v, w, p, q, r = np.array(rows, dtype=float).reshape(-1, 13).T
    down = 1.0 if convention_of(recording) is Convention.NED_FRD else -1.0
    return DiveMotion(t, x, y, z, roll, pitch, np.unwrap(yaw), u, v, w, p, q, r, down)


def levelled(roll: Array, pitch: Array, u: Array, v: Array, w: Array) -> tuple[Array, Array]:
    """Return velocities ahead and aside in a level frame, m/s, Eq. (3D-14); a w of NaN counts as 0."""
    w = np.where(np.isfinite(w), w, 0.0)
    ahead = np.cos(pitch) * u + np.sin(pitch) * (np.sin(roll) * v + np.cos(roll) * w)
    return ahead, np.cos(roll) * v - np.sin(roll) * w


def climb(roll: Array, pitch: Array, u: Array, v: Array, w: Array) -> Array:
    """Return dz/dt of body velocities, m/s: the last row of Eq. (3D-1); a w of NaN counts as 0."""
    w = np.where(np.isfinite(w), w, 0.0)
    return -np.sin(pitch) * u + np.cos(pitch) * (np.sin(roll) * v + np.cos(roll) * w)


def levelled_water(recording: Recording, dive: DiveMotion) -> Recording:
    """Return the recording with velocities through the water as a level vehicle would measure them."""

    samples = recording.water
    stamps, u, v, w = (np.array([getattr(s, name) for s in samples]) for name in ("stamp", "u", "v", "w"))
    roll, pitch = (np.interp(stamps, dive.t, angle) for angle in (dive.roll, dive.pitch))
    ahead, aside = levelled(roll, pitch, u, v, w)
    rows = zip(samples, ahead.tolist(), aside.tolist(), strict=True)
    return replace(recording, water=[sample._replace(u=a, v=b) for sample, a, b in rows])


def of_water(
    recording: Recording, dive: DiveMotion, middles: Array, span: float
) -> tuple[Array, Array, Array]:
    """Return (ur, vr, wr) over `span` s around each time, m/s; NaN where there are fewer than 10."""
    found = []
    for name in ("u", "v", "w"):
        rows = [(s.stamp, getattr(s, name)) for s in recording.water if math.isfinite(getattr(s, name))]
        rows = sorted(row for row in rows if dive.t[0] <= row[0] <= dive.t[-1])
        if len(rows) < 10:
            found.append(np.full_like(middles, np.nan))
            continue
        t, values = np.array(rows).T
        found.append(mean_over(t, values, middles, span))
    return found[0], found[1], found[2]


def is_upright(dive: DiveMotion) -> bool:
    """Return whether the body's z axis mostly points along the world's, so that it can be levelled."""
    return bool(dive.t.size) and float(np.median(np.cos(dive.roll) * np.cos(dive.pitch))) > 0.0


def stays_afloat(dive: DiveMotion) -> bool:
    """Return whether the vehicle is at the surface all the time, where fins and propeller act otherwise."""
    return bool(dive.t.size) and bool(dive.z.any()) and float(np.percentile(np.abs(dive.z), 90)) < _AFLOAT
