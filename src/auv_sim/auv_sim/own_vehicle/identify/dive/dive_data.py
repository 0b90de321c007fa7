"""Measurements of heave and pitch, and the nodes that their filter visits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from auv_path_following.vehicle import GRAVITY, Hull
from auv_path_following.vertical_hull import VerticalHull
from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.dive.vertical_motion import ROLL, smoothed
from auv_sim.own_vehicle.identify.time_grid import Passage, PlanarData, passage_of

#: Times over which measured surge and sway, and the gain of surge, are averaged, s: they change slowly.
_SMOOTH, _GAIN = 1.0, 2.5


class DiveData(NamedTuple):
    """A recording of a dive: NED and FRD, SI units, radians.

    Attributes:
        name: for people.
        t, q, theta, phi, r: times (s), pitch rate, pitch, roll and yaw rate, as measured.
        water_t, u, v, w: arrival of each new sample of the velocity through the water, and its components.
        planes_t, planes: times and values of the commands of the stern planes.
        coupling: of roll with heave and pitch, as assumed: see `coupling_of`.
    """

    name: str
    t: Numbers
    q: Numbers
    theta: Numbers
    phi: Numbers
    r: Numbers
    water_t: Numbers
    u: Numbers
    v: Numbers
    w: Numbers
    planes_t: Numbers
    planes: Numbers
    coupling: Numbers

    def between(self, begin: float, end: float) -> DiveData:
        """Return the measurements of an interval (s), with the commands before its end."""
        rows, water = (self.t >= begin) & (self.t < end), (self.water_t >= begin) & (self.water_t < end)
        planes = self.planes_t < end
        return DiveData(
            self.name,
            *(self.t[rows], self.q[rows], self.theta[rows], self.phi[rows], self.r[rows]),
            *(self.water_t[water], self.u[water], self.v[water], self.w[water]),
            *(self.planes_t[planes], self.planes[planes]),
            self.coupling,
        )


def coupling_of(hull: Hull, vertical: VerticalHull) -> Numbers:
    """Return heave and pitch accelerations by roll rate times sway and times yaw rate, Eq. (3D-4): (2, 2)."""
    h, c = hull, vertical
    masses = [[h.m - c.Zwd, -h.m * c.xg - c.Zqd], [-h.m * c.xg - c.Mwd, c.Iyy - c.Mqd]]
    loads = [[c.Zvp - h.m, c.Zrp - h.m * c.xg], [c.Mvp + h.m * c.xg, c.Mrp - (c.Ixx - h.Izz)]]
    return np.linalg.solve(np.array(masses), np.array(loads))


def dive_passage_of(data: DiveData, latency: float) -> Passage:
    """Return the nodes of a recording, as in the plane, with the pitch beside its rate.

    Surge, sway, roll and yaw rate are given, as measured and smoothed.

    Args:
        data: its measurements and commands.
        latency: age of a velocity when it arrives, s.
    """
    none = np.zeros(data.t.size)
    plane = PlanarData(
        data.name, data.t, data.q, data.water_t, data.u, data.w, data.planes_t, data.planes,
        data.planes_t[:1], np.zeros(1), none, none, none, none,
    )  # fmt: skip
    passage = passage_of(plane, latency)
    grid, (of_rate, of_water, _) = passage.grid, passage.counts
    nodes = passage.times[:-1]
    w_row = np.where(grid.v_row >= 0, grid.v_row - of_water + of_rate, -1)
    pitch_row = np.where(grid.rate_row >= 0, grid.rate_row + of_rate, -1)
    pitch = np.interp(nodes, data.t, data.theta)
    own = grid._replace(thrust=_given(data, latency, nodes), u_row=pitch_row, v_row=w_row, u=pitch)
    t, at = passage.rows[:of_rate], passage.rows[of_rate : of_rate + of_water]
    return passage._replace(grid=own, rows=np.concatenate((t, t, at)), counts=(of_rate, of_rate, of_water))


def _given(data: DiveData, latency: float, nodes: Numbers) -> Numbers:
    """Return what `dive_advance` is given at each node, (n, 6)."""
    at = data.water_t - latency
    surge = smoothed(data.water_t, data.u, _SMOOTH)
    roll = smoothed(data.t, data.phi, ROLL)
    u, v = np.interp(nodes, at, surge), np.interp(nodes, at, smoothed(data.water_t, data.v, _SMOOTH))
    gain = np.interp(nodes, at, np.gradient(smoothed(data.water_t, data.u, _GAIN), at))
    phi, r = np.interp(nodes, data.t, roll), np.interp(nodes, data.t, data.r)
    p = np.interp(nodes, data.t, np.gradient(roll, data.t))
    heave, pitch = data.coupling @ np.array([v * p, r * p])
    return np.array([u, np.cos(phi), r * np.sin(phi), (gain - v * r) / GRAVITY, heave, pitch]).T
