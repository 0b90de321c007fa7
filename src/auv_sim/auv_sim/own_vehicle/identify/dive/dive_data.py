"""Measurements of heave and pitch, and the nodes that their filter visits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.time_grid import Passage, PlanarData, passage_of

#: Time over which measured surge is averaged, s: it changes slowly.
_SMOOTH = 1.0


class DiveData(NamedTuple):
    """A recording of a dive: NED and FRD, SI units, radians.

    Attributes:
        name: for people.
        t, q, theta, phi, r: times (s), pitch rate, pitch, roll and yaw rate, as measured.
        water_t, u, w: arrival of each new sample of the velocity through the water, and its components.
        planes_t, planes: times and values of the commands of the stern planes.
    """

    name: str
    t: Numbers
    q: Numbers
    theta: Numbers
    phi: Numbers
    r: Numbers
    water_t: Numbers
    u: Numbers
    w: Numbers
    planes_t: Numbers
    planes: Numbers

    def between(self, begin: float, end: float) -> DiveData:
        """Return the measurements of an interval (s), with the commands before its end."""
        rows, water = (self.t >= begin) & (self.t < end), (self.water_t >= begin) & (self.water_t < end)
        planes = self.planes_t < end
        return DiveData(
            self.name, self.t[rows], self.q[rows], self.theta[rows], self.phi[rows], self.r[rows], self.water_t[water], self.u[water],
            self.w[water], self.planes_t[planes], self.planes[planes],
        )  # fmt: skip


def dive_passage_of(data: DiveData, latency: float) -> Passage:
    """Return the nodes of a recording: as in the plane, with the pitch beside its rate; surge, roll and yaw rate are given.

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
    surge = np.interp(nodes, data.water_t - latency, _smoothed(data.water_t, data.u))
    w_row = np.where(grid.v_row >= 0, grid.v_row - of_water + of_rate, -1)
    pitch_row = np.where(grid.rate_row >= 0, grid.rate_row + of_rate, -1)
    pitch = np.interp(nodes, data.t, data.theta)
    phi, r = np.interp(nodes, data.t, data.phi), np.interp(nodes, data.t, data.r)
    given = np.array([surge, np.cos(phi), r * np.sin(phi)]).T
    own = grid._replace(thrust=given, u_row=pitch_row, v_row=w_row, u=pitch, v=grid.v)
    t, at = passage.rows[:of_rate], passage.rows[of_rate : of_rate + of_water]
    return passage._replace(grid=own, rows=np.concatenate((t, t, at)), counts=(of_rate, of_rate, of_water))


def _smoothed(t: Numbers, u: Numbers) -> Numbers:
    """Return u averaged over `_SMOOTH`."""
    period = max(float(np.median(np.diff(t))), 1e-3)
    half = max(round(0.5 * _SMOOTH / period), 0)
    padded = np.concatenate((np.repeat(u[:1], half), u, np.repeat(u[-1:], half)))
    return np.convolve(padded, np.full(2 * half + 1, 1.0 / (2 * half + 1)), mode="valid")
