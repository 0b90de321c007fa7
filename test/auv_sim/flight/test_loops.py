"""Flights in three dimensions, with limits that were set before they were flown."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SpatialCurrent
from auv_path_following import config_files
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.spatial.spatial_limits import steepest_at, steepest_of
from auv_path_following.missions import mission_file
from auv_sim.flight.closed_loop import fly
from auv_sim.flight.scenario import Scenario, spatial_start_of
from auv_sim.vehicle.hulls.rigid_body import body_at
from hulls import DIVER, REMUS

PLAN = mission_file.load("paper_composite").path.segments
LENGTH = math.fsum(segment.length for segment in PLAN)
UPWELLING = SpatialCurrent(0.1, 0.2, 0.05)


@pytest.fixture(scope="module")
def robust() -> dict[str, Any]:
    """Gains of the shipped robust.yaml."""
    from auv_sim.sim_parameters import SUITE

    loaded = params_file.load(config_files.find("params", "robust"), SUITE)
    return {"guidance": loaded[topics.GUIDANCE].guidance, "autopilot": loaded[topics.AUTOPILOT].autopilot}


def scenario(path: SpatialPath, **others: Any) -> Scenario:
    """A scenario that follows a path in three dimensions."""
    return Scenario(path=path.plan, spatial=path, **others)


def helix() -> SpatialPath:
    """15 m radius, from 5 to 40 m of depth at 10 degrees, between two lines."""
    slope = math.tan(math.radians(10.0))
    arc = Arc(0.0, 15.0, 15.0, -math.pi / 2.0, -math.pi / 2.0 + 35.0 / slope / 15.0)
    end = arc.evaluate(1.0)
    segments = [Line(-40.0, 0.0, 40.0, 0.0), arc, Line(end.x, end.y, 40.0, end.chi)]
    knots = [(0.0, 5.0), (40.0, 5.0), (40.0 + arc.length, 40.0), (80.0 + arc.length, 40.0)]
    return SpatialPath(segments, DepthProfile(knots, "linear"))


def ramps() -> SpatialPath:
    """The paper's path between 5 and 30 m of depth."""
    shares = [(0.0, 5.0), (0.15, 30.0), (0.3, 12.0), (0.5, 25.0), (0.65, 8.0), (0.85, 22.0), (1.0, 5.0)]
    return SpatialPath(PLAN, DepthProfile([(share * LENGTH, depth) for share, depth in shares]))


def level() -> SpatialPath:
    """The paper's path at 10 m of depth."""
    return SpatialPath(PLAN, DepthProfile.constant(10.0, LENGTH))


def distances(path: SpatialPath, run: Any) -> np.ndarray:
    """Distance in three dimensions of every row to the path, m."""
    return path.distance(run.x, run.y, run.z, run.subpath(path.n))


@pytest.mark.parametrize(
    ("path", "current", "rms", "largest"),
    [
        (level, SpatialCurrent(0.0, 0.0, 0.0), 0.04, 0.6),
        (level, UPWELLING, 0.04, 0.6),
        (ramps, UPWELLING, 0.04, 0.6),
        (helix, SpatialCurrent(0.0, 0.0, 0.0), 0.05, 0.5),
        (helix, UPWELLING, 0.10, 0.5),
    ],
    ids=["10 m", "10 m, current", "5 to 30 m, current", "helix", "helix, current"],
)
def test_the_path_is_followed(robust, path, current, rms, largest) -> None:
    made = path()
    run = fly(scenario(made, vehicle=DIVER, thrust=6.48, current=current, **robust))
    off = distances(made, run)
    assert run.s[-1] == pytest.approx(made.n)
    assert math.sqrt(np.mean(off**2)) <= rms
    assert off.max() <= largest
    if path is not helix:
        # Subpaths 3 to 7 of the paper, behind its sharp corners.
        ends = np.cumsum([segment.length for segment in made.plan.segments])
        begin = 1 + np.searchsorted(ends, PLAN[0].length + PLAN[1].length - 1e-3)
        assert math.sqrt(np.mean(off[run.s >= begin] ** 2)) <= 0.02
        assert math.sqrt(np.mean(run.ze**2)) <= 0.015
    assert abs(run.theta).max() <= DIVER.depth.max_pitch + math.radians(6.0)


@pytest.mark.parametrize("above", [5.0, -5.0], ids=["above", "below"])
def test_a_vehicle_away_from_the_depth_of_the_path_goes_there_and_stays(robust, above) -> None:
    path = SpatialPath([Line(0.0, 0.0, 200.0, 0.0)], DepthProfile.constant(15.0, 200.0))
    start = body_at(0.0, 0.0, 15.0 - above, 0.0, 0.0, 0.0, 1.9)
    run = fly(scenario(path, vehicle=DIVER, thrust=6.48, initial=start, **robust))
    assert math.copysign(1.0, run.theta_d[0]) == -math.copysign(1.0, above)
    late = run.t - run.t[0] > 30.0
    assert abs(run.z[late] - 15.0).max() < 0.02
    assert (above * (15.0 - run.z)).min() > -0.3  # no overshoot worth the name


