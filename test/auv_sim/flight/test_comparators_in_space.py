"""Comparators in three dimensions: the peer's law on its own hull and course, and PID in pitch."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.types import SpatialCurrent
from auv_path_following import config_files
from auv_path_following.comparators.mss_pilot import MssPilot, mss_begun, mss_pilot
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.pid import PidConfig
from auv_path_following.control.reference_model import ReferenceConfig
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.missions import mission_file
from auv_sim.flight import closed_loop
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import SUITE
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
from auv_sim.vehicle.hulls.mss_particulars import IY, MASS, ZG
from auv_sim.vehicle.hulls.mss_propeller import propeller_loads
from auv_sim.vehicle.hulls.mss_remus100 import mss_remus100
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at, to_body
from hulls import DIVER
from peer_course import CORNERS, PEER, course_start, distances, drift, rms

ROBUST = params_file.load(config_files.find("params", "robust"), SUITE)
PID = AutopilotConfig(
    controller="pid", pid=PidConfig(), reference=ReferenceConfig(enabled=True, bandwidth=1.0)
)
STEP = 0.05


def thrust_at(time: float, body: BodyState, current: tuple[float, float, float]) -> float:
    """Thrust of the published speed of rotation: from 1000 to 1300 1/min, 2 1/min a second."""
    x, y, z = to_body(body.qw, body.qi, body.qj, body.qk, *current)
    over_ground = math.hypot(body.ur + x, body.vr + y, body.wr + z)
    rotation = min(1000.0 + 2.0 * time, 1300.0) / 60.0
    return max(propeller_loads(rotation, over_ground)[0], 0.0)


def test_the_peers_law_flies_its_hull_as_it_was_published() -> None:
    """3-D rms 0.86 +- 0.05 m on the whole course: hull, law and course are the peer's.

    The published run has 0.861 m rms, 4.52 m at most, and 0.207 m rms in depth.
    """
    hull = mss_remus100()
    config = MssPilot(pitch_inertia=IY + MASS * ZG * ZG + hull.added_pitch)
    body = SimulatedDiver(PEER, course_start(), current=SpatialCurrent(*drift(0.0)), step=STEP)
    waypoints = [tuple(map(float, corner)) for corner in CORNERS]
    state, track = mss_begun(body.navigation), []
    for k in range(50_000):
        current = drift(k * STEP)
        body.constant_current = SpatialCurrent(*current)
        seen = body.navigation
        thrust = thrust_at(k * STEP, body.motion, current)
        state, output = mss_pilot(config, waypoints, state, seen, thrust, STEP if k else 0.0)
        track.append(seen[:3])
        if output.finished:
            break
        body.advance(output.command, STEP)
    near, depth = distances(*np.array(track).T)
    assert state.leg == len(waypoints) - 2
    assert rms(near) == pytest.approx(0.861, abs=0.05)
    assert near.max() == pytest.approx(4.52, abs=0.2)
    assert rms(depth) == pytest.approx(0.207, abs=0.05)


def flown(path: SpatialPath, initial: BodyState | None = None, pitch: AutopilotConfig = PID):
    return closed_loop.fly(
        Scenario(
            path=path.plan, spatial=path, vehicle=DIVER, thrust=6.48, initial=initial, pitch=pitch,
            guidance=ROBUST[topics.GUIDANCE].guidance, autopilot=ROBUST[topics.AUTOPILOT].autopilot,
        )
    )  # fmt: skip


@pytest.mark.parametrize("above", [5.0, -5.0], ids=["dive", "climb"])
def test_pid_in_pitch_makes_a_step_of_depth(above: float) -> None:
    path = SpatialPath([Line(0.0, 0.0, 120.0, 0.0)], DepthProfile.constant(15.0, 120.0))
    run = flown(path, body_at(0.0, 0.0, 15.0 - above, 0.0, 0.0, 0.0, 1.9))
    late = run.t - run.t[0] > 40.0
    assert np.abs(run.z[late] - 15.0).max() < 0.05
    assert (above * (15.0 - run.z)).min() > -0.3 * abs(above) * abs(above)


def test_pid_in_pitch_holds_the_depth_of_the_papers_path() -> None:
    plan = mission_file.load("paper_composite").path.segments[:4]
    path = SpatialPath(plan, DepthProfile.constant(10.0, math.fsum(s.length for s in plan)))
    run = flown(path)
    assert run.s[-1] == path.n
    assert rms(run.z - 10.0) < 0.05
    other = flown(path, pitch=dataclasses.replace(PID, controller="nism"))
    assert not np.array_equal(other.sternplanes_cmd, run.sternplanes_cmd)
