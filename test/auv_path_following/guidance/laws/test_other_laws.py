"""LOS, integral LOS and the adaptive look-ahead: signs, bounds, and what each does about a current."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.guidance.laws import ailos, ilos, los
from auv_path_following.guidance.laws.adaptive_lookahead import AdaptiveLookaheadConfig, adaptive_lookahead
from auv_path_following.guidance.laws.ailos import AilosConfig
from auv_path_following.guidance.laws.ilos import IlosConfig
from auv_path_following.guidance.laws.law import LawInputs
from auv_path_following.guidance.laws.los import LosConfig
from laws import flown

DT = 0.05


def inputs(ye, beta_r=0.0, current=NO_CURRENT, Ur=2.0):
    return LawInputs(ye, 0.3, Ur, beta_r, current)


@given(st.floats(-100.0, 100.0), st.floats(-0.3, 0.3))
def test_los_is_ailos_without_a_current(ye, beta_r):
    sailed = flown(los.LAW, LosConfig(lookahead=5.0)).update(inputs(ye, beta_r, Current(0.3, -0.2)), DT)
    other = flown(ailos.LAW, AilosConfig(lookahead=5.0)).update(inputs(ye, beta_r), DT)
    assert sailed.psi_d == pytest.approx(other.psi_d, abs=1e-12)


@pytest.mark.parametrize("law", [flown(los.LAW), flown(ilos.LAW)])
@pytest.mark.parametrize("ye", [-3.0, 3.0])
def test_it_turns_towards_the_path(law, ye):
    law.reset()
    assert (law.update(inputs(ye), DT).psi_d - 0.3) * ye < 0.0


@settings(max_examples=40)
@given(st.lists(st.floats(-50.0, 50.0), min_size=1, max_size=200))
def test_the_course_never_leaves_the_half_plane_ahead(errors):
    law = flown(ilos.LAW)
    for ye in errors:
        assert abs(law.update(inputs(ye), DT).chi_r) < math.pi / 2


def drift(law, across, seconds=400.0):
    """Where a vehicle with a perfect heading ends beside a straight path, in a current across it, m."""
    ye, dt = 5.0, 0.1
    for _ in range(round(seconds / dt)):
        psi = law.update(LawInputs(ye, 0.0, 2.0, 0.0, NO_CURRENT), dt).psi_d
        ye += dt * (2.0 * math.sin(psi) + across)
    return ye


def test_the_integral_takes_away_what_a_current_leaves():
    across = 0.3
    assert drift(flown(los.LAW, LosConfig(lookahead=6.0)), across) == pytest.approx(
        6.0 * math.tan(math.asin(across / 2.0)), rel=1e-3
    )
    assert abs(drift(flown(ilos.LAW, IlosConfig(lookahead=6.0)), across)) < 1e-3


def test_far_away_the_integral_grows_slowly():
    near, far = flown(ilos.LAW), flown(ilos.LAW)
    for _ in range(100):
        alpha_near, alpha_far = near.update(inputs(5.0), DT).alpha, far.update(inputs(500.0), DT).alpha
    assert 0.0 < alpha_far < alpha_near
    far.reset()
    assert far.update(inputs(0.0), DT).alpha == 0.0


@given(st.floats(-1000.0, 1000.0), st.floats(0.0, 10.0))
def test_the_adaptive_look_ahead_keeps_to_its_bounds(ye, Ur):
    config = AdaptiveLookaheadConfig(enabled=True)
    Delta = adaptive_lookahead(config, ye, Ur)
    assert config.smallest * config.hull_length <= Delta <= config.largest * config.hull_length
    assert Delta <= adaptive_lookahead(config, 2.0 * ye, Ur) + 1e-12
    assert Delta <= adaptive_lookahead(config, ye, 1.1 * Ur) + 1e-12


def test_the_adaptive_look_ahead_is_used_only_when_asked_for():
    adaptive = AilosConfig(lookahead=20.0, adaptive=AdaptiveLookaheadConfig(enabled=True))
    assert abs(flown(ailos.LAW, adaptive).update(inputs(2.0), DT).chi_r) > abs(
        flown(ailos.LAW, AilosConfig(lookahead=20.0)).update(inputs(2.0), DT).chi_r
    )
