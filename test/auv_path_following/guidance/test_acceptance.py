"""The circle of acceptance that is computed for each corner."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following import config_files, vehicle
from auv_path_following.abilities import Cruise, Turning
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.acceptance import (
    Cornering,
    JointCorner,
    acceptance_radius,
    corner_of,
    cornering_of,
    crab_angle,
    reach,
)
from auv_path_following.parameters import AutopilotParameters, GuidanceParameters, ObserverParameters
from auv_path_following.vehicle import Vehicle
from hulls import REMUS, STABLE

_NODES = {
    topics.OBSERVER: ObserverParameters,
    topics.GUIDANCE: GuidanceParameters,
    topics.AUTOPILOT: AutopilotParameters,
}
ROBUST = params_file.load(config_files.find("params", "robust"), _NODES)
SIMPLE = Cornering(rate=0.5, lead=1.0)
DELTA, U = 5.0, 2.0

angles = st.floats(-math.pi, math.pi)


def corner(degrees, widest=1000.0, chi=0.3):
    return JointCorner(chi, chi + math.radians(degrees), widest)


def radius(degrees, current=NO_CURRENT, cornering=SIMPLE, widest=1000.0):
    return acceptance_radius(cornering, corner(degrees, widest), DELTA, U, current)


def test_a_right_angle_takes_the_lead_and_the_radius_of_the_turn():
    """2 m/s for 1 s, and a turn of 0.5 rad/s at 2 m/s: 4 m."""
    assert radius(90.0) == pytest.approx(2.0 + 4.0)


def test_shallower_and_sharper_corners():
    assert radius(60.0) == pytest.approx(2.0 + 4.0 * 0.6270 + 0.17 * 5.0 * 0.5, abs=1e-3)
    assert radius(120.0) == pytest.approx(2.0 + 4.0 * 1.5950 - 0.17 * 5.0 * 0.5, abs=1e-3)
    assert radius(179.0) == radius(140.0) < 15.0


@given(st.floats(1.0, 135.0), st.floats(0.0, 0.4), angles)
def test_both_sides_are_alike(degrees, strength, direction):
    chi = 0.3
    flow = [
        Current(strength * math.cos(chi + side * direction), strength * math.sin(chi + side * direction))
        for side in (1.0, -1.0)
    ]
    assert radius(degrees, flow[0]) == pytest.approx(radius(-degrees, flow[1]))


@given(angles, st.floats(0.0, 1.5), angles)
def test_the_crab_angle_keeps_the_course(chi, strength, direction):
    current = Current(strength * math.cos(direction), strength * math.sin(direction))
    psi = chi + crab_angle(chi, U, current)
    north, east = U * math.cos(psi) + current.Vx, U * math.sin(psi) + current.Vy
    assert -north * math.sin(chi) + east * math.cos(chi) == pytest.approx(0.0, abs=1e-12)


def test_ground_speed_and_change_of_heading_count():
    """Leg in to the north, leg out to the east, a current of 0.5 m/s."""
    square = JointCorner(0.0, math.pi / 2, 1000.0)
    north, east = (
        acceptance_radius(SIMPLE, square, DELTA, U, Current(*current)) for current in ((0.5, 0.0), (0.0, 0.5))
    )
    # Astern: 2.5 m/s, and the bow ends 14.48 deg up-current of east, 104.48 deg from north.
    assert north == pytest.approx(2.5 + 5.0 * 1.24247 - 0.85 * 0.25, abs=1e-4)
    # Abeam: sqrt(4 - 0.25) m/s, from 14.48 deg to port of north round to east.
    assert east == pytest.approx(1.9365 + 3.8730 * 1.24247 - 0.85 * 0.25, abs=1e-3)


@given(st.floats(-180.0, 180.0), st.floats(0.0, 3.0), angles, st.floats(0.0, 4.0), st.floats(0.0, 30.0))
def test_no_corner_has_a_radius_beyond_the_reach(degrees, strength, direction, Ur, lookahead):
    current = Current(strength * math.cos(direction), strength * math.sin(direction))
    found = acceptance_radius(SIMPLE, corner(degrees, math.inf), lookahead, Ur, current)
    bound = reach(SIMPLE, lookahead, Ur, current)
    assert found <= bound <= Ur * 6.0 + strength * 6.0 + 0.17 * lookahead + 1e-9


def test_a_slower_hull_begins_sooner():
    weak = vehicle.load("remus100_mismatch")
    for degrees in (45.0, 90.0, 120.0):
        assert radius(degrees, cornering=cornering_of(weak)) > radius(degrees, cornering=cornering_of(REMUS))


def test_it_takes_half_of_the_shorter_leg_at_most_and_nothing_at_rest():
    path = CompositePath([Line(0.0, 0.0, 30.0, 0.0), Line(30.0, 0.0, 8.0, 2.0)])
    assert corner_of(path, 0) == pytest.approx((0.0, 2.0, 4.0))
    assert radius(120.0, widest=4.0) == 4.0
    assert acceptance_radius(SIMPLE, corner(90.0), DELTA, 0.0, Current(0.3, 0.0)) == 0.0
    assert radius(90.0, Current(-5.0, 0.0)) >= 0.0


@pytest.mark.parametrize("hull", [*map(vehicle.load, config_files.shipped("vehicles")), STABLE], ids=str)
def test_the_limits_are_those_of_the_autopilot(hull: Vehicle):
    limits = HeadingAutopilot(hull, ROBUST[topics.AUTOPILOT].autopilot).config.reference.limits
    found = cornering_of(hull)
    assert found.rate == limits.rate
    lead = 0.5 * limits.rate / limits.acceleration + 0.5 * limits.acceleration / limits.jerk
    assert found.lead == pytest.approx(lead, abs=0.1)


def test_a_vehicle_without_a_hull_has_its_measured_turn():
    measured = Vehicle(
        name="m",
        length=2.0,
        thrust_max=10.0,
        rudder=REMUS.rudder,
        cruise=Cruise(thrust=10.0, speed=1.8),
        turning=Turning(radius=9.0),
    )
    assert cornering_of(measured).rate == pytest.approx(0.2)
    assert 9.0 < acceptance_radius(cornering_of(measured), corner(90.0), DELTA, 1.8) < 12.0
