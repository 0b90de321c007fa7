"""Accelerations of surge, sway and yaw by heave, roll and pitch: assumed, and corrected by the data."""

from __future__ import annotations

import numpy as np

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.innovations import Channels, innovations_of
from auv_sim.own_vehicle.identify.minimise import Minimised, minimise, weights_of
from auv_sim.own_vehicle.identify.refine.own_trims import shifts_of
from auv_sim.own_vehicle.identify.unknowns import Scaling

#: Steps of Gauss-Newton and the longest one; it ends with one shorter than `_NEAR`. Standard deviations.
_STEPS, _LONGEST, _NEAR = 6, 1.5, 0.03
#: Step of the derivatives, in standard deviations.
_MOVED = 0.01


def with_vertical_loads(
    channels: Channels, scaling: Scaling, estimate: Minimised
) -> tuple[Channels, Minimised]:
    """Return an estimate with the loads that fit the data best; the same one where there are none.

    Args:
        channels, scaling, estimate: of other loads.
    """
    for _ in range(_STEPS if channels.loads_off.size else 0):
        columns = load_columns(channels, scaling, estimate)
        step = shifts_of(channels, scaling, estimate, columns, channels.loads_off).values
        channels = channels.with_loads_off(channels.loads_off + np.clip(step, -_LONGEST, _LONGEST))
        estimate = minimise(channels, scaling, estimate.z, first=estimate.deviations)
        if np.abs(step).max() < _NEAR:
            break
    return channels, estimate


def load_columns(channels: Channels, scaling: Scaling, estimate: Minimised) -> Numbers:
    """Return the derivatives of the weighed innovations by `VerticalLoads.off`, (m, loads)."""
    off, weights = channels.loads_off, weights_of(channels, scaling, estimate)
    moved = [off, *(off + _MOVED * row for row in np.eye(off.size))]
    physical = scaling.physical(estimate.z)
    first, *others = innovations_of([(channels.with_loads_off(one), physical) for one in moved])
    columns = [(one - first) / _MOVED * weights for one in others]
    return np.array(columns).T if columns else np.zeros((first.size, 0))
