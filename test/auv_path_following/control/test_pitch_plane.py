"""The vertical plane as a planar hull: the same accelerations as the hull in six degrees of freedom."""

from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.abilities import Pitching
from auv_path_following.control.hull_model import (
    HullModel,
    accelerations,
    rudder_effect,
    rudder_gain,
    tightest_turn,
)
from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_sim.vehicle.hulls.remus_6dof import remus_6dof_of, remus_accelerations
from auv_sim.vehicle.hulls.rigid_body import BodyState
from hulls import DIVER, PRINTED, REMUS, with_vertical

SIDE = HullModel(pitch_plane_of(DIVER)).sway_yaw
#: Without weight's arm and spare buoyancy, which the plane leaves out.
FREE = remus_6dof_of(with_vertical(zg=1e-300, B=PRINTED.W, Kprop=0.0))


@given(st.floats(0.5, 2.5), st.floats(-0.5, 0.5), st.floats(-0.4, 0.4), st.floats(-0.3, 0.3))
def test_its_accelerations_are_those_of_heave_and_pitch(ur, up, q, planes) -> None:
    body = BodyState(0.0, 0.0, 50.0, 1.0, 0.0, 0.0, 0.0, ur, 0.0, -up, 0.0, q, 0.0)
    _, _, wr_dot, _, q_dot, _ = remus_accelerations(FREE, body, 0.0, planes, 0.0)
    rising, pitching = accelerations(SIDE, ur, up, q)
    by_fin = rudder_gain(SIDE, ur)
    assert rising + by_fin[0] * planes == pytest.approx(-wr_dot, abs=1e-12)
    assert pitching + by_fin[1] * planes == pytest.approx(q_dot, abs=1e-12)


def test_its_fins_are_the_planes() -> None:
    side = pitch_plane_of(DIVER)
    assert side.rudder == DIVER.sternplanes
    assert HullModel(side).b == pytest.approx(HullModel(REMUS).b, rel=0.05)  # a body of revolution, nearly


def test_a_planar_vehicle_has_none() -> None:
    with pytest.raises(ConfigurationError, match="REMUS 100: sternplanes: found nothing"):
        pitch_plane_of(REMUS)


def test_a_measured_vehicle_has_what_was_measured() -> None:
    peer = vehicle.load("mss_remus100")
    side = pitch_plane_of(peer)
    assert (side.rudder, side.hull, side.sternplanes) == (peer.sternplanes, None, None)
    assert rudder_effect(side) == pytest.approx(peer.pitching.effect * (peer.top_speed / 2.165) ** 2)
    assert tightest_turn(side, peer.cruise.thrust).rate == pytest.approx(math.radians(14.5))


def test_planes_may_be_measured_beside_a_planar_hull() -> None:
    planes = Pitching(rate_deg_s=11.0, climb_deg=40.0, effect=2.5)
    side = pitch_plane_of(dataclasses.replace(REMUS, sternplanes=DIVER.sternplanes, pitching=planes))
    assert side.hull is None
    assert side.top_speed == pytest.approx(REMUS.top_speed)
    assert rudder_effect(side) == pytest.approx(2.5)
