"""Samples of a vehicle's topics as they were on the wire: unconverted, so that mistakes stay visible."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract.frames import yaw_of_quaternion

Array = NDArray[np.float64]


class OdometrySample(NamedTuple):
    """One `odom`: ROS time of its arrival and its stamp (s), its frames, and its numbers.

    `orientation` is (x, y, z, w); the covariances are the six of the diagonal. What only a vehicle that dives
    needs stands last: z, the velocity along the body's z axis, and the rates about its x and y axes.
    """

    received: float
    stamp: float
    frame: str
    child: str
    x: float
    y: float
    orientation: tuple[float, float, float, float]
    u: float
    v: float
    r: float
    pose_covariance: tuple[float, ...] = (0.0,) * 6
    twist_covariance: tuple[float, ...] = (0.0,) * 6
    z: float = 0.0
    w: float = math.nan
    p: float = 0.0
    q: float = 0.0


class WaterSample(NamedTuple):
    """One `velocity_through_water`: arrival, stamp (s), frame, velocity (m/s), diagonal of the covariance.

    `w` is the velocity along the body's z axis; NaN: not measured.
    """

    received: float
    stamp: float
    frame: str
    u: float
    v: float
    covariance: tuple[float, ...] = (0.0,) * 6
    w: float = math.nan


class Value(NamedTuple):
    """One Float64: ROS time of its arrival (s), and what it says."""

    received: float
    value: float


class RangeSample(NamedTuple):
    """One `altitude`: arrival and stamp (s), range (m; infinite without an echo), its limits (m)."""

    received: float
    stamp: float
    range: float
    nearest: float = 0.0
    farthest: float = 0.0


class Endpoint(NamedTuple):
    """A publisher or a subscription in the graph, as discovery shows it."""

    topic: str
    publishes: bool
    type: str
    node: str
    reliable: bool = True
    transient_local: bool = False


@dataclass
class Recording:
    """Everything that was heard, in the order of arrival.

    Attributes:
        odom, water, rudder_state: from the vehicle.
        rudder_cmd, thrust_cmd: to the vehicle, from any sender.
        sternplane_state, altitude, sternplane_cmd: the same, of a vehicle with stern planes.
        endpoints: publishers and subscriptions of the contract's topics, without the listener itself.
        duration: of the listening, s of ROS time.
        sim_time: whether ROS time came from /clock.
        wiggled: whether the small test was made: then everything can be judged, and has to be.
        listened_in: ROS domain and discovery range of the listener, for people.
    """

    odom: list[OdometrySample] = field(default_factory=list)
    water: list[WaterSample] = field(default_factory=list)
    rudder_state: list[Value] = field(default_factory=list)
    rudder_cmd: list[Value] = field(default_factory=list)
    thrust_cmd: list[Value] = field(default_factory=list)
    sternplane_state: list[Value] = field(default_factory=list)
    altitude: list[RangeSample] = field(default_factory=list)
    sternplane_cmd: list[Value] = field(default_factory=list)
    endpoints: tuple[Endpoint, ...] = ()
    duration: float = 0.0
    sim_time: bool = False
    wiggled: bool = False
    listened_in: str = ""


class Motion(NamedTuple):
    """The usable odometries as arrays of shape (n,): stamps that rise, finite numbers, still as on the wire.

    Both conventions, ENU/FLU and NED/FRD, are right-handed when their z axis is looked along: at yaw 0 the
    bow points along x, and yaw grows from x towards y. So what is checked here needs no frame's name.
    """

    t: Array
    x: Array
    y: Array
    yaw: Array
    r: Array
    u: Array
    v: Array

    @property
    def enough(self) -> bool:
        """Whether there is something to judge: 20 samples over 3 s."""
        return self.t.size >= 20 and float(self.t[-1] - self.t[0]) >= 3.0


def usable(odom: list[OdometrySample]) -> list[OdometrySample]:
    """Return the usable odometries; unusable ones have checks of their own.

    A jump of the stamps divides the recording: the longest stretch is taken.
    """
    newest = -np.inf
    rows: list[OdometrySample] = []
    stretches = [rows]
    for sample in odom:
        if not np.isfinite((sample.x, sample.y, *sample.orientation, sample.r)).all():
            continue
        if newest - 1.0 < sample.stamp <= newest:
            continue  # overtaken, or sent twice
        if not newest - 1.0 < sample.stamp < newest + 2.0:
            rows = []
            stretches.append(rows)
        newest = sample.stamp
        rows.append(sample)
    return max(stretches, key=len)


def motion_of(odom: list[OdometrySample]) -> Motion:
    """Return the motion in the plane that usable odometries show."""
    rows = [(s.stamp, s.x, s.y, yaw_of_quaternion(*s.orientation), s.r, s.u, s.v) for s in usable(odom)]
    t, x, y, yaw_wrapped, r, u, v = np.array(rows, dtype=float).reshape(-1, 7).T
    return Motion(t, x, y, np.unwrap(yaw_wrapped), r, u, v)


def slope(t: Array, values: Array, span: float) -> tuple[Array, Array]:
    """Return the rates of change over `span` seconds around the middle of each interval.

    Returns:
        (rates, middles), each of shape (m,): units per second, and times in s.
    """
    begin = np.searchsorted(t, t + span, side="left")
    rows = np.flatnonzero(begin < t.size)
    end = begin[rows]
    dt = t[end] - t[rows]
    keep = dt < 2.0 * span
    rows, end, dt = rows[keep], end[keep], dt[keep]
    return (values[end] - values[rows]) / dt, 0.5 * (t[end] + t[rows])


def mean_over(t: Array, values: Array, middles: Array, span: float) -> Array:
    """Return the mean of a signal over `span` seconds around each time (trapezoids); shape of `middles`."""
    integral = np.concatenate(([0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(t))))
    low, high = middles - 0.5 * span, middles + 0.5 * span
    length = np.maximum(np.minimum(high, t[-1]) - np.maximum(low, t[0]), 1e-9)
    mean: Array = (np.interp(high, t, integral) - np.interp(low, t, integral)) / length
    return mean
