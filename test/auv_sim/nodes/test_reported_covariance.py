"""The covariances that the simulator reports at sea describe the errors that it makes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.types import Command, SpatialCommand
from auv_path_following import vehicle
from auv_sim.nodes.reported_covariance import ReportedCovariances
from auv_sim.vehicle import sea
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver, simulated_vehicle
from auv_sim.vehicle.hulls.rigid_body import body_at
from auv_sim.vehicle.remus import PlantState

SEA = sea.load("rough")
FLIGHTS, STEPS = 100, 100


def normalised(dives: bool) -> NDArray[np.float64]:
    """Errors over their reported deviations: x, y, z, roll, pitch, yaw, u, v, w, p, q, r, ur, vr, wr."""
    reported = ReportedCovariances(SEA.sensors, dives, is_ned=True)
    rows = []
    for seed in range(FLIGHTS):
        hull = vehicle.load("remus100_6dof" if dives else "remus100")
        start = body_at(0, 0, 10.0, 0, 0, 0.7, 1.9) if dives else PlantState(0, 0, 0.7, 1.9, 0, 0)
        simulated = simulated_vehicle(hull, start, SEA, seed)
        for _ in range(STEPS):
            simulated.advance(SpatialCommand(0.1, -0.05, 6.0) if dives else Command(0.1, 6.0), 0.05)  # type: ignore[arg-type]
        found, (true, *over_ground) = simulated.navigation, simulated.truth
        if isinstance(simulated, SimulatedDiver):
            through = simulated.motion.ur, simulated.motion.vr, simulated.motion.wr
            angles = [wrap(getattr(found, name) - getattr(true, name)) for name in ("phi", "theta", "psi")]
            pose, rates = [found.z - true.z, *angles], [0.0, found.q - true.q, found.r - true.r]
            rest: list[float] = []
        else:
            through = simulated.motion.ur, simulated.motion.vr
            pose, rates = [0.0, 0.0, 0.0, wrap(found.psi - true.psi)], [0.0, 0.0, found.r - true.r]
            rest = [0.0]
        velocity, water = simulated.ground_velocity, simulated.water_velocity
        errors = [
            found.x - true.x, found.y - true.y, *pose,
            *(a - b for a, b in zip(velocity, over_ground, strict=True)), *rest, *rates,
            *(a - b for a, b in zip(water, through, strict=True)), *rest,
        ]  # fmt: skip
        parts = reported.pose(simulated), reported.twist(velocity), reported.water(water)
        variances = [*parts[0][::7], *parts[1][::7], *parts[2][::7][:3]]
        rows.append([e / math.sqrt(v) if v > 0.0 else e for e, v in zip(errors, variances, strict=True)])
    return np.array(rows)


@pytest.mark.parametrize("dives", [False, True], ids=["planar", "dives"])
def test_errors_are_as_large_as_reported(dives: bool) -> None:
    """Normalised errors have a mean square of 1; a sensor without an error reports none and makes none."""
    errors = normalised(dives)
    squares = np.nanmean(errors**2, axis=0)
    known = squares > 0.0
    assert ((squares[known] > 0.5) & (squares[known] < 2.0)).all(), squares.round(2)
    # x, y and yaw; both components of both velocities; the yaw rate.
    assert known[[0, 1, 5, 6, 7, 11, 12, 13]].all()
    assert known[[2, 3, 4, 8, 10, 14]].all() == dives
