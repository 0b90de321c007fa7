"""A flown mission as columns of numbers, the input of metrics, pictures and comparisons."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from auv_sim.flight.signals import SIGNALS, SPATIAL_SIGNALS, Signal

Column = NDArray[np.float64]

_REQUIRED = ("t", "x", "y", "psi")


@dataclass(frozen=True, eq=False)
class Run:
    """One row for each odometry. Every column has shape (n,); NaN stands where the source has no value.

    NED and FRD, SI units, radians, in the paper's symbols; `signals.SIGNALS` has unit and source of each.

    Attributes:
        t: stamp of the odometry, s.
        x, y, psi, r: position (north, east), heading and its rate.
        ur, vr: velocity through the water, body frame, Eq. (16).
        rudder: measured rudder angle (positive to port).
        rudder_cmd, thrust_cmd: commands of the autopilot (rad, N).
        psi_d, r_d: desired heading, Eq. (24), and its feed-forward rate.
        xe, ye: path-following errors, Eq. (20).
        psi_e: heading error wrap(psi - psi_d).
        s: path parameter, Eq. (1), in [0, number of subpaths].
        Vx_est, Vy_est: current estimate, Eq. (35) (north, east).
        Vx_true, Vy_true: the true current, from a simulator only.
        x_true, y_true, psi_true: true pose, from a simulator whose navigation errs.
        held: 1 where the mission held at the row or since the row before, else 0.
    """

    t: Column
    x: Column
    y: Column
    psi: Column
    r: Column
    ur: Column
    vr: Column
    rudder: Column
    rudder_cmd: Column
    thrust_cmd: Column
    psi_d: Column
    r_d: Column
    xe: Column
    ye: Column
    psi_e: Column
    s: Column
    Vx_est: Column
    Vy_est: Column
    Vx_true: Column
    Vy_true: Column
    x_true: Column
    y_true: Column
    psi_true: Column
    held: Column

    @classmethod
    def from_columns(cls, columns: Mapping[str, ArrayLike]) -> Run:
        """Build a run from lists or arrays; columns left out become NaN.

        Args:
            columns: field name -> n numbers. `t`, `x`, `y` and `psi` are needed. A column of `SpatialRun`
                makes one.

        Raises:
            ValueError: an unknown or a missing column, or columns of different lengths.
        """
        is_spatial = bool(set(columns) & set(SPATIAL_SIGNALS))
        signals = SIGNALS | SPATIAL_SIGNALS if is_spatial else SIGNALS
        if unknown := sorted(set(columns) - set(signals)):
            raise ValueError(f"unknown columns {', '.join(unknown)}")
        if missing := sorted(set(_REQUIRED) - set(columns)):
            raise ValueError(f"missing columns {', '.join(missing)}")
        arrays = {name: np.array(values, dtype=np.float64) for name, values in columns.items()}
        n = arrays["t"].size
        if wrong := {name: array.shape for name, array in arrays.items() if array.shape != (n,)}:
            raise ValueError(f"columns of another shape than t's ({n},): {wrong}")
        made = SpatialRun if is_spatial else cls
        return made(**{name: arrays[name] if name in arrays else np.full(n, np.nan) for name in signals})

    @property
    def signals(self) -> Mapping[str, Signal]:
        """The signal of each column, by its name."""
        return SIGNALS

    @property
    def steps(self) -> int:
        """Number of rows n."""
        return int(self.t.size)

    @property
    def track(self) -> tuple[Column, Column]:
        """The best position known, (north, east), m: the truth where it was recorded, else the odometry's."""
        has_truth = np.isfinite(self.x_true)
        return np.where(has_truth, self.x_true, self.x), np.where(has_truth, self.y_true, self.y)

    def subpath(self, n: int) -> NDArray[np.int64]:
        """Return the active subpath of each row, counted from 0: min(floor(s), n - 1); -1 where s is NaN.

        Args:
            n: number of subpaths of the path.
        """
        known = np.isfinite(self.s)
        index = np.floor(np.where(known, self.s, -1.0)).astype(np.int64)
        return np.where(known, np.clip(index, 0, n - 1), -1)

    def select(self, rows: Any) -> Run:
        """Return the rows that a mask, a slice or an index array picks."""
        picked = {field.name: getattr(self, field.name)[rows] for field in dataclasses.fields(self)}
        return type(self)(**picked)


@dataclass(frozen=True, eq=False)
class SpatialRun(Run):
    """A run in three dimensions; units, meaning and source of each column in `signals.SPATIAL_SIGNALS`.

    Attributes:
        z, phi, theta, q: depth, roll, pitch and pitch rate.
        wr: velocity through the water, downwards in body axes.
        sternplanes, sternplanes_cmd: measured and commanded angle, positive bow down.
        theta_d, q_d, depth_d: desired pitch, its rate, and the requested depth.
        ze, theta_e: error below the path, Eq. (3D-12), and of the pitch.
        altitude: range to the bottom.
        Vz_est, Vz_true: estimated and true current, down.
        z_true, phi_true, theta_true: true pose, from a simulator whose navigation errs.
    """

    z: Column
    phi: Column
    theta: Column
    q: Column
    wr: Column
    sternplanes: Column
    sternplanes_cmd: Column
    theta_d: Column
    q_d: Column
    depth_d: Column
    ze: Column
    theta_e: Column
    altitude: Column
    Vz_est: Column
    Vz_true: Column
    z_true: Column
    phi_true: Column
    theta_true: Column

    @property
    def signals(self) -> Mapping[str, Signal]:
        """The signal of each column, by its name."""
        return SIGNALS | SPATIAL_SIGNALS

    @property
    def depth(self) -> Column:
        """The best depth known, m: the truth where it was recorded, else the odometry's."""
        return np.where(np.isfinite(self.z_true), self.z_true, self.z)

    @property
    def bottom(self) -> Column:
        """Depth of the bottom that the altimeter found below each row, m; NaN without an echo."""
        slant = np.where(np.isfinite(self.altitude), self.altitude, np.nan)
        below: Column = self.depth + slant * np.cos(self.phi) * np.cos(self.theta)
        return below
