"""Measurements of heave and pitch, and the nodes that their filter visits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_path_following.vehicle import GRAVITY, Hull
from auv_path_following.vertical_hull import VerticalHull
from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.dive.surge_fit import SLOW, Surge, surge_of
from auv_sim.own_vehicle.identify.dive.vertical_motion import roll_and_rate, smoothed
from auv_sim.own_vehicle.identify.time_grid import Passage, PlanarData, passage_of

#: Times over which measured sway and heave are averaged where they are given, s.
_SWAY, _HEAVE = 1.0, 0.4

#: Error of the surge over that by the averaged noise alone: a drift of the thrust adds to it.
_FURTHER = 1.5


class Coupling(NamedTuple):
    """Coupling of heave and pitch with other motion, Eqs. (3D-3), (3D-4): alike on bodies of revolution.

    Attributes:
        by_roll: heave and pitch accelerations by roll rate times sway and times yaw rate, (2, 2).
        lever: moment of inertia of pitch over the mass of heave, added ones included, m^2.
    """

    by_roll: Numbers
    lever: float


class DiveData(NamedTuple):
    """A recording of a dive: NED and FRD, SI units, radians.

    Attributes:
        name: for people.
        t, q, theta, phi, r: times (s), pitch rate, pitch, roll and yaw rate, as measured.
        water_t, u, v, w: arrival of each new sample of the velocity through the water, and its components.
        planes_t, planes: times and values of the commands of the stern planes.
        thrust_t, thrust: the same of the thrust.
        coupling: of heave and pitch with other motion, as assumed.
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
    thrust_t: Numbers
    thrust: Numbers
    coupling: Coupling

    def between(self, begin: float, end: float) -> DiveData:
        """Return the measurements of an interval (s), with the commands before its end."""
        rows, water = (self.t >= begin) & (self.t < end), (self.water_t >= begin) & (self.water_t < end)
        planes, thrust = self.planes_t < end, self.thrust_t < end
        return DiveData(
            self.name,
            *(self.t[rows], self.q[rows], self.theta[rows], self.phi[rows], self.r[rows]),
            *(self.water_t[water], self.u[water], self.v[water], self.w[water]),
            *(self.planes_t[planes], self.planes[planes], self.thrust_t[thrust], self.thrust[thrust]),
            self.coupling,
        )


def coupling_of(hull: Hull, vertical: VerticalHull) -> Coupling:
    """Return the coupling of a hull."""
    h, c = hull, vertical
    heave, pitch = h.m - c.Zwd, c.Iyy - c.Mqd
    masses = [[heave, -h.m * c.xg - c.Zqd], [-h.m * c.xg - c.Mwd, pitch]]
    loads = [[c.Zvp - h.m, c.Zrp - h.m * c.xg], [c.Mvp + h.m * c.xg, c.Mrp - (c.Ixx - h.Izz)]]
    return Coupling(np.linalg.solve(np.array(masses), np.array(loads)), pitch / heave)


def dive_passage_of(data: DiveData, latency: float) -> Passage:
    """Return the nodes of a recording, as in the plane, with the pitch beside its rate.

    Surge, sway, roll and yaw rate are given, as measured and with their noise averaged.

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
    own = grid._replace(thrust=_given(data, latency, passage.middles), u_row=pitch_row, v_row=w_row, u=pitch)
    t, at = passage.rows[:of_rate], passage.rows[of_rate : of_rate + of_water]
    return passage._replace(grid=own, rows=np.concatenate((t, t, at)), counts=(of_rate, of_rate, of_water))


def _given(data: DiveData, latency: float, times: Numbers) -> Numbers:
    """Return what `dive_advance` is given at times, (n, 8)."""
    at = data.water_t - latency
    theta, q, r = (np.interp(times, data.t, x) for x in (data.theta, data.q, data.r))
    phi, p = roll_and_rate(data.t, data.phi, times, theta, q, r)
    v = np.interp(times, at, smoothed(data.water_t, data.v, _SWAY))
    surge = _surge(data, at, times, np.array([v * r, r * r, q, theta]))
    heave, pitch = data.coupling.by_roll @ np.array([v * p, r * p])
    ahead, lever = (surge.rate - v * r) / GRAVITY, np.full(times.size, data.coupling.lever / GRAVITY)
    return np.array([surge.u, np.cos(phi), r * np.sin(phi), ahead, heave, pitch, lever, p * p]).T


def _surge(data: DiveData, at: Numbers, times: Numbers, motion: Numbers) -> Surge:
    """Return the surge by thrust, drag, turning, pitching and weight.

    Args:
        data: the recording.
        at: when the samples of the log were measured, s.
        times: s, shape (n,).
        motion: sway times yaw rate, its square, pitch rate and pitch at those times, shape (4, n).
    """
    v_r, r_r, q, theta = motion
    u = np.interp(times, at, smoothed(data.water_t, data.u, _SWAY))
    w = np.interp(times, at, smoothed(data.water_t, data.w, _HEAVE))
    last = np.searchsorted(data.thrust_t, times, side="right") - 1
    thrust = data.thrust[np.maximum(last, 0)] / max(float(np.max(np.abs(data.thrust))), 1e-9)
    forces = np.array([thrust, u * np.abs(u), v_r, r_r, w * q, np.sin(theta)])
    return surge_of(times, forces, at, data.u)


def surge_error(recordings: Sequence[DiveData], white: float) -> tuple[float, float]:
    """Return standard deviation (m/s) and time constant (s) of the error of the surge that is given.

    Args:
        recordings: of one vehicle.
        white: standard deviation of the log's noise, m/s.
    """
    period = float(np.median(np.concatenate([np.diff(data.water_t) for data in recordings])))
    return _FURTHER * white * math.sqrt(min(period / SLOW, 1.0)), SLOW
