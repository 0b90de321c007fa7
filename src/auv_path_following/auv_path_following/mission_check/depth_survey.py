"""One lap of a path in three dimensions, sampled: depth, slope and vertical curvature over its length."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_segment import DEPTH_WIDTH

Array = npt.NDArray[np.float64]

#: Samples of each piece of depth: the middle of a ramp is one of them.
_INTERVALS = 32


@dataclass(frozen=True)
class DepthSurvey:
    """Samples along a path, in its order; every array has one entry for each.

    Attributes:
        i, t: subpath (from 0), and t on it.
        way: horizontal length from the path's start, m.
        z: depth, m.
        gamma: elevation, rad, up positive.
        bend: vertical curvature, 1/m, up positive: Eq. (3D-9).
    """

    i: npt.NDArray[np.int64]
    t: Array
    way: Array
    z: Array
    gamma: Array
    bend: Array


def survey_of(path: SpatialPath, subpaths: int) -> DepthSurvey:
    """Sample the first subpaths of a path."""
    columns: list[tuple[Array, ...]] = []
    before = 0.0
    for i in range(subpaths):
        subpath = path.subpaths[i]
        t = np.linspace(0.0, 1.0, 1 + _INTERVALS * (len(subpath.depth_pieces) // DEPTH_WIDTH))
        _, _, z, dx, dy, dz, ddx, ddy, ddz = (np.asarray(axis) for axis in path.sampled(i, t))
        squared = dx * dx + dy * dy
        whole = squared + dz * dz
        turning = (dz * (dx * ddx + dy * ddy) - ddz * squared) / (np.sqrt(squared) * whole)
        length = subpath.plan.length
        way = before + length - np.array([subpath.plan.length_to_go(float(one)) for one in t])
        gamma, bend = np.arctan2(-dz, np.sqrt(squared)), turning / np.sqrt(whole)
        columns.append((np.full(len(t), i), t, way, z, gamma, bend))
        before += length
    names = [field.name for field in dataclasses.fields(DepthSurvey)]
    arrays = map(np.concatenate, zip(*columns, strict=True))
    return DepthSurvey(**dict(zip(names, arrays, strict=True)))
