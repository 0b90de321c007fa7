"""What heave, roll and pitch do to surge, sway and yaw: given to the filter in the plane, not identified."""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np

from auv_path_following.vehicle import Hull
from auv_path_following.vertical_hull import VerticalHull
from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.dive.dive_combinations import AHEAD, BUOYANCY

#: Time over which measured roll is averaged, s: its derivative is the roll rate.
ROLL = 0.3
#: Standard deviation of an assumed coefficient before any data, a share of it.
_SHARE = 0.5
#: Coefficients by which heave, roll and pitch act on surge, sway and yaw.
_ASSUMED = ("Xwq", "Xqq", "Ywp", "Ypq", "Nwp", "Npq", "zg")


class AssumedLoads(NamedTuple):
    """Accelerations of surge, sway and yaw by products of the other motions: see `vertical_loads_of`.

    Attributes:
        mean: as assumed, (3, 10).
        deviations: one standard deviation of each number behind them, (numbers, 3, 10).
    """

    mean: Numbers
    deviations: Numbers


class VerticalMotion(NamedTuple):
    """Heave, roll and pitch of a recording: NED and FRD, SI units, radians.

    Attributes:
        t, phi, theta, q: times (s), roll, pitch and pitch rate, as measured.
        water_t, w: arrival of each new sample of the velocity through the water, and its component down.
        loads: accelerations of surge, sway and yaw by them, as assumed.
    """

    t: Numbers
    phi: Numbers
    theta: Numbers
    q: Numbers
    water_t: Numbers
    w: Numbers
    loads: AssumedLoads

    def products(self, latency: float, times: Numbers, r: Numbers) -> Numbers:
        """Return the products that `loads` multiplies, shape (n, 10): see `vertical_loads_of`.

        Args:
            latency: age of a velocity when it arrives, s.
            times: s, shape (n,).
            r: yaw rate at those times, rad/s.
        """
        theta, q = (np.interp(times, self.t, column) for column in (self.theta, self.q))
        phi, p = roll_and_rate(self.t, self.phi, times, theta, q, r)
        w = np.interp(times, self.water_t - latency, self.w)
        aside, rolling, pitching = np.cos(theta) * np.sin(phi), np.gradient(p, times), np.gradient(q, times)
        return np.array([w * q, q * q, p * r, w * p, p * q, q * r, np.sin(theta), aside, rolling, pitching]).T


class VerticalLoads(NamedTuple):
    """Accelerations of surge, sway and yaw by heave, roll and pitch, for each step of a passage.

    Attributes:
        products: see `VerticalMotion.products`, (n, 10).
        assumed: accelerations by them before any data.
        off: by how many standard deviations the numbers behind them differ, (numbers,).
    """

    products: Numbers
    assumed: AssumedLoads
    off: Numbers

    def accelerations(self) -> Numbers:
        """Return the accelerations of surge, sway (m/s^2) and yaw (rad/s^2), shape (n, 3)."""
        loads = self.assumed.mean + np.tensordot(self.off, self.assumed.deviations, 1)
        return np.ascontiguousarray(self.products @ loads.T)


def vertical_loads(motion: VerticalMotion, latency: float, times: Numbers, r: Numbers) -> VerticalLoads:
    """Return the assumed loads at times; the arguments are those of `VerticalMotion.products`."""
    products, off = motion.products(latency, times, r), np.zeros(len(motion.loads.deviations))
    return VerticalLoads(products, motion.loads, off)


def vertical_loads_of(hull: Hull, vertical: VerticalHull) -> AssumedLoads:
    """Return the accelerations of surge, sway and yaw by products of the other motions, Eqs. (3D-3), (3D-4).

    The products are w q, q q, p r, w p, p q, q r, sin(theta), cos(theta) sin(phi), p', q'. Buoyancy and the
    place of the centre of gravity ahead have deviations of their own: a trimmed hull has 0 of both. Sway by
    buoyancy has a further one, as the added mass in sway is assumed.
    """
    c, mean = vertical, _loads(hull, vertical)
    others: dict[str, float] = {name: getattr(c, name) * (1.0 + _SHARE) for name in _ASSUMED}
    others |= {"xg": c.xg + AHEAD * c.zg, "B": c.B + BUOYANCY * c.W}
    deviations = [
        _loads(hull, dataclasses.replace(c, **{name: value})) - mean for name, value in others.items()
    ]
    aside = _SHARE * deviations[-1] * np.array([[0.0], [1.0], [1.0]])
    return AssumedLoads(mean, np.array([*deviations, aside]))


def _loads(hull: Hull, vertical: VerticalHull) -> Numbers:
    """Return the accelerations by each product, (3, 10)."""
    h, c = hull, vertical
    heavy, m_xg, m_zg = c.W - c.B, h.m * c.xg, h.m * c.zg
    surge = [c.Xwq - h.m, c.Xqq + m_xg, -m_zg, 0.0, 0.0, 0.0, -heavy, 0.0, 0.0, -m_zg]
    sway = [0.0, 0.0, 0.0, c.Ywp + h.m, c.Ypq - m_xg, -m_zg, 0.0, heavy, m_zg, 0.0]
    yaw = [0.0, 0.0, 0.0, c.Nwp + m_xg, c.Npq - (c.Iyy - c.Ixx), 0.0, 0.0, c.xg * c.W, 0.0, 0.0]
    masses = np.array([[h.m - h.Yvd, -h.Yrd], [-h.Nvd, h.Izz - h.Nrd]])
    return np.vstack((np.array(surge) / (h.m - h.Xud), np.linalg.solve(masses, np.array([sway, yaw]))))


def roll_and_rate(
    t: Numbers, phi: Numbers, times: Numbers, theta: Numbers, q: Numbers, r: Numbers
) -> tuple[Numbers, Numbers]:
    """Return roll (rad) and roll rate (rad/s) of a measured roll, averaged over `ROLL`.

    The heading turns about the vertical: of a pitched hull a part of that is roll rate.

    Args:
        t, phi: times (s) and measured roll, rad.
        times: of the result, s, shape (n,).
        theta, q, r: pitch (rad), pitch rate and yaw rate (rad/s) at those times.
    """
    averaged = smoothed(t, phi, ROLL)
    roll, change = (np.interp(times, t, column) for column in (averaged, np.gradient(averaged, t)))
    return roll, change - (r * np.cos(roll) + q * np.sin(roll)) * np.tan(theta)


def smoothed(t: Numbers, values: Numbers, over: float) -> Numbers:
    """Return values at times `t` (s), each averaged over `over` seconds around it; ends are repeated."""
    period = max(float(np.median(np.diff(t))), 1e-3)
    half = max(round(0.5 * over / period), 0)
    padded = np.concatenate((np.repeat(values[:1], half), values, np.repeat(values[-1:], half)))
    return np.convolve(padded, np.full(2 * half + 1, 1.0 / (2 * half + 1)), mode="valid")