def test_a_depth_that_a_weight_pulls_at_is_held_without_an_integral(robust) -> None:
    """7 N of buoyancy to spare: the planes carry it, and the depth error goes to zero."""
    import dataclasses

    heavy = dataclasses.replace(DIVER.coefficients.vertical, B=DIVER.coefficients.vertical.W + 7.0)
    light = dataclasses.replace(DIVER, hull=dataclasses.replace(DIVER.coefficients, vertical=heavy))
    path = SpatialPath([Line(0.0, 0.0, 300.0, 0.0)], DepthProfile.constant(15.0, 300.0))
    run = fly(scenario(path, vehicle=light, thrust=6.48, **robust))
    assert abs(run.z[-200:] - 15.0).max() < 0.002
    assert math.degrees(run.sternplanes_cmd[-2]) == pytest.approx(-5.5, abs=0.3)
    assert math.degrees(run.theta[-2]) == pytest.approx(-1.5, abs=0.2)


@pytest.mark.parametrize(
    ("depths", "thrust", "message"),
    [
        ((5.0, 120.0, 5.0), 6.48, r"knots\[1\]: found 120 m at 100 m of path, expected 0.5 to 100 m"),
        ((5.0, 0.1, 5.0), 6.48, r"knots\[1\]: found 0.1 m at 100 m of path, expected 0.5 to 100 m"),
        ((5.0, 5.0, 5.0), 1.0, r"thrust: found 1 N, 0.79 m/s, expected at least 0.9 m/s"),
    ],
    ids=["too deep", "out of the water", "too slow"],
)
def test_what_the_vehicle_cannot_do_is_refused(depths, thrust, message) -> None:
    profile = DepthProfile(list(zip((0.0, 100.0, 200.0), depths, strict=True)))
    path = SpatialPath([Line(0.0, 0.0, 200.0, 0.0)], profile)
    with pytest.raises(ConfigurationError, match=message):
        fly(scenario(path, vehicle=DIVER, thrust=thrust))


def test_a_planar_mission_is_flown_at_the_surface_depth(robust) -> None:
    """Without a depth the vehicle stays where its propeller is still under water."""
    path = CompositePath([Line(0.0, 0.0, 150.0, 0.0)])
    run = fly(Scenario(path=path, vehicle=DIVER, thrust=6.48, **robust))
    assert run.s[-1] == 1.0
    late = run.t - run.t[0] > 20.0
    assert abs(run.depth[late] - DIVER.depth.surface).max() < 0.05


def test_a_path_with_depths_needs_stern_planes(robust) -> None:
    with pytest.raises(ConfigurationError, match="REMUS 100: sternplanes: found a path with depth"):
        fly(scenario(level(), vehicle=REMUS, thrust=6.48, **robust))


def test_a_slow_vehicle_pitches_less(robust) -> None:
    """From 0.5 m and 0.3 m/s to 10 m: no pitch below the reversal speed, and theta_max grows with it."""
    path = SpatialPath([Line(0.0, 0.0, 150.0, 0.0)], DepthProfile.constant(10.0, 150.0))
    start = body_at(0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.3)
    run = fly(scenario(path, vehicle=DIVER, thrust=6.48, initial=start, **robust))
    slow = run.ur < 0.37
    assert slow[0]
    assert not run.theta_d[slow].any()
    bounds = [
        steepest_at(steepest_of(DIVER, 6.48), math.hypot(u, w)) for u, w in zip(run.ur, run.wr, strict=True)
    ]
    assert (abs(run.theta_d[:-1]) <= np.array(bounds[:-1]) + 1e-3).all()
    reached = run.t[np.argmax(run.z > 9.0)] - run.t[0]
    assert reached < 21.0
    assert run.z.max() < 10.1


@pytest.mark.parametrize("speed", [0.0, 1.0])
def test_a_vehicle_dives_from_the_surface(robust, speed) -> None:
    """A path that begins at the surface is begun afloat, at rest too."""
    profile = DepthProfile([(0.0, 0.0), (150.0, 8.0), (200.0, 8.0)], "linear")
    path = SpatialPath([Line(0.0, 0.0, 200.0, 0.0)], profile)
    start = spatial_start_of(path, DIVER)
    assert start.z == DIVER.shallowest
    run = fly(scenario(path, vehicle=DIVER, thrust=6.48, initial=start._replace(ur=speed), **robust))
    assert run.s[-1] == path.n
    assert run.z[-1] == pytest.approx(8.0, abs=0.05)
