"""Flights with the gains of the rule, on hulls that no gain was tuned for."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_path_following import config_files, vehicle
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.approach import ApproachConfig
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.ruled_guidance import with_gains
from auv_path_following.vehicle import Vehicle
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import engine
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import SUITE
from auv_sim.studies.gains.new_hulls import assumed, sized_hull
from auv_sim.vehicle.remus import PlantState
from hulls import REMUS, STABLE, drawn
from peer_course import COURSE, PEER, course_sea, course_start, distances, rms

ROBUST = params_file.load(config_files.find("params", "robust"), SUITE)
#: The line is followed from the start on: an approach would take longer than the flight.
GUIDANCE = dataclasses.replace(ROBUST[topics.GUIDANCE].guidance, approach=ApproachConfig(enabled=False))
SHIPPED = [vehicle.load(name) for name in config_files.shipped("vehicles")]
CORRECTED = vehicle.load("remus100_6dof_corrected")
#: Hulls in the plane: the shipped ones, one with a fast servo, and ten drawn ones.
HULLS = {
    **{hull.name: hull for hull in SHIPPED if not hull.dives},
    "corrected": dataclasses.replace(
        CORRECTED, sternplanes=None, hull=dataclasses.replace(CORRECTED.coefficients, vertical=None)
    ),
    "fast servo": STABLE,
    **{f"drawn {number}": drawn(number) for number in range(10)},
}
#: y (m), heading (deg), yaw rate (rad/s): beside the line, across it, turning, astern.
STARTS = [(8.0, 0.0, 0.0), (0.0, 90.0, 0.0), (0.0, 0.0, 0.4), (20.0, 180.0, 0.0)]
LINE = CompositePath([Line(0.0, 0.0, 600.0, 0.0)])


def unrest(
    hull: Vehicle, delay: float, step: float, guidance: PathFollowerConfig, autopilot: AutopilotConfig,
    seconds: float = 120.0,
) -> float:  # fmt: skip
    """Return the rms yaw rate in the second half of `seconds` on a line, deg/s: the worst of `STARTS`."""
    late = dataclasses.replace(hull, rudder=dataclasses.replace(hull.rudder, dead_time=delay))
    worst = 0.0
    for y, heading, r in STARTS:
        start = PlantState(0.0, y, math.radians(heading), hull.top_speed, 0.0, r)
        run = engine.track(
            Scenario(
                path=LINE, vehicle=late, controller_vehicle=hull, thrust=hull.thrust_max, initial=start,
                step=step, guidance=guidance, autopilot=autopilot, time_limit=seconds,
            )
        )  # fmt: skip
        worst = max(worst, math.degrees(rms(run.r[run.t > run.t[0] + 0.5 * seconds])))
    return worst


@pytest.mark.parametrize("name", HULLS)
def test_no_limit_cycle_with_delay_and_slow_odometry(name: str) -> None:
    """At 50 ms on every hull, at 150 ms on all for which the delay is not too long."""
    hull = HULLS[name]
    for delay in (0.05, 0.15):
        for step in (0.1, 0.02):
            gains = gains_for(hull, delay, step)
            if delay > 0.1 and gains.heading.product > 0.4:
                assert any("too much delay" in notice for notice in gains.notices)
                continue
            found = unrest(hull, delay, step, with_gains(GUIDANCE, gains), gains.heading.autopilot)
            assert found < 0.3, f"{found:.2f} deg/s at {delay} s and {step} s"


def test_the_default_gains_have_a_limit_cycle_there() -> None:
    """What the rule cures, and the measure can see."""
    assert unrest(REMUS, 0.15, 0.1, GUIDANCE, ROBUST[topics.AUTOPILOT].autopilot) > 0.9


def test_an_assumed_hull_does_not_swing() -> None:
    """A hull that slips by 0.8, of which `vehicle.py new` was given length, speed, rudder and radius."""
    hull = sized_hull(9)
    found = []
    for factor in (2.0, 1.0):
        gains = gains_for(dataclasses.replace(assumed(hull), assumed_within=factor))
        found.append(unrest(hull, 0.05, 0.05, with_gains(GUIDANCE, gains), gains.heading.autopilot, 240.0))
    allowed, known = found
    assert allowed < 0.3
    assert known > 0.8  # without the allowance it swings


def test_the_price_is_a_little_distance() -> None:
    from auv_path_following.missions import mission_file

    path = mission_file.load("paper_composite").path
    gains = gains_for(REMUS, 0.05)
    default = Scenario(
        path=path, vehicle=REMUS, thrust=6.48, guidance=ROBUST[topics.GUIDANCE].guidance,
        autopilot=ROBUST[topics.AUTOPILOT].autopilot,
    )  # fmt: skip
    ruled = dataclasses.replace(
        default, guidance=with_gains(default.guidance, gains), autopilot=gains.heading.autopilot
    )
    known, derived = closed_loop.fly(default), closed_loop.fly(ruled)
    assert derived.s[-1] == path.n
    off = [rms(path.distance(*run.track, run.subpath(path.n))) for run in (known, derived)]
    assert off[1] < 1.6 * off[0]
    travel = [float(np.abs(np.diff(run.rudder)).sum()) for run in (known, derived)]
    assert travel[1] < travel[0]


def test_the_peers_course_on_the_peers_hull() -> None:
    """Start at 1 m/s without an estimate, in up to 0.65 m/s of current, at 10 odometries a second."""
    gains = gains_for(PEER, step=0.1)
    assert gains.pitch is not None
    run = closed_loop.fly(
        Scenario(
            path=COURSE.plan, spatial=COURSE, vehicle=PEER, thrust=PEER.cruise.thrust, initial=course_start(),
            sea=course_sea(), step=0.1, guidance=with_gains(ROBUST[topics.GUIDANCE].guidance, gains),
            autopilot=gains.heading.autopilot, pitch=gains.pitch.autopilot, time_limit=2500.0,
        )
    )  # fmt: skip
    near, depth = distances(run.x, run.y, run.z)
    assert run.s[-1] == pytest.approx(COURSE.n)
    assert rms(near) <= 0.30
    assert near.max() <= 1.6
    assert rms(depth) <= 0.02
    assert np.degrees(np.abs(np.diff(run.rudder))).max() < 20.0
