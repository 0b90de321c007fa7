"""The rule for gains: what it derives from what, and where it says that it does not hold."""

from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.control.rule.allowance import allowance_for
from auv_path_following.control.rule.fin_response import FinResponse, response_of
from auv_path_following.control.rule.gain_rule import RuledGains, gains_for, plane_gains
from auv_path_following.vehicle import Rudder
from auv_sim.own_vehicle.new.assumed_hull import scaled
from hulls import DIVER, REMUS, STABLE, drawn

PEER = vehicle.load("mss_remus100")
_response = st.builds(
    lambda speed, effect, divergence, turn, drift: FinResponse(
        speed, effect, divergence, turn, drift, -1.0, -1.0
    ),
    st.floats(0.2, 4.0), st.floats(0.01, 12.0), st.floats(-3.0, 3.5), st.floats(0.005, 1.2),
    st.floats(0.05, 3.0),
)  # fmt: skip
_fin = st.builds(
    lambda angle, rate, dead_time: Rudder(max_angle_deg=angle, max_rate_deg_s=rate, dead_time=dead_time),
    st.floats(8.0, 40.0), st.floats(3.0, 900.0), st.floats(0.0, 0.5),
)  # fmt: skip


def with_rudder(**changes: float) -> vehicle.Vehicle:
    return dataclasses.replace(REMUS, rudder=dataclasses.replace(REMUS.rudder, **changes))


@given(_response, _fin, st.floats(0.0, 0.5), st.sampled_from([0.02, 0.05, 0.1]))
def test_any_hull_gets_gains_within_their_bounds(response, fin, delay, step) -> None:
    """The settings classes refuse what is out of range, and the reference stays within the fin's power."""
    plane = plane_gains(response, fin, delay, step)
    nism, reference = plane.autopilot.nism, plane.autopilot.reference
    assert nism.kp <= fin.max_rate + 1e-12
    assert reference.max_acceleration <= response.effect * fin.max_angle / 3.0
    assert reference.max_rate <= response.turn
    assert reference.max_rate * reference.bandwidth <= reference.max_acceleration * (1.0 + 1e-9)
    assert plane.lookahead > response.speed / reference.bandwidth
    loop = nism.kp * nism.k5 * abs(response.gain(plane.crossover))
    assert loop == pytest.approx(1.0)  # w_c is where the inner loop has the gain 1
    assert plane.crossover * max(delay + fin.dead_time + 0.5 * step, 0.1) < 3.2


@given(_response, _fin, st.floats(0.0, 0.5), st.sampled_from([0.02, 0.05, 0.1]), st.floats(1.0, 3.0))
def test_an_assumed_hull_gets_a_longer_lookahead_and_a_quicker_reference(response, fin, delay, step, within):
    known = plane_gains(response, fin, delay, step)
    own = plane_gains(response, fin, delay, step, allowance=allowance_for(within))
    if within == 1.0:
        assert own == known
    (nism, reference), (usual, limits) = ((g.autopilot.nism, g.autopilot.reference) for g in (own, known))
    assert (own.crossover, own.product, own.authority) == (known.crossover, known.product, known.authority)
    assert nism.kp * nism.k5 == pytest.approx(usual.kp * usual.k5)  # the loop's gain is that of the file
    assert own.lookahead * reference.bandwidth >= known.lookahead * limits.bandwidth * (1.0 - 1e-9)
    assert reference.max_acceleration >= limits.max_acceleration
    assert reference.max_acceleration < response.effect * fin.max_angle
    assert reference.max_rate * reference.bandwidth <= reference.max_acceleration * (1.0 + 1e-9)


def test_a_vehicle_file_says_that_its_hull_is_assumed() -> None:
    """At 10 odometries a second kp stays the rate of the servo; the planes are ruled as if known."""
    own = dataclasses.replace(DIVER, assumed_within=2.0)
    assert DIVER.assumed_within == 1.0
    assert gains_for(own).pitch == gains_for(DIVER).pitch
    assert gains_for(own).heading.lookahead > 1.2 * gains_for(DIVER).heading.lookahead
    rates = [gains_for(own, step=step).heading.autopilot.nism.kp for step in (0.1, 0.05)]
    assert rates == pytest.approx([DIVER.rudder.max_rate, 1.6 * DIVER.rudder.max_rate])
    with pytest.raises(ValueError, match="assumed_within"):
        dataclasses.replace(DIVER, assumed_within=0.5)


def test_more_delay_makes_everything_slower() -> None:
    quick, slow = gains_for(REMUS, 0.05, 0.05).heading, gains_for(REMUS, 0.15, 0.05).heading
    assert slow.crossover < quick.crossover
    assert slow.autopilot.reference.bandwidth < quick.autopilot.reference.bandwidth
    assert slow.lookahead > quick.lookahead
    assert gains_for(with_rudder(dead_time=0.1), 0.05, 0.05).heading.autopilot == slow.autopilot
    assert gains_for(REMUS, 0.15, 0.1).heading.crossover < slow.crossover


