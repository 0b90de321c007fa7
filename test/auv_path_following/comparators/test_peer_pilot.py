"""The law of MSS as the pilot of a flight: in Python, compiled, and where it cannot fly."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Current, Navigation, WaterVelocity
from auv_path_following.comparators.mss_pilot import MssPilot
from auv_path_following.comparators.peer_pilot import peer_begun, peer_reply, prepare
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_sim.flight import closed_loop
from auv_sim.flight.batch.compiled import COMPILED, take_over_pure
from auv_sim.flight.batch.distance import rows_of
from auv_sim.flight.batch.kinds import chosen
from auv_sim.flight.scenario import Scenario
from auv_sim.vehicle.at_sea import Seen
from auv_sim.vehicle.remus import PlantState
from hulls import DIVER, REMUS

LAW = MssPilot(
    pitch_inertia=1.0, lookahead=4.65, adaptation=0.032, switching=10.0, observer=2.8, largest_rate=0.5,
    yaw_gain=1.63, yaw_time=12.3, slope=0.134, boundary=0.34, switching_gain=0.068,
)  # fmt: skip
LEGS = CompositePath([Line(0.0, 0.0, 120.0, 0.0), Line(120.0, 0.0, 90.0, 0.5 * math.pi)])


def flight(**changes) -> Scenario:
    common = {"path": LEGS, "vehicle": REMUS, "thrust": REMUS.thrust_max, "peer": LAW, "time_limit": 240.0}
    return Scenario(**(common | changes))


def seen_at(x: float, y: float, psi: float, r: float) -> Seen:
    motion = PlantState(x, y, psi, 1.5, 0.0, r)
    return Seen(
        Navigation(x, y, psi, r), WaterVelocity(1.5, 0.0), True, 0.0, 0.0, motion, 0.0, Current(0.0, 0.0)
    )


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_it_flies_straight_legs_in_a_current(side: float) -> None:
    """A current across the first leg is learnt as a crab angle against it; the flight ends with the legs."""
    path = CompositePath([Line(0.0, 0.0, 120.0, 0.0), Line(120.0, 0.0, 90.0, side * 0.5 * math.pi)])
    run = closed_loop.fly(flight(path=path, current=Current(0.0, side * 0.2)))
    assert run.s[-1] == 2.0
    before = np.flatnonzero(run.x < 100.0)[-1]
    assert abs(run.y[before]) < 0.5
    assert side * run.psi[before] < -0.05
    assert abs(run.x[-1] - 120.0) < 1.5


def test_a_wrong_path_or_a_vehicle_that_dives_is_refused() -> None:
    arc = CompositePath([Line(0.0, 0.0, 100.0, 0.0), Arc(100.0, 20.0, 20.0, -0.5 * math.pi, 0.5)])
    with pytest.raises(ConfigurationError, match="subpath 2: found Arc, expected straight legs alone"):
        closed_loop.fly(flight(path=arc))
    with pytest.raises(ConfigurationError, match="found a vehicle that dives"):
        closed_loop.fly(flight(vehicle=DIVER))


@pytest.mark.skipif(not COMPILED, reason="not run: no Numba")
def test_the_compiled_law_is_the_same_to_the_last_bit() -> None:
    import numba

    take_over_pure()
    config = prepare(LAW, REMUS, REMUS.thrust_max, True)

    @numba.njit(error_model="numpy")
    def compiled_reply(config, path, state, seen, now, dt):
        return peer_reply(config, path, state, seen, now, dt)

    random, rows, legs = np.random.default_rng(2), rows_of(LEGS), set()
    state = same = peer_begun(config, None)
    for k in range(200):
        x, y, psi, r = random.uniform((-20.0, -40.0, -3.0, -0.5), (140.0, 100.0, 3.0, 0.5)).tolist()
        seen = seen_at(x, y, psi, r)
        state, _, _, guided, command = chosen.reply(config, LEGS.rows, state, seen, 0.0, 0.05 if k else 0.0)
        same, _, _, other, fast = compiled_reply(config, rows, same, seen, 0.0, 0.05 if k else 0.0)
        assert command == fast and guided == other
        assert abs(command.rudder) <= REMUS.rudder.max_angle
        legs.add(guided.i)
    assert legs == {0, 1}
    assert chosen.begins(config, None) == peer_begun(config, None)
    assert chosen.at_rest(config).thrust == 0.0
    assert chosen.largest_angle(config) == REMUS.rudder.max_angle
