"""Immutable values that pass between laws: NED and FRD, SI units, radians.

The paper's notation: x north, y east, psi clockwise from north, body x forward and y starboard.
Named tuples, because they are made many thousand times a second.
"""

from __future__ import annotations

from typing import NamedTuple


class Navigation(NamedTuple):
    """Pose and yaw rate: x, y in m (north, east), psi in rad, r = d psi/dt in rad/s."""

    x: float
    y: float
    psi: float
    r: float


class WaterVelocity(NamedTuple):
    """Velocity through the water in the body frame, Eq. (16): ur forward, vr to starboard, m/s."""

    ur: float
    vr: float


class Current(NamedTuple):
    """Velocity of the water over ground: Vx north, Vy east, m/s."""

    Vx: float
    Vy: float


class Reference(NamedTuple):
    """Reference from guidance: psi_d (rad), r_d (its feed-forward rate, rad/s) and thrust XT (N).

    Thrust is greater than 0 exactly while the mission is running, so one value says both.
    """

    psi_d: float
    r_d: float
    thrust: float


class Command(NamedTuple):
    """Command to the vehicle: rudder angle delta (rad, positive to port) and thrust XT (N)."""

    rudder: float
    thrust: float


#: Deepest position that is accepted, m: a little more than the ocean's.
DEEPEST = 12_000.0
STOP = Command(0.0, 0.0)
NO_CURRENT = Current(0.0, 0.0)
#: Placeholder where the velocity through the water is unknown.
NO_WATER = WaterVelocity(0.0, 0.0)


class SpatialNavigation(NamedTuple):
    """Pose and rates in three dimensions, NED.

    Attributes:
        x, y, z: m; z is depth, positive down.
        phi, theta, psi: roll, pitch and heading, rad; a positive pitch is bow up.
        q, r: pitch and yaw rate in body axes, rad/s.
    """

    x: float
    y: float
    z: float
    phi: float
    theta: float
    psi: float
    q: float
    r: float


class SpatialWater(NamedTuple):
    """Velocity through the water in the body frame: ur forward, vr to starboard, wr down, m/s."""

    ur: float
    vr: float
    wr: float


class SpatialCurrent(NamedTuple):
    """Velocity of the water over ground: Vx north, Vy east, Vz down, m/s."""

    Vx: float
    Vy: float
    Vz: float


class SpatialCommand(NamedTuple):
    """Command to a vehicle with stern planes.

    Attributes:
        rudder: rad, positive to port.
        sternplanes: rad, positive bow down.
        thrust: N.
    """

    rudder: float
    sternplanes: float
    thrust: float


class SpatialReference(NamedTuple):
    """Reference from guidance to the autopilots of a vehicle that dives.

    Attributes:
        psi_d, r_d: desired heading (rad), and its feed-forward rate (rad/s).
        theta_d, q_d: desired pitch (rad, bow up) and its feed-forward rate (rad/s).
        thrust: N; greater than 0 exactly while the mission is running.
    """

    psi_d: float
    r_d: float
    theta_d: float
    q_d: float
    thrust: float


SPATIAL_STOP = SpatialCommand(0.0, 0.0, 0.0)
NO_SPATIAL_CURRENT = SpatialCurrent(0.0, 0.0, 0.0)
NO_SPATIAL_WATER = SpatialWater(0.0, 0.0, 0.0)
