"""What mss_remus100.yaml says of its hull, against the hull that is simulated."""

from __future__ import annotations

import math
from typing import get_args

import numpy as np
import pytest

from auv_path_following import vehicle
from auv_path_following.vehicle import BuiltInHull
from auv_sim.vehicle.hulls.mss_propeller import propeller_loads, revolutions_for
from auv_sim.vehicle.hulls.mss_remus100 import (
    mss_accelerations,
    mss_remus100,
    mss_remus100_step,
)
from auv_sim.vehicle.hulls.rigid_body import BodyState, angles_of, body_at
from auv_sim.vehicle.hulls.spatial_plant import BUILT_IN

PEER, HULL, STILL = vehicle.load("mss_remus100"), mss_remus100(), (0.0, 0.0, 0.0)
FULL = math.radians(20.0)


def flown(
    rudder: float, planes: float, seconds: float, thrust: float = PEER.cruise.thrust
) -> list[BodyState]:
    """The hull at steps of 0.05 s from cruise on, deep enough that no surface matters."""
    body = body_at(0.0, 0.0, 500.0, 0.0, 0.0, 0.0, PEER.cruise.speed)
    bodies = [body]
    for _ in range(int(seconds / 0.05)):
        body, _ = mss_remus100_step(HULL, body, ((rudder,) * 3, (planes,) * 3, thrust, STILL), 0.05)
        bodies.append(body)
    return bodies


def slopes(body: BodyState, names: tuple[str, str], rows: list[int], fins: tuple[float, float]) -> np.ndarray:
    """Derivatives of the accelerations `rows` by the velocities `names`."""
    return np.array([
        (accelerations(body._replace(**{name: getattr(body, name) + 1e-5}), *fins)
         - accelerations(body._replace(**{name: getattr(body, name) - 1e-5}), *fins))[rows] / 2e-5
        for name in names
    ]).T  # fmt: skip


def accelerations(body: BodyState, rudder: float, planes: float) -> np.ndarray:
    ground = (body.ur, body.vr, body.wr)
    revolutions = revolutions_for(PEER.cruise.thrust, math.hypot(*ground))
    return np.array(mss_accelerations(HULL, body, rudder, planes, revolutions, ground))


def test_every_name_of_a_built_in_hull_can_be_simulated() -> None:
    assert set(BUILT_IN) == set(get_args(BuiltInHull))


def test_thrust_and_speed() -> None:
    cruise = flown(0.0, 0.0, 60.0)[-1]
    assert cruise.ur == pytest.approx(PEER.cruise.speed, rel=1e-3)
    for rpm, thrust in ((1300.0, PEER.cruise.thrust), (1525.0, PEER.thrust_max)):
        assert propeller_loads(rpm / 60.0, PEER.speed_at(thrust))[0] == pytest.approx(thrust, rel=2e-3)


def test_turning() -> None:
    turn, level = flown(FULL, 0.0, 60.0)[-1], flown(0.0, 0.0, 0.0)[0]
    assert math.hypot(turn.ur, turn.vr) / -turn.r == pytest.approx(PEER.turning.radius, rel=5e-3)
    effect = (accelerations(level, 1e-5, 0.0) - accelerations(level, -1e-5, 0.0))[5] / 2e-5
    assert -effect == pytest.approx(PEER.turning.effect, rel=2e-3)
    growth = np.linalg.eigvals(slopes(level, ("vr", "r"), [1, 5], (0.0, 0.0))).real.max()
    assert growth == pytest.approx(PEER.turning.divergence, rel=0.02)
    half = flown(0.5 * FULL, 0.0, 60.0)[-1]
    drift = slopes(half, ("vr", "r"), [1, 5], (0.5 * FULL, 0.0))[0, 0]
    assert -1.0 / drift == pytest.approx(PEER.turning.drift_time, rel=0.02)


def test_pitching() -> None:
    level, climb = flown(0.0, 0.0, 0.0)[0], flown(0.0, -FULL, 60.0)
    assert math.degrees(max(body.q for body in climb)) == pytest.approx(PEER.pitching.rate_deg_s, rel=0.01)
    assert math.degrees(angles_of(climb[-1])[1]) == pytest.approx(PEER.pitching.climb_deg, rel=0.01)
    effect = (accelerations(level, 0.0, 1e-5) - accelerations(level, 0.0, -1e-5))[4] / 2e-5
    assert -effect == pytest.approx(PEER.pitching.effect, rel=2e-3)
    growth = np.linalg.eigvals(slopes(level, ("wr", "q"), [2, 4], (0.0, 0.0))).real.max()
    assert growth == pytest.approx(PEER.pitching.divergence, rel=0.02)
    dive = flown(0.0, 0.5 * FULL, 3.0)[-1]
    drift = slopes(dive, ("wr", "q"), [2, 4], (0.0, 0.5 * FULL))[0, 0]
    assert -1.0 / drift == pytest.approx(PEER.pitching.drift_time, rel=0.02)


@pytest.mark.parametrize(("share", "deeper"), [(1.0, 1.0), (0.5, -1.0)], ids=["lowest speed", "half of it"])
def test_its_planes_work_at_the_lowest_speed_and_reverse_below(share: float, deeper: float) -> None:
    speed = share * PEER.depth.minimum_speed
    body = body_at(0.0, 0.0, 50.0, 0.0, 0.0, 0.0, speed)
    planes = (math.radians(2.0),) * 3
    for _ in range(1200):
        body, _ = mss_remus100_step(
            HULL, body, ((0.0,) * 3, planes, PEER.thrust_at(speed), STILL), 0.1
        )  # fmt: skip
    assert deeper * (body.z - 50.0) > 0.0