def test_the_rudders_power_leaves_the_crossover_alone() -> None:
    """A fast servo must not raise the loop's gain: that was the limit cycle of the stable hull."""
    plane, fast = (gains_for(with_rudder(max_rate_deg_s=rate)).heading for rate in (15.0, 300.0))
    assert fast.crossover == plane.crossover
    assert fast.autopilot.nism.kp == 1.0
    product = plane.autopilot.nism.kp * plane.autopilot.nism.k5
    assert fast.autopilot.nism.kp * fast.autopilot.nism.k5 == pytest.approx(product)


def test_a_hull_that_drifts_looks_further_ahead() -> None:
    drifting = gains_for(STABLE).heading
    share = drifting.lookahead * drifting.autopilot.reference.bandwidth / STABLE.top_speed
    own = gains_for(REMUS).heading
    assert share > own.lookahead * own.autopilot.reference.bandwidth / REMUS.top_speed + 0.3


@given(_response, _fin, st.floats(0.0, 1.2), st.floats(0.0, 0.3))
def test_a_hull_that_slips_looks_further_ahead_and_is_steered_alike(response, fin, slip, more) -> None:
    response = response._replace(zero=-0.04)
    less = plane_gains(response._replace(slip=slip), fin, 0.05, 0.05)
    further = plane_gains(response._replace(slip=slip + more), fin, 0.05, 0.05)
    assert less.lookahead <= further.lookahead < 5.0 * plane_gains(response, fin, 0.05, 0.05).lookahead
    assert less.autopilot == further.autopilot


def test_the_look_ahead_of_a_usual_slip_is_that_without() -> None:
    """A slow swing was seen at a slip of 0.8, none at 0.6."""
    response, fin = response_of(STABLE), STABLE.rudder
    without = plane_gains(response._replace(slip=0.0), fin, 0.05, 0.05).lookahead
    usual, strong = (
        plane_gains(response._replace(slip=slip), fin, 0.05, 0.05).lookahead for slip in (0.59, 0.8)
    )
    assert usual == without
    assert strong > 1.4 * without


def test_the_turn_is_the_true_one() -> None:
    """Sway and lost speed make the stable hull turn at 0.21 rad/s, two thirds of speed over radius."""
    assert gains_for(STABLE).heading.autopilot.reference.max_rate <= 0.9 * tightest_turn(STABLE).rate
    assert response_of(STABLE).turn == pytest.approx(0.208, abs=1e-3)


def test_a_vehicle_that_dives_has_pitch_gains_that_are_quicker() -> None:
    gains = gains_for(DIVER)
    assert gains.pitch is not None
    assert gains.pitch.autopilot.reference.bandwidth > 1.3 * gains.heading.autopilot.reference.bandwidth
    assert gains_for(REMUS).pitch is None
    assert gains_for(REMUS).heading == gains.heading


def test_measured_numbers_are_enough() -> None:
    gains = gains_for(PEER)
    assert gains.notices == ()
    assert gains.pitch is not None
    nism = gains.heading.autopilot.nism
    power = PEER.turning.effect / math.hypot(gains.heading.crossover, PEER.turning.divergence)
    assert nism.kp * nism.k5 == pytest.approx(1.0 / power)


def test_a_hull_beyond_all_ranges_costs_one_line() -> None:
    quick = response_of(REMUS)._replace(effect=300.0)
    with pytest.raises(ConfigurationError, match=r"rule: k3: found 35\.3, expected less than or equal to 10"):
        plane_gains(quick, REMUS.rudder, 0.05, 0.05)


def test_it_says_where_it_does_not_hold() -> None:
    def lines(gains: RuledGains) -> str:
        return "\n".join(gains.notices)

    assert gains_for(REMUS, 0.15, 0.1).notices == ()
    assert "rudder: divergence times delay is 0.80, above 0.4" in lines(gains_for(REMUS, 0.55, 0.1))
    weak = lines(gains_for(with_rudder(max_rate_deg_s=3.0)))
    assert "effect times rate over divergence^2 is 0.084 rad/s, below 0.1" in weak
    assert gains_for(drawn(5), 0.5, 0.1).notices == ()  # hardly unstable


def test_a_large_slow_hull_still_flies_the_turns_of_its_courses() -> None:
    """Its rudder builds a turn up slowly; the reference must not be slower than turns of 2.5 radii need."""
    size = 4.5 / REMUS.length
    hull = scaled(REMUS.coefficients, size**3, size)
    rudder = dataclasses.replace(REMUS.rudder, max_rate_deg_s=10.0)
    large = dataclasses.replace(
        REMUS, length=4.5, hull=hull, rudder=rudder, thrust_max=-hull.Xuu * 1.2**2, params=None
    )
    heading = gains_for(large, 0.05).heading
    widest = 2.5 * max(tightest_turn(large).radius, 2.0 * large.length)
    assert heading.autopilot.reference.max_rate > 1.05 * large.top_speed / widest
    assert heading.lookahead < widest
    usual = gains_for(REMUS, 0.05).heading.autopilot.reference
    assert heading.autopilot.reference.bandwidth < 0.5 * usual.bandwidth
