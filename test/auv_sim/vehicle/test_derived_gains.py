"""What the default derives from a vehicle's file flies hulls that no gain was tuned for."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_path_following import config_files, vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.approach import ApproachConfig
from auv_sim.flight.batch import engine
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import SUITE
from auv_sim.vehicle.remus import PlantState
from hulls import STABLE, drawn

ROBUST = params_file.load(config_files.find("params", "robust"), SUITE)
#: The line is followed from the start on: an approach would take longer than the flight.
GUIDANCE = dataclasses.replace(ROBUST[topics.GUIDANCE].guidance, approach=ApproachConfig(enabled=False))
#: b = 5.1 1/s^2 with a rudder of 30 deg/s.
STRONG = dataclasses.replace(drawn(3), rudder=dataclasses.replace(drawn(3).rudder, max_rate_deg_s=30.0))
HULLS = {"fast servo": STABLE, "strong rudder": STRONG, "weak rudder": vehicle.load("remus100_mismatch")}
#: y (m), heading (deg), yaw rate (rad/s): beside the line, across it, turning, astern.
STARTS = [(8.0, 0.0, 0.0), (0.0, 90.0, 0.0), (0.0, 0.0, 0.4), (20.0, 180.0, 0.0)]


@pytest.mark.parametrize("name", HULLS)
def test_no_limit_cycle_remains_on_a_straight_line(name):
    """At 10 odometries a second, the slowest that is supported."""
    hull, line = HULLS[name], CompositePath([Line(0.0, 0.0, 600.0, 0.0)])
    for y, heading, r in STARTS:
        flight = Scenario(
            path=line,
            vehicle=hull,
            thrust=hull.thrust_max,
            initial=PlantState(0.0, y, math.radians(heading), hull.top_speed, 0.0, r),
            step=0.1,
            guidance=GUIDANCE,
            autopilot=ROBUST[topics.AUTOPILOT].autopilot,
            time_limit=120.0,
        )
        run = engine.track(flight)
        late = run.r[run.t > 80.0]
        assert math.degrees(float(np.sqrt(np.mean(late**2)))) < 0.3
