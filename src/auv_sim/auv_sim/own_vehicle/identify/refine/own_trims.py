"""A trim of the rudder for each recording: the fin may have been set between them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.innovations import Channels, innovations
from auv_sim.own_vehicle.identify.minimise import Minimised, free_unknowns, jacobian, minimise, weights_of
from auv_sim.own_vehicle.identify.unknowns import TRIM, Scaling

#: A trim is a recording's own where it differs by more than this (rad), and by so many standard deviations.
_LEAST, _CLEARLY = math.radians(0.1), 4.0
#: Steps towards the trims, at most; the last one is shorter than this, rad; step of the derivatives, rad.
_STEPS, _NEAR, _MOVED = 10, math.radians(0.01), 1e-4


class Shifts(NamedTuple):
    """Further unknowns by one step of Gauss-Newton together with all others: values, standard deviations."""

    values: Numbers
    deviations: Numbers


def shifts_of(
    channels: Channels,
    scaling: Scaling,
    estimate: Minimised,
    columns: Numbers,
    own: Numbers | None = None,
) -> Shifts:
    """Return by how much the data would move numbers that an estimate holds.

    Args:
        channels, scaling, estimate: the estimate.
        columns: derivatives of the weighed innovations by those numbers, (m, numbers).
        own: their values, where they have zero mean and unit variance before any data.
    """
    free, weights = free_unknowns(scaling), weights_of(channels, scaling, estimate)
    J = jacobian(channels, scaling, estimate.z, free, weights)
    bare = np.zeros((free.size, columns.shape[1]))
    A = np.block([[J, columns], [np.eye(free.size), bare]])
    right = np.append(estimate.residuals, estimate.z[free])
    if own is not None:
        A = np.vstack((A, np.hstack((bare.T, np.eye(own.size)))))
        right = np.append(right, own)
    covariance = np.linalg.pinv(A.T @ A)
    values = -covariance @ (A.T @ right)
    return Shifts(values[free.size :], np.sqrt(np.maximum(np.diag(covariance)[free.size :], 0.0)))


def derivative(
    channels: Channels, scaling: Scaling, estimate: Minimised, place: int, step: float = _MOVED
) -> Numbers:
    """Return the derivative of the weighed innovations by a physical unknown, (m,)."""
    physical = scaling.physical(estimate.z)
    moved = physical.copy()
    moved[place] += step
    change = innovations(channels, moved) - innovations(channels, physical)
    return np.asarray(change / step * weights_of(channels, scaling, estimate))


def trim_columns(channels: Channels, scaling: Scaling, estimate: Minimised, groups: Sequence[int]) -> Numbers:
    """Return the derivatives of the weighed innovations by the trims of all recordings but the first.

    Args:
        channels, scaling, estimate: the estimate.
        groups: number of the recording of each passage, from 0.
    """
    of_row = np.repeat(groups, [passage.rows.size for passage in channels.passages])
    every = derivative(channels, scaling, estimate, TRIM)
    return np.array([np.where(of_row == group, every, 0.0) for group in range(1, max(groups) + 1)]).T


def own_trim_columns(channels: Channels, scaling: Scaling, estimate: Minimised) -> Numbers:
    """Return the columns of `trim_columns` for channels of `with_own_trims`, (m, trims)."""
    trims = [passage.trim for passage in channels.passages]
    different = list(dict.fromkeys(trims))
    if len(different) == 1:
        return np.zeros((channels.rows.size, 0))
    return trim_columns(channels, scaling, estimate, [different.index(trim) for trim in trims])


def with_own_trims(
    channels: Channels, scaling: Scaling, estimate: Minimised, names: Sequence[str]
) -> tuple[Channels, Minimised]:
    """Return channels whose passages have trims of their own where recordings clearly differ.

    Args:
        channels, scaling, estimate: of one trim for all.
        names: of the recording of each passage.
    """
    different = list(dict.fromkeys(names))
    if len(different) == 1 or not scaling.sheet.trim > 0.0:
        return channels, estimate
    groups = [different.index(name) for name in names]
    for step in range(_STEPS):
        shifts = shifts_of(channels, scaling, estimate, trim_columns(channels, scaling, estimate, groups))
        own, sizes = np.append(0.0, shifts.values), np.abs(shifts.values)
        is_clear = bool((sizes > np.maximum(_LEAST, _CLEARLY * shifts.deviations)).any())
        if sizes.max() < _NEAR or (step == 0 and not is_clear):
            break
        channels = channels.with_trims([own[group] for group in groups])
        estimate = minimise(channels, scaling, estimate.z, first=estimate.deviations)
    return channels, estimate
