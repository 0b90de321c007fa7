"""The rows of signals over time: five of a planar run, six of one in three dimensions."""

from __future__ import annotations

from typing import NamedTuple

from matplotlib.axes import Axes

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.views import signal_panels as panels


class FinLimits(NamedTuple):
    """Limits that are drawn: angles in rad, the rate in rad/s; None: not drawn."""

    rudder: float | None = None
    rudder_rate: float | None = None
    sternplanes: float | None = None


NO_LIMITS = FinLimits()


def limits_of(vehicle: Vehicle) -> FinLimits:
    """Return the limits of a vehicle's fins."""
    rudder, planes = vehicle.rudder, vehicle.sternplanes
    return FinLimits(rudder.max_angle, rudder.max_rate, planes.max_angle if planes is not None else None)


def rows_of(run: Run) -> int:
    """Return the number of rows of a run."""
    return 6 if isinstance(run, SpatialRun) else 5


def draw_rows(
    rows: list[Axes], flown: Run, path: CompositePath, spatial: SpatialPath | None, limits: FinLimits
) -> None:
    """Draw the rows.

    Args:
        rows: axes, as many as `rows_of` says.
        flown: the rows under way.
        path: of the mission, NED.
        spatial: the same in three dimensions, where it is known.
        limits: of the fins.
    """
    if not flown.steps:
        return
    time = flown.t - flown.t[0]
    if isinstance(flown, SpatialRun):
        if spatial is not None:
            panels.distance(rows[0], time, flown, spatial)
        else:
            panels.cross_track(rows[0], time, flown, path)
        panels.depth(rows[1], time, flown, spatial)
        panels.angle_errors(rows[2], time, flown)
        panels.rudder(rows[3], time, flown, limits.rudder)
        panels.sternplanes(rows[4], time, flown, limits.sternplanes)
    else:
        panels.cross_track(rows[0], time, flown, path)
        panels.heading_error(rows[1], time, flown)
        panels.rudder(rows[2], time, flown, limits.rudder)
        panels.rudder_rate(rows[3], time, flown, limits.rudder_rate)
    panels.current(rows[-1], time, flown)
    panels.switches(rows, time, flown, path if spatial is None else spatial)
