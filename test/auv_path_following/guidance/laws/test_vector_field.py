"""Vector field guidance: signs, bounds, slope on the path, and the heading in a current."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.guidance.laws import vector_field
from auv_path_following.guidance.laws.law import LawInputs
from auv_path_following.guidance.laws.vector_field import VectorFieldConfig
from laws import flown

_angle, _flow = st.floats(-3.1, 3.1), st.floats(-0.6, 0.6)


def answer(ye, chi_p=0.3, Ur=2.0, beta_r=0.0, current=NO_CURRENT, **gains):
    law = flown(vector_field.LAW, VectorFieldConfig(**gains))
    return law.update(LawInputs(ye, chi_p, Ur, beta_r, current), 0.05)


@given(st.floats(0.01, 1000.0), _angle, st.floats(-0.3, 0.3))
def test_starboard_of_the_path_it_steers_to_port_and_the_other_way_round(ye, chi_p, beta_r):
    starboard, port = answer(ye, chi_p, beta_r=beta_r), answer(-ye, chi_p, beta_r=beta_r)
    assert starboard.chi_r < 0.0 < port.chi_r == -starboard.chi_r
    assert abs(starboard.chi_r) < math.radians(60.0)
    assert starboard.psi_d == pytest.approx(chi_p + starboard.chi_r - beta_r)


@given(st.floats(1.0, 90.0), st.floats(0.01, 10.0))
def test_on_the_path_its_slope_is_that_of_its_look_ahead_distance(entry, gain):
    h = 1e-6 / gain
    slope = (
        answer(h, entry_angle_deg=entry, gain=gain).chi_r - answer(-h, entry_angle_deg=entry, gain=gain).chi_r
    )
    lookahead = VectorFieldConfig(entry_angle_deg=entry, gain=gain).largest_lookahead
    assert slope / (2.0 * h) == pytest.approx(-1.0 / lookahead, rel=1e-6)


@given(st.floats(-50.0, 50.0), _angle, st.floats(-0.3, 0.3), _flow, _flow)
def test_in_a_current_the_course_over_ground_is_that_of_the_field(ye, chi_p, beta_r, Vx, Vy):
    out, Ur = answer(ye, chi_p, 2.0, beta_r, Current(Vx, Vy)), 2.0
    # Through the water the vehicle moves along psi + beta_r.
    north, east = Ur * math.cos(out.psi_d + beta_r) + Vx, Ur * math.sin(out.psi_d + beta_r) + Vy
    chi_d = chi_p + out.chi_r
    assert -math.sin(chi_d) * north + math.cos(chi_d) * east == pytest.approx(0.0, abs=1e-9)
    assert math.cos(chi_d) * north + math.sin(chi_d) * east > 0.0


@pytest.mark.parametrize(("Vy", "theta_n"), [(5.0, 0.95), (-5.0, -0.95)])
def test_a_current_stronger_than_the_vehicle_is_clipped(Vy, theta_n):
    out = answer(0.0, 0.0, 1.0, current=Current(0.0, Vy))
    assert out.theta_n == theta_n and math.isfinite(out.psi_d)
